// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <hearth/core/scalar.hpp>

/// Closures on Eigen's numbers.  Include it beside a closure and pass
///     Eigen::Array<double, 8, 1>               eight evaluations at once, one AVX-512 register
///     Eigen::AutoDiffScalar<Eigen::Vector3d>   a value and its derivatives in three directions
namespace hearth {

/// Lanes: Eigen arrays of any size and expressions of them.
/// A number below the smallest normal one counts as that one in power and logarithm.
template <class Lanes>
struct scalar_traits<Lanes, std::enable_if_t<std::is_base_of_v<Eigen::ArrayBase<Lanes>, Lanes>>> {
    using real = typename Lanes::Scalar;
    using value = typename Lanes::PlainObject;

    static value power(const Lanes& lanes, real a) {
        const evaluated x = lanes;
        if constexpr (has_simd) {
            // Eigen's pow runs at half the speed of the plain one; its exp has no zero, so zero is set by hand.
            const real at_zero = a > 0 ? real(0) : a < 0 ? std::numeric_limits<real>::infinity() : real(1);
            const value positive = (a * x.log()).exp();
            return select(x == real(0), uniform(x, at_zero), positive);
        } else {
            return x.unaryExpr([a](real v) { return std::pow(v, a); });
        }
    }
    static value variable_power(const Lanes& x, const value& a) {
        return select(x == real(0), uniform(a, real(0)), value((a * x.log()).exp()));
    }
    static value square_root(const Lanes& lanes) {
        const evaluated x = lanes;
        const value root = x.sqrt();
        // Eigen 3.4 takes a reciprocal on AVX-512, which makes a NaN of infinity.
        return select(x <= std::numeric_limits<real>::max(), root, value(x));
    }
    static value cube_root(const Lanes& lanes) {
        if constexpr (has_simd)
            return power(lanes, real(1) / real(3));
        else
            return lanes.unaryExpr([](real v) { return std::cbrt(v); });
    }
    static value exponential(const Lanes& x) { return x.exp(); }
    static value exponential_minus_one(const Lanes& x) { return x.expm1(); }
    static value logarithm(const Lanes& x) { return x.log(); }
    static value absolute(const Lanes& x) { return x.abs(); }

    template <class Mask>
    static value select(const Mask& mask, const value& a, const value& b) {
        // Eigen 3.4 neither compares nor selects in packets; compilers turn this loop into both.
        const Eigen::internal::evaluator<Mask> holds(mask);
        value chosen(a.rows(), a.cols());
        for (Eigen::Index k = 0; k < chosen.size(); ++k) chosen.coeffRef(k) = holds.coeff(k) ? a.coeff(k) : b.coeff(k);
        return chosen;
    }
    static value uniform(const Lanes& x, real v) { return value::Constant(x.rows(), x.cols(), v); }
    static std::int64_t lane_count(const Lanes& x) { return x.size(); }
    static real lane(const Lanes& x, std::int64_t k) { return x.coeff(k); }

  private:
    static constexpr bool has_simd = std::is_same_v<real, float> || std::is_same_v<real, double>;
    using evaluated = std::conditional_t<std::is_same_v<Lanes, value>, const value&, value>;
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
