// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include <hearth/core/function.hpp>

namespace hearth {

/// How a number type does what closures ask of it.  The primary template serves float, double and long double;
/// <hearth/eigen.hpp> adds Eigen's arrays (SIMD lanes) and dual numbers.  A host specialises it for a number of its
/// own.
///
/// Types
///     real      the plain number inside: literals and coefficients are of this type
///     value     what an expression of this type evaluates to; the type itself for plain numbers
///
/// Static members, all but the last two of type `value`
///     power(x, real a)  variable_power(x, value a)  square_root(x)  cube_root(x)
///     exponential(x)  exponential_minus_one(x)  logarithm(x)  absolute(x)
///     minimum(x, value y)  maximum(x, value y)  at_least(x, real lo)  at_most(x, real hi)    NaN in x comes through
///     select(mask, value a, value b)    a where the mask holds, else b
///     uniform(x, real v)                v in the shape of x
///     lane_count(x)                     how many plain numbers there are in x, an std::int64_t; 1 for plain numbers
///     lane(x, k)                        the plain number in lane k, a real; of a dual number its value
template <class Scalar, class Enable = void>
struct scalar_traits {
    static_assert(std::is_floating_point_v<Scalar>,
                  "hearth: no scalar_traits<Scalar>; include <hearth/eigen.hpp> for Eigen's numbers, or specialise "
                  "hearth::scalar_traits for your own");
    using real = Scalar;
    using value = Scalar;

    HEARTH_FUNCTION static Scalar power(Scalar x, Scalar a) { return std::pow(x, a); }
    HEARTH_FUNCTION static Scalar variable_power(Scalar x, Scalar a) { return std::pow(x, a); }
    HEARTH_FUNCTION static Scalar square_root(Scalar x) { return std::sqrt(x); }
    HEARTH_FUNCTION static Scalar cube_root(Scalar x) { return std::cbrt(x); }
    HEARTH_FUNCTION static Scalar exponential(Scalar x) { return std::exp(x); }
    HEARTH_FUNCTION static Scalar exponential_minus_one(Scalar x) { return std::expm1(x); }
    HEARTH_FUNCTION static Scalar logarithm(Scalar x) { return std::log(x); }
    HEARTH_FUNCTION static Scalar absolute(Scalar x) { return std::fabs(x); }
    HEARTH_FUNCTION static constexpr Scalar minimum(Scalar x, Scalar y) { return y < x ? y : x; }
    HEARTH_FUNCTION static constexpr Scalar maximum(Scalar x, Scalar y) { return x < y ? y : x; }
    HEARTH_FUNCTION static constexpr Scalar at_least(Scalar x, Scalar lo) { return x < lo ? lo : x; }
    HEARTH_FUNCTION static constexpr Scalar at_most(Scalar x, Scalar hi) { return hi < x ? hi : x; }
    HEARTH_FUNCTION static constexpr Scalar select(bool mask, Scalar a, Scalar b) { return mask ? a : b; }
    HEARTH_FUNCTION static constexpr Scalar uniform(Scalar, Scalar v) { return v; }
    HEARTH_FUNCTION static constexpr std::int64_t lane_count(Scalar) { return 1; }
    HEARTH_FUNCTION static constexpr Scalar lane(Scalar x, std::int64_t) { return x; }
};

/// The plain number inside a number: double for double, for lanes of double and for duals over double.
template <class Scalar>
using real_t = typename scalar_traits<Scalar>::real;

/// What an expression evaluates to.
template <class Scalar>
using value_t = typename scalar_traits<Scalar>::value;

/// x to the power a, for x >= 0; NaN for x < 0.  power(0, a) = 0 for a > 0.
/// On Eigen's lanes it is computed in vector registers, within two epsilon.
template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> power(const Scalar& x, real_t<Scalar> a) {
    return scalar_traits<Scalar>::power(x, a);
}

/// x to a power a > 0 that varies like x does, for x >= 0.
template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> variable_power(const Scalar& x, const Scalar& a) {
    return scalar_traits<Scalar>::variable_power(x, a);
}

/// Square root; NaN for x < 0.
template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> square_root(const Scalar& x) {
    return scalar_traits<Scalar>::square_root(x);
}

/// Cube root, for x >= 0.
template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> cube_root(const Scalar& x) {
    return scalar_traits<Scalar>::cube_root(x);
}

template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> exponential(const Scalar& x) {
    return scalar_traits<Scalar>::exponential(x);
}

/// exp(x) - 1 without cancellation at small x.
template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> exponential_minus_one(const Scalar& x) {
    return scalar_traits<Scalar>::exponential_minus_one(x);
}

/// Natural logarithm.
template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> logarithm(const Scalar& x) {
    return scalar_traits<Scalar>::logarithm(x);
}

template <class Scalar>
HEARTH_FUNCTION value_t<Scalar> absolute(const Scalar& x) {
    return scalar_traits<Scalar>::absolute(x);
}

/// x * x, evaluated once.
template <class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> square(const Scalar& x) {
    return x * x;
}

/// x * x * x, evaluated once.
template <class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> cube(const Scalar& x) {
    return x * x * x;
}

/// a where the mask holds, else b.  Both are evaluated, so both must be finite.
template <class Mask, class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> select(const Mask& mask, const Scalar& a, const Scalar& b) {
    return scalar_traits<Scalar>::select(mask, a, b);
}

/// A constant in the shape of x: every lane of it v, every derivative zero.
template <class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> uniform(const Scalar& x, real_t<Scalar> v) {
    return scalar_traits<Scalar>::uniform(x, v);
}

/// The smaller of two.  A NaN in x comes through.
template <class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> minimum(const Scalar& x, const Scalar& y) {
    return scalar_traits<Scalar>::minimum(x, y);
}

/// The larger of two.  A NaN in x comes through.
template <class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> maximum(const Scalar& x, const Scalar& y) {
    return scalar_traits<Scalar>::maximum(x, y);
}

/// x, but not below a constant.  NaN stays NaN.
template <class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> at_least(const Scalar& x, real_t<Scalar> lo) {
    return scalar_traits<Scalar>::at_least(x, lo);
}

/// x, but not above a constant.  NaN stays NaN.
template <class Scalar>
HEARTH_FUNCTION constexpr value_t<Scalar> at_most(const Scalar& x, real_t<Scalar> hi) {
    return scalar_traits<Scalar>::at_most(x, hi);
}

/// How many plain numbers there are in x.
template <class Scalar>
HEARTH_FUNCTION constexpr std::int64_t lane_count(const Scalar& x) {
    return scalar_traits<Scalar>::lane_count(x);
}

/// The plain number in lane k of x, 0 <= k < lane_count(x).
template <class Scalar>
HEARTH_FUNCTION constexpr real_t<Scalar> lane(const Scalar& x, std::int64_t k) {
    return scalar_traits<Scalar>::lane(x, k);
}

}  // namespace hearth
