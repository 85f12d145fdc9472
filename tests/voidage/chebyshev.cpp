// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/voidage/chebyshev.hpp>

namespace {

/// sum_k c_k cos(k t): the series at x = 1 - cos t.
double value(const hearth::heat_kernel_series& series, double t) {
    double sum = 0;
    for (std::size_t k = 0; k <= series.terms(); ++k) sum += series[k] * std::cos(static_cast<double>(k) * t);
    return sum;
}

}  // namespace

TEST_CASE("heat kernel series: is exp(-z x) to its tolerance") {
    for (const double z : {1e-3, 0.1, 0.5, 1.0, 3.0, 10.0, 50.0, 400.0, 1e5}) {
        for (const double tolerance : {1e-2, 1e-5, 1e-10}) {
            CAPTURE(z);
            CAPTURE(tolerance);
            const hearth::heat_kernel_series series(z, tolerance);
            for (double t = 0; t <= 3.15; t += 0.01) {
                // Cut at `tolerance`, scaled by as much, and with z moved until the slope is kept: the last moves z by
                // a part of the slope that was cut, K^2 tolerance / z or some 2 log(1/tolerance) tolerance.
                const double bound = tolerance * (2 + 2 * std::log(1 / tolerance)) + 1e-13;
                CHECK(std::abs(value(series, t) - std::exp(-z * (1 - std::cos(t)))) <= bound);
            }
        }
    }
}

TEST_CASE("heat kernel series: keeps sum and slope exactly, with coefficients that are not negative") {
    for (const double z : {0.0, 1e-12, 0.01, 0.3, 1.0, 1.5, 7.0, 48.0, 300.0, 2e4}) {
        for (const double tolerance : {1e-2, 1e-5, 1e-16}) {
            CAPTURE(z);
            CAPTURE(tolerance);
            const hearth::heat_kernel_series series(z, tolerance);
            double sum = 0, slope = 0;
            for (std::size_t k = series.terms() + 1; k-- > 0;) {
                CHECK(series[k] >= 0);
                sum += series[k];
                slope += series[k] * static_cast<double>(k * k);
            }
            const double roundoff = 2.3e-16 * static_cast<double>(series.terms() + 2);
            CHECK(std::abs(sum - 1) <= roundoff);
            CHECK(std::abs(slope - z) <= 4 * roundoff * z);
        }
    }
}

TEST_CASE("heat kernel series: has about sqrt(2 z log(1/tolerance)) terms") {
    for (const double z : {20.0, 200.0, 2000.0}) {
        for (const double tolerance : {1e-3, 1e-6}) {
            const hearth::heat_kernel_series series(z, tolerance);
            const double expected = std::sqrt(2 * z * std::log(1 / tolerance));
            CHECK(static_cast<double>(series.terms()) < 1.05 * expected + 1);
            CHECK(static_cast<double>(series.terms()) >
                  0.75 * expected - 1);  // the tail is a sum of the last few terms
        }
    }
}
