// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/reactor.hpp>

#include "solvers/combustion/cvode_oracle.hpp"
#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

oracle::state ours(reactor& gas, extents e, double duration, const tolerance& tol) {
    CHECK(integrate(gas, e, duration, tol).finished);
    const per_species n = gas.amount(e);
    return oracle::state_of(n, combine(n).temperature(gas.enthalpy()));
}

constexpr auto variants = {jones_lindstedt::hydrogen_step::a, jones_lindstedt::hydrogen_step::b};

}  // namespace

TEST_CASE("cvode: the oracle's Jacobian is the derivative of its rates") {
    const std::uint64_t seed = 71;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 50; ++i) {
        oracle::reactor_equations f;
        f.exchange_rate = i % 2 ? 1e4 : 0.0;
        f.feed = oracle::state_of(methane_air(0.8), 400);
        const oracle::state y = oracle::state_of(burning_mixture(random), random.uniform(1200, 2600));
        std::array<double, oracle::unknowns> rate, high, low;
        std::array<double, oracle::unknowns * oracle::unknowns> jacobian;
        f(y.data(), rate.data(), jacobian.data());
        for (std::size_t j = 0; j < oracle::unknowns; ++j) {
            oracle::state more = y, less = y;
            const double h = 1e-5 * y[j];
            more[j] += h;
            less[j] -= h;
            f(more.data(), high.data(), nullptr);
            f(less.data(), low.data(), nullptr);
            for (std::size_t k = 0; k < oracle::unknowns; ++k) {
                const double difference = (high[k] - low[k]) / (2 * h);
                double size = 0;  // of the row, in the unit of this column
                for (std::size_t l = 0; l < oracle::unknowns; ++l)
                    size = std::max(size, std::fabs(jacobian[oracle::unknowns * l + k]) * y[l] / y[j]);
                // Truncation (20 h/y)^2, round-off 1e-16/1e-5, the oracle's own slope of cp 1e-6.
                CHECK(std::fabs(difference - jacobian[oracle::unknowns * j + k]) <= 1e-6 * size);
            }
        }
    }
}

TEST_CASE("cvode: an ignition runs the same course, from before to long after") {
    for (const auto variant : variants)
        for (const double ratio : {0.6, 1.0, 1.3})
            for (const double start : {1000.0, 1300.0, 1800.0}) {
                CAPTURE(ratio);
                CAPTURE(start);
                jones_lindstedt m;
                m.variant = variant;
                const per_species n = methane_air(ratio);
                oracle::cvode other({m, 101325, 0, {}});
                for (const double duration : {1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 1e-1}) {
                    CAPTURE(duration);
                    reactor gas(m, n, start, 101325);
                    const oracle::state exact = other.run(oracle::state_of(n, start), duration, 1e-10, 1e-15);
                    // Both are asked for far more than is compared; in the flame itself an error of the ignition's time
                    // grows by some 1e3.
                    CHECK(oracle::deviation(ours(gas, {}, duration, {1e-9, 1e-13}), exact) < 1e-5);
                    CHECK(oracle::deviation(ours(gas, {}, duration, {1e-3, 1e-6}), exact) < 3e-3);
                }
            }
}

TEST_CASE("cvode: burnt gas that meets fresh gas relaxes the same way") {
    const std::uint64_t seed = 72;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    oracle::cvode other({});
    for (int i = 0; i < 40; ++i) {
        const per_species fresh = methane_air(random.uniform(0.6, 1.3));
        const double h = combine(fresh).enthalpy(300), share = random.uniform(0, 0.5);
        per_species n = equilibrium(fresh, h, 101325).amount;
        for (std::size_t k = 0; k < species_count; ++k) n[k] += share * (fresh[k] - n[k]);
        const double t = combine(n).temperature(h);
        reactor gas({}, n, t, 101325);
        const oracle::state exact = other.run(oracle::state_of(n, t), 1e-4, 1e-10, 1e-15);
        CHECK(oracle::deviation(ours(gas, {}, 1e-4, {1e-9, 1e-13}), exact) < 1e-5);
        CHECK(oracle::deviation(ours(gas, {}, 1e-4, {1e-3, 1e-6}), exact) < 3e-3);
    }
}

TEST_CASE("cvode: a perfectly stirred reactor burns and blows out the same way") {
    for (const double ratio : {0.8, 1.0})
        for (const double residence : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
            CAPTURE(ratio);
            CAPTURE(residence);
            const per_species feed = methane_air(ratio);
            const double inlet = 400;
            reactor gas({}, feed, inlet, 101325, 1 / residence);
            // Starts nine tenths burnt.
            const double burnt = 0.9 * feed[CH4];
            const extents e{burnt, 4 * burnt, burnt};
            const per_species n = gas.amount(e);
            const oracle::state start = oracle::state_of(n, combine(n).temperature(gas.enthalpy()));
            oracle::cvode other({{}, 101325, 1 / residence, oracle::state_of(feed, inlet)});
            for (const double duration : {0.3 * residence, 3 * residence, 30 * residence}) {
                CAPTURE(duration);
                const oracle::state exact = other.run(start, duration, 1e-10, 1e-15);
                CHECK(oracle::deviation(ours(gas, e, duration, {1e-9, 1e-13}), exact) < 1e-5);
            }
        }
}
