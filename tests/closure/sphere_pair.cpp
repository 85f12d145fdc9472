// SPDX-License-Identifier: MIT
#include <cmath>
#include <initializer_list>

#include <doctest/doctest.h>

#include <hearth/closure/sphere_pair.hpp>

#include "support/closure_condition.hpp"

using hearth::closure::sphere_pair;

TEST_CASE("sphere_pair: the exact factor agrees with an integration of 25 digits") {
    // by mpmath from the closed form of a tilted element, checked there against ray tracing; printed with ten decimals
    constexpr long double rows[][2]{{1.00L, 0.0755868184L}, {1.01L, 0.0735522172L}, {1.10L, 0.0593230606L},
                                    {1.50L, 0.0295903123L}, {1.75L, 0.0213408805L}, {2.00L, 0.0161562444L},
                                    {3.00L, 0.0070444170L}, {5.00L, 0.0025126590L}, {20.0L, 0.0001562989L}};
    for (const auto& row : rows) {
        const long double s = row[0], factor = row[1];
        CAPTURE(s);
        CHECK(std::fabs(sphere_pair::exact_view_factor(s) - factor) <= 0.5e-10L);
    }
}

TEST_CASE("sphere_pair: the compact fit is within 7e-5 of the exact factor") {
    for (double s = 1; s < 200; s *= 1.003) {
        CAPTURE(s);
        REQUIRE(std::fabs(sphere_pair::view_factor(s) / sphere_pair::exact_view_factor(s) - 1) < 7.1e-5);
    }
}

TEST_CASE("sphere_pair: far away only the solid angle counts") {
    // the next term is 0.125 / s^2
    CHECK(16e8 * sphere_pair::view_factor(1e4) == doctest::Approx(1).epsilon(2e-9));
    CHECK(16e8 * sphere_pair::exact_view_factor(1e4) == doctest::Approx(1).epsilon(2e-9));
}

TEST_CASE("sphere_pair: exact in double and float as well") {
    for (const double s : {1.0, 1.0001, 1.3, 2.0, 10.0, 100.0}) {
        CAPTURE(s);
        const long double exact = sphere_pair::exact_view_factor(static_cast<long double>(s));
        CHECK(hearth_test::relative_error(sphere_pair::exact_view_factor(s), exact) < 1e-13);
        const auto single = static_cast<float>(s);
        const long double exact_single = sphere_pair::exact_view_factor(static_cast<long double>(single));
        CHECK(hearth_test::relative_error(sphere_pair::exact_view_factor(single), exact_single) < 3e-6);
    }
}

TEST_CASE("sphere_pair: overlapping spheres count as touching") {
    CHECK(sphere_pair::view_factor(0.9) == sphere_pair::view_factor(1.0));
}
