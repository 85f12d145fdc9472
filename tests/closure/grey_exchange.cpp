// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/closure/grey_exchange.hpp>
#include <hearth/eigen.hpp>

#include "support/random.hpp"

using hearth::closure::grey_exchange;

TEST_CASE("grey_exchange: hand value") {
    // 5.670374419e-8 * 1e-4 * (1000^4 - 500^4) = 5.670374419e-8 * 1e-4 * 9.375e11
    CHECK(grey_exchange().heat_rate(1e-4, 500.0, 1000.0) == doctest::Approx(5.315976017812500).epsilon(1e-14));
}

TEST_CASE("grey_exchange: what i gains j loses, to the last bit, and equal temperatures exchange nothing") {
    hearth_test::seeded random(31);
    const grey_exchange exchange(0.86);
    for (int n = 0; n < 10000; ++n) {
        const double area = random.log_uniform(1e-8, 1), i = random.log_uniform(200, 3000),
                     j = random.log_uniform(200, 3000);
        REQUIRE(exchange.heat_rate(area, i, j) == -exchange.heat_rate(area, j, i));
        REQUIRE(exchange.heat_rate(area, i, i) == 0);
        const auto x = static_cast<float>(area), u = static_cast<float>(i), v = static_cast<float>(j);
        REQUIRE(exchange.heat_rate(x, u, v) == -exchange.heat_rate(x, v, u));
    }
}

TEST_CASE("grey_exchange: keeps its digits at close temperatures") {
    const double cold = 1500, hot = std::nextafter(1500.0, 2000.0);
    const auto exact = 4.0L * 5.670374419e-8L * 1500.0L * 1500.0L * 1500.0L *
                       (static_cast<long double>(hot) - static_cast<long double>(cold));
    CHECK(grey_exchange().heat_rate(1.0, cold, hot) == doctest::Approx(static_cast<double>(exact)).epsilon(1e-14));
}

TEST_CASE("grey_exchange: doubled temperatures exchange sixteen times as much, doubled areas twice") {
    // powers of two, so exactly
    const grey_exchange exchange(0.5);
    CHECK(exchange.heat_rate(1e-4, 600.0, 1400.0) == 16 * exchange.heat_rate(1e-4, 300.0, 700.0));
    CHECK(exchange.heat_rate(2e-4, 300.0, 700.0) == 2 * exchange.heat_rate(1e-4, 300.0, 700.0));
}

TEST_CASE("grey_exchange: the secant is the derivative at equal temperatures and positive everywhere") {
    using dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
    const grey_exchange exchange(0.86);
    const dual area(1e-4), here(1200.0), there(1200.0, 1, 0);
    CHECK(exchange.heat_rate(area, here, there).derivatives()[0] ==
          doctest::Approx(exchange.conductance(1e-4, 1200.0, 1200.0)).epsilon(1e-14));
    CHECK(exchange.conductance(1e-4, 300.0, 2500.0) > 0);
    CHECK(exchange.conductance(1e-4, 300.0, 2500.0) * 2200 ==
          doctest::Approx(exchange.heat_rate(1e-4, 300.0, 2500.0)).epsilon(1e-14));
}

TEST_CASE("grey_exchange: the factor of a grey bed by ray tracing") {
    struct row {
        double emissivity, factor, error;
    };
    // Own ray tracing with reflection: packings of solid fraction 0.594, 0.637, 0.579.  The node is the middle one.
    constexpr row rows[]{{0.2, 0.25374, 0.003}, {0.4, 0.40416, 0.003}, {0.65, 0.61938, 0.003}, {0.86, 0.83272, 0.003},
                         {0.65, 0.60448, 0.03}, {0.86, 0.82703, 0.01}, {0.65, 0.62249, 0.03},  {0.86, 0.83382, 0.01}};
    for (const row& r : rows) {
        CAPTURE(r.emissivity);
        CHECK(grey_exchange::bed_factor(r.emissivity) == doctest::Approx(r.factor).epsilon(r.error));
    }
    CHECK(grey_exchange::bed_factor(1.0) == 1.0);  // a black bed is black to the last bit
    CHECK(grey_exchange().factor() == 1.0);
    CHECK(grey_exchange::bed_factor(0.3) == doctest::Approx(0.329).epsilon(1e-14));
}

TEST_CASE("grey_exchange: the factor rises with the emissivity, near it from 0.4 on, and stays at its lowest node") {
    for (double e = 0.2; e < 0.999; e += 0.001)
        CHECK(grey_exchange::bed_factor(e + 0.001) > grey_exchange::bed_factor(e));
    for (double e = 0.4; e <= 1; e += 0.01) CHECK(grey_exchange::bed_factor(e) == doctest::Approx(e).epsilon(0.05));
    CHECK(grey_exchange::bed_factor(0.05) == doctest::Approx(0.254).epsilon(1e-14));
}

TEST_CASE("grey_exchange: an emissivity outside (0, 1] is refused") {
    for (const double bad : {0.0, -0.1, 1.0001, std::numeric_limits<double>::quiet_NaN()}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(grey_exchange{bad}, std::invalid_argument);
    }
    CHECK_THROWS_WITH(grey_exchange{1.5}, "hearth: emissivity of closure grey_exchange is 1.5, allowed: in (0, 1] [-]");
}
