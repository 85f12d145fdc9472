// SPDX-License-Identifier: MIT
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include <hearth/closure/eisfeld_schnitzlein.hpp>
#include <hearth/closure/ergun.hpp>

using namespace hearth::closure;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Over the paper's 145 mm of 14 mm spheres, see ergun.cpp [Pa].
double drop(double superficial_speed, double void_fraction, double tube_to_particle) {
    const bed_flow<double> flow{void_fraction, superficial_speed / void_fraction, 1.20411, 1.81332e-5, 0.014};
    return 0.145 * pressure_gradient(eisfeld_schnitzlein(tube_to_particle), flow);
}

}  // namespace

TEST_CASE("eisfeld_schnitzlein: agrees with pressure drops computed elsewhere") {
    // printed with four decimals; the gas properties have six digits
    CHECK(drop(0.2, 0.4, 5) == doctest::Approx(10.2842).epsilon(1e-5));
    CHECK(drop(1, 0.4, 5) == doctest::Approx(187.6679).epsilon(1e-5));
    CHECK(drop(2, 0.4, 7) == doctest::Approx(710.0340).epsilon(1e-5));
    CHECK(drop(2, 0.4, 10) == doctest::Approx(697.4221).epsilon(1e-5));
    CHECK(drop(1, 0.36, infinity) == doctest::Approx(244.1533).epsilon(1e-5));
    CHECK(drop(2, 0.44, 5) == doctest::Approx(507.2206).epsilon(1e-5));
}

TEST_CASE("eisfeld_schnitzlein: the paper's measurements lie below Ergun at high speed, as this does") {
    const auto ergun_drop = [](double speed) {
        return 0.145 * pressure_gradient(ergun{}, bed_flow<double>{0.4, speed / 0.4, 1.20411, 1.81332e-5, 0.014});
    };
    CHECK(drop(0.2, 0.4, 7) > 0.9 * ergun_drop(0.2));
    CHECK(drop(2, 0.4, 7) < 0.9 * ergun_drop(2));
}

TEST_CASE("eisfeld_schnitzlein: the wall rubs in slow flow and opens a way in fast flow") {
    CHECK(drop(1e-4, 0.4, 5) > drop(1e-4, 0.4, infinity));
    CHECK(drop(1e-4, 0.4, 5) / drop(1e-4, 0.4, infinity) ==
          doctest::Approx((1 + 0.4 / 3 / 0.6) * (1 + 0.4 / 3 / 0.6)).epsilon(1e-3));  // Aw^2
}

TEST_CASE("eisfeld_schnitzlein: a tube narrower than a particle is refused") {
    for (const double bad : {0.0, 0.99, -3.0, std::numeric_limits<double>::quiet_NaN()}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(eisfeld_schnitzlein{bad}, std::invalid_argument);
    }
    CHECK_THROWS_WITH(eisfeld_schnitzlein{0.5},
                      "hearth: tube_to_particle of closure eisfeld_schnitzlein is 0.5, allowed: >= 1 [-]");
}
