// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <hearth/time/tssm.hpp>
#include <hearth/time/tssm_error.hpp>

#include "support/packed_column.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

/// Rise of Schumann's solid temperature with dimensionless time, exp(-(xi + eta)) I0(2 sqrt(xi eta)).
double rise(double xi, double eta) {
    const long double z = 2 * std::sqrt(static_cast<long double>(xi) * static_cast<long double>(eta));
    const long double root = std::sqrt(static_cast<long double>(xi)) - std::sqrt(static_cast<long double>(eta));
    return static_cast<double>(std::exp(-root * root) * schumann::detail::scaled_bessel_i0(z));
}

TEST_CASE("tssm error: the steepest rise is the maximum of the exact solution's slope") {
    for (double xi = 1e-3; xi < 1e5; xi *= 1.07) {
        double best = rise(xi, 0);
        // The maximum lies below eta = xi and the curve is smooth over sqrt(xi): two nested scans find it to 1e-7.
        double from = 0, to = 1.1 * xi;
        for (int level = 0; level < 4; ++level) {
            double at = from;
            const double d = (to - from) / 200;
            for (int k = 0; k <= 200; ++k)
                if (rise(xi, from + k * d) > best) best = rise(xi, from + k * d), at = from + k * d;
            from = std::max(0.0, at - 2 * d);
            to = at + 2 * d;
        }
        CAPTURE(xi);
        REQUIRE(steepest_rise(xi) == doctest::Approx(best).epsilon(7e-5));  // the fit's 6e-5
    }
    CHECK(steepest_rise(0.0) == 1.0);
}

TEST_CASE("tssm error: the estimate is within 5 % of the exact error wherever (Gamma - 1) beta xi < 0.1") {
    for (const double xi : {1e-3, 0.03, 0.3, 0.7, 1.0, 1.3, 2.0, 5.0, 8.0, 20.0, 100.0, 1000.0}) {
        for (const double delay : {0.003, 0.03, 0.0999}) {  // (Gamma - 1) beta xi
            CAPTURE(xi);
            CAPTURE(delay);
            const tssm_bed bed{2.84e-4, xi};
            const double gamma = 1 + delay / (bed.storage_ratio * xi);
            const auto late_by = [&](double tau) {
                const auto place = static_cast<long double>(xi), now = static_cast<long double>(tau);
                return static_cast<double>(schumann::solid(place, now) -
                                           schumann::solid(place, now - static_cast<long double>(delay)));
            };
            // Largest where the front passes: tau from 0 to xi + delay; the curve is smooth over sqrt(xi) or kinks at
            // tau = delay, which is on the grid.
            double worst = late_by(delay);
            for (int k = 0; k <= 400; ++k) worst = std::max(worst, late_by(delay + 1.1 * xi * k / 400.0));
            CHECK(tssm_error(gamma, gas_storage::paper, bed) == doctest::Approx(worst).epsilon(0.05));
        }
    }
}

TEST_CASE("tssm error: gamma_for is the Gamma whose error is the tolerance") {
    const glass_bed bed;
    for (const double x : {0.02, 0.05, 0.1})
        for (const double tolerance : {0.001, 0.01, 0.08}) {
            const double gamma = gamma_for(tolerance, gas_storage::paper, bed.at(x));
            CHECK(tssm_error(gamma, gas_storage::paper, bed.at(x)) == doctest::Approx(tolerance).epsilon(1e-12));
        }
    // About 45 for 1 % at 100 mm of this bed.
    CHECK(gamma_for(0.01, gas_storage::paper, bed.at(0.1)) == doctest::Approx(45).epsilon(0.02));
    CHECK(std::isinf(gamma_for(0.01, gas_storage::corrected, bed.at(0.1))));
    CHECK(std::isinf(gamma_for(0.01, gas_storage::quasi_steady, bed.at(0.1))));
    CHECK(gamma_for(1e-7, gas_storage::quasi_steady, bed.at(0.1)) == 1.0);
}

TEST_CASE("tssm error: the delay law holds within 2 % from Gamma 10 to 2000") {
    const glass_bed bed;
    for (const double gamma : {10.0, 50.0, 200.0, 678.0, 2000.0}) {
        CAPTURE(gamma);
        // Fine enough for the column's own error, which falls with the square of the cell, to stay below 0.5 %.
        const double step = std::max(1e-3, 0.05 / gamma);
        const tssm clock(gamma, gas_storage::paper);
        const double delay = tssm_delay(gamma, gas_storage::paper, 0.1, bed.interstitial_velocity());
        CHECK(delay == doctest::Approx((gamma - 1) * 0.1 / 1.25));
        const double error = largest_error(bed, clock, 0.1, step, 800, 300);
        double law = 0;
        for (double t = 0; t < 800; t += 1) law = std::max(law, bed.solid(0.1, t) - bed.solid(0.1, t - delay));
        CHECK(error == doctest::Approx(law).epsilon(0.02));
    }
}

TEST_CASE("tssm error: the corrected form stays within 1 K of 100 K of the exact bed at Gamma 200 to 2000") {
    const glass_bed bed;
    for (const double gamma : {200.0, 678.0, 2000.0})
        for (const double x : {0.02, 0.05, 0.1}) {
            CAPTURE(gamma);
            CAPTURE(x);
            const double error = largest_error(bed, tssm(gamma), x, 1e-3, 1600);
            CHECK(error < 1.0);
            CHECK(error < 0.05);  // as measured: the column's own error is far below the bar
        }
}

TEST_CASE("tssm error: a quasi-steady gas with the exponential update is within 0.05 K in 320 steps") {
    const glass_bed bed;
    const tssm clock(678, gas_storage::quasi_steady);
    for (const double x : {0.02, 0.05, 0.1}) CHECK(largest_error(bed, clock, x, 5.0 / 678, 1600) < 0.05);
}

TEST_CASE("tssm error: an error grows with Gamma and with the distance from the entrance") {
    const glass_bed bed;
    for (const double gamma : {10.0, 200.0, 678.0}) {
        CHECK(tssm_error(gamma, gas_storage::paper, bed.at(0.02)) <
              tssm_error(gamma, gas_storage::paper, bed.at(0.05)));
        CHECK(tssm_error(gamma, gas_storage::paper, bed.at(0.05)) < tssm_error(gamma, gas_storage::paper, bed.at(0.1)));
        CHECK(tssm_error(gamma, gas_storage::corrected, bed.at(0.1)) < 1e-12);
    }
    CHECK(tssm_error(1.0, gas_storage::paper, bed.at(0.1)) == 0.0);
}

TEST_CASE("tssm error: bad input is named") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)tssm_error(0.99, gas_storage::paper, {1e-4, 1}), bad_value);
    CHECK_THROWS_AS((void)tssm_delay(nan, gas_storage::paper, 1, 1), bad_value);
    for (const double bad : {nan, 0.0, -1.0}) {
        CHECK_THROWS_AS((void)gamma_for(bad, gas_storage::paper, {1e-4, 1}), bad_value);
        CHECK_THROWS_AS((void)gamma_for(0.01, gas_storage::paper, {bad, 1}), bad_value);
        CHECK_THROWS_AS((void)gamma_for(0.01, gas_storage::paper, {1e-4, bad}), bad_value);
    }
}

}  // namespace
