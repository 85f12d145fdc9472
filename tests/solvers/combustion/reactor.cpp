// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/reactor.hpp>
#include <hearth/core/error.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

/// The state of a reactor at extents e.
mixture_state state_at(const reactor& gas, const extents& e) {
    const per_species n = gas.amount(e);
    return {n, combine(n).temperature(gas.enthalpy())};
}

mixture_state after(double duration, const per_species& n, double temperature, double pressure, const tolerance& tol,
                    const jones_lindstedt& mechanism = {}) {
    reactor gas(mechanism, n, temperature, pressure);
    extents e{};
    CHECK(integrate(gas, e, duration, tol).finished);
    return state_at(gas, e);
}

/// Largest difference of amounts, over the amount of the mixture.
double distance(const per_species& a, const per_species& b) {
    double largest = 0;
    for (std::size_t k = 0; k < species_count; ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
    return largest / sum(b);
}

}  // namespace

TEST_CASE("reactor: the rates of the extents make the species that the steps make") {
    const std::uint64_t seed = 41;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 100; ++i) {
        const per_species n = burning_mixture(random);
        const double t = random.uniform(900, 2600), p = random.log_uniform(1e4, 1e6);
        reactor gas({}, n, t, p);
        extents rate;
        gas.evaluate<false>({}, rate);
        CHECK(gas.temperature() == doctest::Approx(t).epsilon(1e-12));
        const step_rates steps = rates({}, t, p, mole_fractions(n));
        const double density = p / (gas_constant * t * sum(n));
        for (std::size_t k = 0; k < species_count; ++k) {
            double by_extents = 0, by_steps = 0, gross = 0;
            for (std::size_t d = 0; d < extent_count; ++d) by_extents += extent_stoichiometry[d][k] * rate[d];
            for (std::size_t s = 0; s < step_count; ++s) {
                by_steps += stoichiometry[s][k] * steps.net[s] / density;
                gross += 3 * steps.forward[s] / density;
            }
            CHECK(std::fabs(by_extents - by_steps) < 1e-11 * gross);  // the temperature is known to 1e-13, E/RT < 30
        }
    }
}

TEST_CASE("reactor: the Jacobian is the derivative of the rates along the extents, temperature included") {
    const std::uint64_t seed = 42;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 200; ++i) {
        jones_lindstedt m;
        m.variant = i % 2 ? jones_lindstedt::hydrogen_step::a : jones_lindstedt::hydrogen_step::b;
        const per_species n = burning_mixture(random);
        const double exchange = i % 3 ? 0.0 : 1e4;
        reactor gas(m, n, random.uniform(1200, 2600), random.log_uniform(1e4, 1e6), exchange);
        const extents e{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
        extents rate;
        std::array<extents, extent_count> jacobian;
        gas.evaluate<true>(e, rate, &jacobian);
        for (std::size_t j = 0; j < extent_count; ++j) {
            extents more = e, less = e, high, low;
            const double h =
                1e-5;  // the smallest amount is 0.3 mol/kg: truncation (h/0.3)^2, round-off 1e-15/h of the rates
            more[j] += h;
            less[j] -= h;
            gas.evaluate<false>(more, high);
            gas.evaluate<false>(less, low);
            double size = 0;
            for (const extents& row : jacobian)
                for (const double v : row) size = std::max(size, std::fabs(v));
            for (std::size_t d = 0; d < extent_count; ++d)
                CHECK(std::fabs((high[d] - low[d]) / (2 * h) - jacobian[d][j]) < 1e-6 * size);
        }
    }
}

TEST_CASE("reactor: the error falls with the fourth power of the steps") {
    // Half of an ignition, before the methane ends, where the equations are smooth.
    const per_species n = methane_air(1.0);
    const double duration = 2.5e-6, pressure = 101325;
    const per_species exact = after(duration, n, 1500, pressure, {1e-12, 1e-16}).amount;
    std::vector<double> steps, errors;
    for (const double relative : {1e-5, 1e-7, 1e-9}) {
        reactor gas({}, n, 1500, pressure);
        extents e{};
        steps.push_back(static_cast<double>(integrate(gas, e, duration, {relative, 1e-3 * relative}).steps));
        errors.push_back(distance(gas.amount(e), exact));
    }
    const double order = std::log(errors.front() / errors.back()) / std::log(steps.back() / steps.front());
    CAPTURE(errors.front());
    CAPTURE(errors.back());
    CAPTURE(steps.front());
    CAPTURE(steps.back());
    CHECK(order > 3.5);  // step control refines unevenly, so not exactly 4
    CHECK(order < 4.7);
    CHECK(errors.back() < 1e-9);
}

TEST_CASE("reactor: a tighter tolerance gives a smaller error, in a flame's whole course") {
    for (const double start : {1000.0, 1300.0, 1800.0}) {
        CAPTURE(start);
        const per_species n = methane_air(0.9);
        const double duration = 1e-3;
        const per_species exact = after(duration, n, start, 101325, {1e-11, 1e-14}).amount;
        for (const double relative : {1e-3, 1e-5, 1e-7})
            // Stable once burnt: errors of the steps do not add up, but those of the ignition's time remain.
            CHECK(distance(after(duration, n, start, 101325, {relative, 1e-3 * relative}).amount, exact) < relative);
    }
}

TEST_CASE("reactor: from any state, over any time, amounts stay positive and elements and enthalpy stay") {
    const std::uint64_t seed = 43;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 4000; ++i) {
        CAPTURE(i);
        jones_lindstedt m;
        m.variant = i % 4 == 0 ? jones_lindstedt::hydrogen_step::a : jones_lindstedt::hydrogen_step::b;
        const per_species n = any_mixture(random);
        const double t = random.uniform(200, 3500), p = random.log_uniform(1e3, 1e7);
        const double duration = random.log_uniform(1e-6, 1e3);
        reactor gas(m, n, t, p);
        extents e{};
        const integration done = integrate(gas, e, duration, {1e-3, 1e-6});
        CHECK(done.finished);
        const mixture_state end = state_at(gas, e);
        const double total = sum(n);
        for (const double a : end.amount) CHECK(a >= -4e-16 * total);
        CHECK(std::isfinite(end.temperature));
        CHECK(end.temperature > 100);
        const per_element had = element_amounts(n), has = element_amounts(end.amount);
        // Two sums of seven terms, each of an amount with five roundings.
        for (std::size_t k = 0; k < element_count; ++k) CHECK(std::fabs(has[k] - had[k]) < 20 * 2.2e-16 * 4 * total);
        const nasa7 mixture = combine(end.amount);
        CHECK(std::fabs(mixture.enthalpy(end.temperature) - combine(n).enthalpy(t)) <
              60 * 2.2e-16 * (1.6e7 + mixture.heat_capacity(end.temperature) * end.temperature));
    }
}

TEST_CASE("reactor: the reversible mechanism ends in chemical equilibrium") {
    for (const double ratio : {0.3, 0.7, 1.0, 1.2})
        for (const double start : {1200.0, 2000.0}) {
            CAPTURE(ratio);
            CAPTURE(start);
            const per_species n = methane_air(ratio);
            const mixture_state end = after(10.0, n, start, 101325, {1e-6, 1e-9});
            const mixture_state exact = equilibrium(n, combine(n).enthalpy(start), 101325);
            // Where the rates are zero there is no error of the method; methane, which the mechanism does not form
            // again, is below 1e-10 of the equilibrium here.
            CHECK(end.temperature == doctest::Approx(exact.temperature).epsilon(1e-7));
            CHECK(distance(end.amount, exact.amount) < 1e-7);
        }
}

TEST_CASE("reactor: fuel ends in finite time, at zero and not below") {
    reactor gas({}, methane_air(0.8), 1800, 101325);
    extents e{};
    const integration done = integrate(gas, e, 1e-4, {1e-3, 1e-6});
    CHECK(done.limited > 0);
    CHECK(std::fabs(gas.amount(e)[CH4]) <= 4e-16 * sum(methane_air(0.8)));
}

TEST_CASE("reactor: what cannot react stays bit for bit") {
    for (const per_species& parts : {per_species{0, 0, 1, 0, 0, 0, 0}, per_species{0, 1, 4, 0, 0, 0, 0},
                                     per_species{1, 0, 1, 1, 0, 1, 0}, per_species{0, 0, 1, 0, 1, 0, 0}}) {
        const per_species n = amounts_from_moles(parts);
        reactor gas({}, n, 2300, 101325);
        extents e{};
        CHECK(integrate(gas, e, 1e3, {1e-3, 1e-6}).finished);
        CHECK(gas.amount(e) == n);
    }
}

TEST_CASE("reactor: perfectly stirred, it keeps its feed where exchange is fast and ends closed where it is slow") {
    const per_species n = methane_air(0.8);
    const auto steady = [&](double residence_time, bool ignited) {
        reactor gas({}, n, 300, 101325, 1 / residence_time);
        extents e{};
        if (ignited) e = {n[CH4] * 0.99, 4 * n[CH4] * 0.99, n[CH4] * 0.99};
        CHECK(integrate(gas, e, 1e4 * residence_time, {1e-6, 1e-9}).finished);
        const per_species reached = gas.amount(e);
        CHECK(integrate(gas, e, residence_time, {1e-6, 1e-9}).finished);
        CHECK(distance(gas.amount(e), reached) < 1e-9);  // stationary
        return state_at(gas, e).temperature;
    };
    CHECK(steady(1e-3, false) == doctest::Approx(300).epsilon(1e-9));  // cold feed does not ignite
    CHECK(steady(1e-9, true) < 310);                                   // blown out
    const double burnt = equilibrium(n, combine(n).enthalpy(300), 101325).temperature;
    const double slow = steady(1e3, true), fast = steady(1e-4, true);
    CHECK(slow == doctest::Approx(burnt).epsilon(1e-5));
    CHECK(fast < slow - 20);
    CHECK(fast > 1500);
}

TEST_CASE("reactor: with too few steps it says so, and the state is one of its course") {
    const per_species n = methane_air(1.0);
    reactor gas({}, n, 1500, 101325);
    extents e{};
    const integration done = integrate(gas, e, 1e-3, {1e-6, 1e-9}, 20);
    CHECK_FALSE(done.finished);
    CHECK(done.steps + done.rejected == 20);
    for (const double a : gas.amount(e)) CHECK(a >= 0);
    CHECK(state_at(gas, e).temperature > 1500);
}

TEST_CASE("reactor: the same input gives the same bits") {
    const per_species n = methane_air(1.1);
    const mixture_state a = after(1e-3, n, 1234.5, 1e5, {1e-3, 1e-6}), b = after(1e-3, n, 1234.5, 1e5, {1e-3, 1e-6});
    CHECK(a.amount == b.amount);
    CHECK(a.temperature == b.temperature);
}

TEST_CASE("reactor: bad input is refused by name") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto place = [](auto&& call) -> std::string {
        try {
            call();
        } catch (const hearth::bad_value& error) {
            return error.place;
        }
        return "accepted";
    };
    const per_species good = methane_air(1.0);
    per_species negative = good, broken = good;
    negative[CO] = -1e-3;
    broken[H2] = nan;
    for (const per_species& n : {negative, broken})
        CHECK(place([&] { reactor({}, n, 1500, 1e5); }) == "amount of species");
    CHECK(place([&] { reactor({}, per_species{}, 1500, 1e5); }) == "amount of mixture");
    for (const double bad : {nan, -1.0, 0.0}) {
        CHECK(place([&] { reactor({}, good, bad, 1e5); }) == "temperature");
        CHECK(place([&] { reactor({}, good, 1500, bad); }) == "pressure");
    }
    CHECK(place([&] { reactor({}, good, 1500, 1e5, -1); }) == "exchange_rate");
    reactor gas({}, good, 1500, 1e5);
    extents e{};
    CHECK(place([&] { (void)integrate(gas, e, nan, {}); }) == "duration");
    CHECK(place([&] { (void)integrate(gas, e, 1e-4, {0, 1e-6}); }) == "relative tolerance");
    CHECK(place([&] { (void)integrate(gas, e, 1e-4, {1e-3, nan}); }) == "absolute tolerance");
    CHECK(e == extents{});

    for (const per_species& n : {negative, broken}) {
        CHECK(place([&] { burn(n, 0); }) == "amount of species");
        CHECK(place([&] { equilibrium(n, 0, 1e5); }) == "amount of species");
        CHECK(place([&] { equilibrium_at(n, 1500, 1e5); }) == "amount of species");
    }
    CHECK(place([&] { equilibrium(good, nan, 1e5); }) == "enthalpy");
    CHECK(place([&] { equilibrium(good, -1e8, 1e5); }) == "enthalpy");
    CHECK(place([&] { burn(good, nan); }) == "enthalpy");
    CHECK(place([&] { equilibrium(good, 0, -1e5); }) == "pressure");
    CHECK(place([&] { equilibrium_at(good, 100, 1e5); }) == "temperature");
}
