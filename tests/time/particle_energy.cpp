// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/constants.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/particle_energy.hpp>

#include "support/random.hpp"

using namespace hearth;
using hearth_test::seeded;

namespace {

constexpr double pi = constants<double>::pi();
constexpr double sigma = constants<double>::stefan_boltzmann();

// A sphere of 18 mm, 3580 kg/m^3, 1000 J/(kg K), emissivity 1 in surroundings at 2500 K: rate 4 sigma A T^3 / (m c) =
// 0.33 1/s.
struct hot_case {
    double area = pi * 0.018 * 0.018;
    double mass = 3580 * area * 0.018 / 6;
    constant_specific_heat<> caloric{1000};
    heat_bath<> bath;
    hot_case() { bath.add(radiative_link<double>{sigma * area}, 2500.0); }
};

template <class Scheme, class Caloric>
double march(double t, double mass, const Caloric& caloric, const heat_bath<>& bath, double time, int steps) {
    for (int n = 0; n < steps; ++n) t = Scheme::advance(t, mass, caloric, bath, time / steps).temperature;
    return t;
}

template <class Scheme>
double observed_order(const hot_case& c, double exact, int steps) {
    const double coarse = std::fabs(march<Scheme>(300, c.mass, c.caloric, c.bath, 6, steps) - exact);
    const double fine = std::fabs(march<Scheme>(300, c.mass, c.caloric, c.bath, 6, 2 * steps) - exact);
    return std::log2(coarse / fine);
}

/// Time in which a body warms from t0 to t by radiation alone, exactly [in units of m c / (r T_e^3)]:
/// dt = d theta / (1 - theta^4), theta = T / T_e.
double radiative_time(double theta0, double theta) {
    const auto primitive = [](double x) { return 0.5 * std::atan(x) + 0.5 * std::atanh(x); };
    return primitive(theta) - primitive(theta0);
}

TEST_CASE("particle energy: the schemes converge at their order to the exact warming by radiation") {
    const hot_case c;
    const double unit = c.mass * 1000 / (c.bath.radiation * 2500.0 * 2500.0 * 2500.0);
    double lo = 300 / 2500.0, hi = 1 - 1e-15;
    for (int k = 0; k < 200; ++k) {
        const double mid = (lo + hi) / 2;
        (radiative_time(300 / 2500.0, mid) * unit < 6 ? lo : hi) = mid;
    }
    const double exact = 2500 * lo;
    // The asymptotic slope; at 256 steps the next term of the expansion is worth a few hundredths.
    CHECK(observed_order<explicit_euler>(c, exact, 256) == doctest::Approx(1).epsilon(0.03));
    CHECK(observed_order<backward_euler>(c, exact, 256) == doctest::Approx(1).epsilon(0.03));
    CHECK(observed_order<etd2_secant>(c, exact, 256) == doctest::Approx(2).epsilon(0.03));
    // What that is worth: with 64 steps the default is 60 times nearer than backward Euler.
    CHECK(std::fabs(march<etd2_secant>(300, c.mass, c.caloric, c.bath, 6, 64) - exact) < 0.03);
    CHECK(std::fabs(march<backward_euler>(300, c.mass, c.caloric, c.bath, 6, 64) - exact) > 1.0);
}

TEST_CASE("particle energy: the default is exact against a gas with constant properties, at any step") {
    const constant_specific_heat<> caloric{840};
    heat_bath<> bath;
    bath.add(conductive_link<double>{0.05}, 400.0);
    const double mass = 3e-3, rate = 0.05 / (mass * 840);
    for (const double step : {1e-6, 1.0, 50.0, 1e4}) {
        const double exact = 400 - 100 * std::exp(-rate * step);
        CHECK(etd2_secant::advance(300.0, mass, caloric, bath, step).temperature ==
              doctest::Approx(exact).epsilon(1e-15));
    }
}

template <class Scheme>
void never_leaves_the_bounds() {
    // cp from 813 to 1650 J/(kg K) between 250 and 2600 K, of about the bend of a spinel.
    const polynomial_specific_heat<2> bent{{950.0, 0.28}, -1.3e7};
    const constant_specific_heat<> plain{1000};
    for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
        CAPTURE(seed);
        seeded random(seed);
        const double t = random.uniform(250, 2600);
        double low = t, high = t;
        heat_bath<> bath;
        struct partner {
            double k, r, t;
        };
        std::array<partner, 3> partners{};
        for (auto& p : partners) {
            p = {random.uniform(0, 1) < 0.7 ? random.log_uniform(1e-6, 10) : 0.0,
                 random.uniform(0, 1) < 0.7 ? random.log_uniform(1e-15, 1e-9) : 0.0, random.uniform(250, 2600)};
            bath.add(thermal_link<double>{p.k, p.r}, p.t);
            low = std::min(low, p.t);
            high = std::max(high, p.t);
        }
        const double mass = random.log_uniform(1e-9, 1), step = random.log_uniform(1e-9, 1e9);
        const bool curved = random.uniform(0, 1) < 0.5;
        const auto done =
            curved ? Scheme::advance(t, mass, bent, bath, step) : Scheme::advance(t, mass, plain, bath, step);
        const double room = 1e-9 * (high - low) + 1e-13 * high;  // the bar, and round-off where all are equal
        REQUIRE(done.temperature >= low - room);
        REQUIRE(done.temperature <= high + room);

        const double gained = curved ? mass * (bent.enthalpy(done.temperature) - bent.enthalpy(t))
                                     : mass * (plain.enthalpy(done.temperature) - plain.enthalpy(t));
        REQUIRE(done.heat == gained);
        // Sums of a few terms: 16 round-offs of the largest.
        const double largest = std::fabs(done.heat) + std::fabs(done.conducted) + std::fabs(done.radiated);
        if (bath.conductance + bath.radiation > 0)
            REQUIRE(std::fabs(done.conducted + done.radiated - done.heat) <= 16 * 2.3e-16 * largest);
        double given = 0, turnover = 0;
        for (const auto& p : partners) {
            const double s = share(bath, done, step, thermal_link<double>{p.k, p.r}, p.t);
            given += s;
            turnover += std::fabs(s) + step * (p.k * p.t + p.r * std::pow(p.t, 4)) * 1e-3;
        }
        if (bath.conductance + bath.radiation > 0)
            REQUIRE(std::fabs(given - done.heat) <= 1e-12 * (turnover + largest));
    }
}

TEST_CASE("particle energy: the default never leaves the bounds and books every joule, for steps of 1e-9 to 1e9 s") {
    never_leaves_the_bounds<etd2_secant>();
}

TEST_CASE("particle energy: nor does backward Euler") { never_leaves_the_bounds<backward_euler>(); }

TEST_CASE("particle energy: backward Euler solves its equation") {
    const hot_case c;
    for (const double step : {0.1, 6.0, 100.0}) {
        const auto done = backward_euler::advance(300.0, c.mass, c.caloric, c.bath, step);
        const double rate = c.bath.radiation * (std::pow(2500.0, 4) - std::pow(done.temperature, 4));
        // Newton ends within a round-off of T, which the slope of the equation magnifies.
        const double slope = c.mass * 1000 + step * 4 * c.bath.radiation * std::pow(done.temperature, 3);
        CHECK(std::fabs(done.heat - rate * step) <= 4 * 2.3e-16 * done.temperature * slope);
    }
}

TEST_CASE("particle energy: opposite pulls of wall and gas settle where they balance, and the through-flow is booked") {
    heat_bath<> bath;
    bath.add(conductive_link<double>{0.4}, 300.0);
    bath.add(radiative_link<double>{6e-11}, 1500.0);
    const constant_specific_heat<> caloric{1000};
    const auto done = etd2_secant::advance(900.0, 1e-3, caloric, bath, 1e4);
    const auto settled = etd2_secant::advance(done.temperature, 1e-3, caloric, bath, 1e4);
    double t = settled.temperature;
    for (int k = 0; k < 60; ++k) t = etd2_secant::advance(t, 1e-3, caloric, bath, 1e4).temperature;
    const double residual = 0.4 * (300 - t) + 6e-11 * (std::pow(1500.0, 4) - std::pow(t, 4));
    CHECK(std::fabs(residual) < 1e-9 * 0.4 * 600);
    const auto still = etd2_secant::advance(t, 1e-3, caloric, bath, 10.0);
    CHECK(still.conducted == doctest::Approx(0.4 * (300 - t) * 10).epsilon(1e-9));
    CHECK(still.radiated == doctest::Approx(-still.conducted).epsilon(1e-9));
}

TEST_CASE("particle energy: a particle without partners keeps its temperature") {
    const constant_specific_heat<> caloric{1000};
    const auto check = [](const particle_step<double>& done) {
        CHECK(done.temperature == 512.25);
        CHECK(done.heat == 0);
    };
    check(explicit_euler::advance(512.25, 1e-3, caloric, heat_bath<>{}, 1.0));
    check(backward_euler::advance(512.25, 1e-3, caloric, heat_bath<>{}, 1.0));
    check(etd2_secant::advance(512.25, 1e-3, caloric, heat_bath<>{}, 1.0));
}

TEST_CASE("particle energy: float serves") {
    heat_bath<float> bath;
    bath.add(conductive_link<float>{0.05f}, 400.0f);
    bath.add(radiative_link<float>{5e-11f}, 900.0f);
    const constant_specific_heat<float> caloric{840.0f};
    heat_bath<double> exact_bath;
    exact_bath.add(conductive_link<double>{0.05}, 400.0);
    exact_bath.add(radiative_link<double>{5e-11}, 900.0);
    const double exact = etd2_secant::advance(300.0, 3e-3, constant_specific_heat<>{840}, exact_bath, 20.0).temperature;
    CHECK(static_cast<double>(etd2_secant::advance(300.0f, 3e-3f, caloric, bath, 20.0f).temperature) ==
          doctest::Approx(exact).epsilon(2e-6));  // some tens of float round-offs of 6e-8
}

}  // namespace
