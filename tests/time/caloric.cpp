// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/time/caloric.hpp>

#include "support/random.hpp"

using namespace hearth;

TEST_CASE("caloric: temperature inverts enthalpy, and specific heat is its slope") {
    const polynomial_specific_heat<3> caloric{{700.0, 0.6, -1.1e-4}, -9e6, 300.0};
    CHECK(caloric.enthalpy(300.0) == 0.0);
    hearth_test::seeded random(11);
    for (int k = 0; k < 2000; ++k) {
        const double t = random.uniform(200, 2600);
        CAPTURE(t);
        // The enthalpy's own rounding, seen as a temperature, and the last Newton step: 8 round-offs.
        REQUIRE(std::fabs(caloric.temperature(caloric.enthalpy(t)) - t) <= 8 * 2.3e-16 * t);
        // Central difference: error d^2/6 of the third derivative, and round-off over d.
        const double d = 0.05;
        const double slope = (caloric.enthalpy(t + d) - caloric.enthalpy(t - d)) / (2 * d);
        REQUIRE(slope == doctest::Approx(caloric.specific_heat(t)).epsilon(1e-7));
    }
}

TEST_CASE("caloric: the polynomial of one coefficient is the constant") {
    const polynomial_specific_heat<1> one{{840.0}, 0.0, 0.0 + 1.0};
    const constant_specific_heat<> plain{840.0};
    for (const double t : {250.0, 1000.0, 2600.0}) {
        CHECK(one.specific_heat(t) == plain.specific_heat(t));
        CHECK(one.enthalpy(t) - one.enthalpy(250.0) ==
              doctest::Approx(plain.enthalpy(t) - plain.enthalpy(250.0)).epsilon(1e-14));
    }
}

TEST_CASE("caloric: float inverts as well") {
    const polynomial_specific_heat<2, float> caloric{{800.0f, 0.3f}, 0.0f, 300.0f};
    for (const float t : {250.0f, 900.0f, 2400.0f})
        CHECK(std::fabs(caloric.temperature(caloric.enthalpy(t)) - t) <= 8 * 6e-8f * t);
}
