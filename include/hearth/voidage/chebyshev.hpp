// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth {

/// Coefficients c_0 ... c_K with which  sum_k c_k T_k(1 - x)  approximates  exp(-z x)  on 0 <= x <= 2, T_k the
/// Chebyshev polynomials of the first kind: c_0 = e^-z I_0(z), c_k = 2 e^-z I_k(z), I_k the modified Bessel functions
/// (Abramowitz and Stegun 9.6.34).
///
/// K is the smallest for which the coefficients left out sum to at most `tolerance`.  What remains is adjusted to keep
/// two moments exactly: the sum, 1, so that a smoother keeps volume, and the slope at x = 0, -z, so that it has exactly
/// the width that was asked for.  All coefficients are >= 0.
/// K grows like sqrt(2 z log(1/tolerance)).  z >= 0, 0 < tolerance <= 0.01 (with less, the slope cannot be kept).
class heat_kernel_series {
  public:
    heat_kernel_series(double z, double tolerance) {
        if (z == 0) {
            coefficients_ = {1.0};
            return;
        }
        const std::vector<double> all = bessel_ratios(z);
        double tail = 0;
        std::size_t last = all.size() - 1;
        while (last > 1 && tail + all[last] <= tolerance) tail += all[last--];
        if (last == 1 && z <= 1) {
            coefficients_ = {1 - z, z};
            return;
        }
        // The slope of the truncated series grows with z from 0 to about K^2 / 3, so bisection finds the z that gives
        // the slope wanted.
        double low = z, high = 2 * z;
        while (slope(high, last) < z && high < 1e3 * z) high *= 2;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (slope(middle, last) < z ? low : high) = middle;
        }
        coefficients_ = truncated(high, last);
    }

    std::size_t terms() const { return coefficients_.size() - 1; }
    double operator[](std::size_t k) const { return coefficients_[k]; }

  private:
    /// c_k of the full series, as far as they matter, by Miller's downward recurrence I_{k-1} = I_{k+1} + (2k/z) I_k
    /// and the sum, which is 1.
    static std::vector<double> bessel_ratios(double z) {
        const auto start = static_cast<std::size_t>(30 + 12 * std::sqrt(z));  // I_start / I_0 < 1e-30
        std::vector<double> c(start + 1, 0.0);
        double above = 0, here = 1e-300;
        for (std::size_t k = start; k > 0; --k) {
            c[k] = 2 * here;
            const double below = above + 2 * static_cast<double>(k) / z * here;
            above = here;
            here = below;
            if (here > 1e200) {
                for (std::size_t j = k; j <= start; ++j) c[j] *= 1e-250;
                above *= 1e-250;
                here *= 1e-250;
            }
        }
        c[0] = here;
        normalise(c);
        return c;
    }

    static void normalise(std::vector<double>& c) {
        double sum = 0;
        for (std::size_t k = c.size(); k-- > 0;) sum += c[k];  // small ones first
        for (double& value : c) value /= sum;
    }

    static std::vector<double> truncated(double z, std::size_t last) {
        std::vector<double> c = bessel_ratios(z);
        c.resize(last + 1);
        normalise(c);
        return c;
    }

    /// Slope at x = 0 of the truncated series: T_k'(1) = k^2.
    static double slope(double z, std::size_t last) {
        const std::vector<double> c = truncated(z, last);
        double sum = 0;
        for (std::size_t k = last; k > 0; --k) sum += c[k] * static_cast<double>(k) * static_cast<double>(k);
        return sum;
    }

    std::vector<double> coefficients_;
};

}  // namespace hearth
