// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <hearth/core/lane_math.hpp>
#include <hearth/core/scalar.hpp>

/// Closures on Eigen's numbers.  Include it beside a closure and pass
///     Eigen::Array<double, 8, 1>               eight evaluations at once, one AVX-512 register
///     Eigen::AutoDiffScalar<Eigen::Vector3d>   a value and its derivatives in three directions
///
/// Clang fuses multiplications and additions of Eigen's numbers only with -ffp-contract=fast, which is GCC's default.
/// Without it lanes of closures that have no powers take 1.2 to 1.5 times as long as a plain loop.
namespace hearth {

/// Lanes: Eigen arrays of any size and expressions of them.
/// A number below the smallest normal one counts as that one.
template <class Lanes>
struct scalar_traits<Lanes, std::enable_if_t<std::is_base_of_v<Eigen::ArrayBase<Lanes>, Lanes>>> {
    using real = typename Lanes::Scalar;
    using value = typename Lanes::PlainObject;

    static value power(const Lanes& lanes, real a) {
        if constexpr (has_registers)
            return raised(lanes, a, real(0));
        else
            return lanes.unaryExpr([a](real v) { return std::pow(v, a); });
    }
    static value variable_power(const Lanes& lanes, const value& a) {
        const evaluated x = lanes;
        if constexpr (has_registers) {
            value y(x.rows(), x.cols());
            detail::raise_to_powers(x.data(), a.data(), y.data(), static_cast<std::size_t>(x.size()));
            return y;
        } else {
            return x.binaryExpr(a, [](real v, real e) { return std::pow(v, e); });
        }
    }
    static value square_root(const Lanes& lanes) {
        const evaluated x = lanes;
        value root = x.sqrt();
        // Eigen 3.4 multiplies by a reciprocal root on AVX-512, which makes a NaN of infinity.
        if constexpr (has_registers) detail::keep_infinity(x.data(), root.data(), static_cast<std::size_t>(x.size()));
        return root;
    }
    static value cube_root(const Lanes& lanes) {
        constexpr real third = real(1) / real(3);
        if constexpr (has_registers)
            return raised(lanes, third, static_cast<real>(1.0L / 3 - static_cast<long double>(third)));
        else
            return lanes.unaryExpr([](real v) { return std::cbrt(v); });
    }
    static value exponential(const Lanes& x) { return x.exp(); }
    static value exponential_minus_one(const Lanes& x) { return x.expm1(); }
    static value logarithm(const Lanes& x) { return x.log(); }
    static value absolute(const Lanes& x) { return x.abs(); }
    static value minimum(const Lanes& x, const value& y) { return x.min(y); }
    static value maximum(const Lanes& x, const value& y) { return x.max(y); }
    static value at_least(const Lanes& x, real lo) { return x.max(lo); }
    static value at_most(const Lanes& x, real hi) { return x.min(hi); }

    template <class Mask>
    static value select(const Mask& mask, const value& a, const value& b) {
        // Eigen 3.4 neither compares nor selects in packets; compilers turn this loop into both.
        value chosen(a.rows(), a.cols());
        for (Eigen::Index k = 0; k < chosen.size(); ++k) chosen.coeffRef(k) = mask.coeff(k) ? a.coeff(k) : b.coeff(k);
        return chosen;
    }
    static value uniform(const Lanes& x, real v) { return value::Constant(x.rows(), x.cols(), v); }
    static std::int64_t lane_count(const Lanes& x) { return x.size(); }
    static real lane(const Lanes& x, std::int64_t k) { return x.coeff(k); }

  private:
    static constexpr bool has_registers = std::is_same_v<real, float> || std::is_same_v<real, double>;
    using evaluated = std::conditional_t<std::is_same_v<Lanes, value>, const value&, value>;

    static value raised(const Lanes& lanes, real a, real tail) {
        const evaluated x = lanes;
        value y(x.rows(), x.cols());
        detail::raise_to_power(x.data(), y.data(), static_cast<std::size_t>(x.size()), a, tail);
        return y;
    }
};

/// Dual numbers: a value and its derivatives.  Where a derivative of the function is infinite (a root at zero), a
/// direction in which the argument does not change stays zero instead of becoming NaN.
template <class Derivatives>
struct scalar_traits<Eigen::AutoDiffScalar<Derivatives>> {
  private:
    using directions = typename std::remove_const_t<std::remove_reference_t<Derivatives>>::PlainObject;

  public:
    using dual = Eigen::AutoDiffScalar<Derivatives>;
    using real = typename directions::Scalar;
    using value = Eigen::AutoDiffScalar<directions>;

    static value power(const dual& x, real a) {
        return chain(x, std::pow(x.value(), a), a * std::pow(x.value(), a - real(1)));
    }
    static value variable_power(const dual& x, const value& a) {
        const real f = std::pow(x.value(), a.value());
        if (x.value() == real(0)) return chain(x, f, a.value() * std::pow(x.value(), a.value() - real(1)));
        const value exponent = a * logarithm(x);
        return value(f, f * exponent.derivatives());
    }
    static value square_root(const dual& x) {
        const real root = std::sqrt(x.value());
        return chain(x, root, real(0.5) / root);
    }
    static value cube_root(const dual& x) {
        const real root = std::cbrt(x.value());
        return chain(x, root, real(1) / (real(3) * root * root));
    }
    static value exponential(const dual& x) {
        const real e = std::exp(x.value());
        return chain(x, e, e);
    }
    static value exponential_minus_one(const dual& x) { return chain(x, std::expm1(x.value()), std::exp(x.value())); }
    static value logarithm(const dual& x) { return chain(x, std::log(x.value()), real(1) / x.value()); }
    static value absolute(const dual& x) {
        return chain(x, std::fabs(x.value()), x.value() < real(0) ? real(-1) : real(1));
    }
    static value minimum(const value& x, const value& y) { return y < x ? y : x; }
    static value maximum(const value& x, const value& y) { return x < y ? y : x; }
    static value at_least(const dual& x, real lo) { return x.value() < lo ? uniform(x, lo) : value(x); }
    static value at_most(const dual& x, real hi) { return hi < x.value() ? uniform(x, hi) : value(x); }
    static value select(bool mask, const value& a, const value& b) { return mask ? a : b; }
    static value uniform(const dual& x, real v) {
        return value(v, directions::Zero(x.derivatives().rows(), x.derivatives().cols()));
    }
    static std::int64_t lane_count(const dual&) { return 1; }
    static real lane(const dual& x, std::int64_t) { return x.value(); }

  private:
    static value chain(const dual& x, real f, real slope) {
        return value(f, x.derivatives().unaryExpr([slope](real d) { return d == real(0) ? d : slope * d; }));
    }
};

}  // namespace hearth
