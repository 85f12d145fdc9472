// SPDX-License-Identifier: MIT
#include "support/schumann.hpp"

#include <array>
#include <cmath>

#include <doctest/doctest.h>

namespace schumann = hearth_test::schumann;

TEST_CASE("schumann: the oracle of packed beds agrees with values of 30 digits") {
    struct row {
        long double xi, tau, gas, solid;
    };
    // J(xi, tau) and 1 - J(tau, xi) by mpmath with 30 digits, printed with 12.
    constexpr std::array<row, 9> rows{{{0.1L, 0, 0.904837418036L, 0},
                                       {0.1L, 0.5L, 0.940850272418L, 0.364253135684L},
                                       {1, 1, 0.654254161277L, 0.345745838723L},
                                       {2, 5, 0.9139344776L, 0.83143108647L},
                                       {5, 5, 0.563916668582L, 0.436083331418L},
                                       {10, 5, 0.119793752316L, 0.0743920147493L},
                                       {20, 20, 0.531639139938L, 0.468360860062L},
                                       {50, 20, 0.000151358122829L, 9.2765714907e-5L},
                                       {50, 75, 0.989064900212L, 0.986177439879L}}};
    for (const row& r : rows) {
        CAPTURE(r.xi);
        CAPTURE(r.tau);
        // half a unit of the twelfth digit
        CHECK(std::fabs(schumann::gas(r.xi, r.tau) - r.gas) <= 5e-12L * r.gas);
        CHECK(std::fabs(schumann::solid(r.xi, r.tau) - r.solid) <= 5e-12L * r.solid);
    }
}

TEST_CASE("schumann: J(x, y) + J(y, x) = 1 + exp(-x - y) I0(2 sqrt(xy)), also far out") {
    for (const long double x : {0.0L, 0.1L, 3.0L, 50.0L, 400.0L})
        for (const long double y : {0.0L, 0.2L, 7.0L, 300.0L, 2000.0L}) {
            CAPTURE(x);
            CAPTURE(y);
            const long double gap = std::sqrt(x) - std::sqrt(y);
            const long double overlap = std::exp(-gap * gap) * schumann::detail::scaled_bessel_i0(2 * std::sqrt(x * y));
            // both sums are of numbers near 1, in which long double rounds to 5e-20
            CHECK(std::fabs(schumann::gas(x, y) + schumann::gas(y, x) - 1 - overlap) <= 1e-18L);
            CHECK(std::fabs(schumann::gas(x, y) - schumann::solid(x, y) - overlap) <= 1e-18L);
        }
}

TEST_CASE("schumann: gas that has not arrived finds a cold bed") {
    CHECK(schumann::gas(3, -1) == 0);
    CHECK(schumann::solid(3, -1) == 0);
    CHECK(schumann::solid(3, 0) == 0);
    CHECK(schumann::gas(0, 5) == 1);
}

TEST_CASE("schumann: the first gas cools exponentially") {
    for (const long double xi : {0.1L, 5.0L, 50.0L, 400.0L}) {
        CAPTURE(xi);
        // exp(-xi) itself, evaluated as a bell: a round-off of the exponent xi
        CHECK(schumann::gas(xi, 0) == doctest::Approx(static_cast<double>(std::exp(-xi))).epsilon(1e-14));
    }
}
