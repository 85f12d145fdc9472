// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/time/caloric.hpp>
#include <hearth/time/through_flow.hpp>

#include "support/random.hpp"

using namespace hearth;

namespace {

/// The gas along the cell in many small explicit steps: mean and outlet temperature, second order.
through_flow<>::outcome integrated(double flow, double ha, double storage, double inlet, double before, double solid) {
    const int steps = 20000;
    double t = inlet, sum = 0;
    const auto slope = [&](double x) { return (ha * (solid - x) + storage * (before - x)) / flow; };
    for (int n = 0; n < steps; ++n) {
        const double middle = t + slope(t) / (2.0 * steps);
        sum += middle;
        t += slope(middle) / steps;
    }
    return {sum / steps, t};
}

TEST_CASE("through flow: is the exact solution along the cell") {
    hearth_test::seeded random(3);
    for (int k = 0; k < 200; ++k) {
        const double flow = random.log_uniform(0.1, 10), ha = flow * random.log_uniform(1e-3, 20);
        const double storage = k % 3 == 0 ? 0.0 : flow * random.log_uniform(1e-3, 20);
        const double inlet = random.uniform(300, 2000), before = random.uniform(300, 2000);
        const double solid = random.uniform(300, 2000);
        const through_flow<> cell(flow, ha, storage, inlet, before);
        const double heat = cell.conductance() * (cell.temperature() - solid);
        const auto gas = cell.settle(heat);
        const auto exact = integrated(flow, ha, storage, inlet, before, solid);
        CAPTURE(k);
        // Midpoint rule: (transfer units / steps)^2 of the range, 4e-6 of 1700 K.
        REQUIRE(std::fabs(gas.mean - exact.mean) < 0.01);
        REQUIRE(std::fabs(gas.outlet - exact.outlet) < 0.01);
        // What particles take is hA times the gap of the means.
        REQUIRE(heat == doctest::Approx(ha * (gas.mean - solid)).epsilon(1e-9).scale(ha * 1000));
    }
}

TEST_CASE("through flow: bounded and conservative from no transfer units to a million") {
    hearth_test::seeded random(4);
    const constant_specific_heat<> caloric{1000};
    for (int k = 0; k < 20000; ++k) {
        CAPTURE(k);
        const double flow = random.log_uniform(1e-3, 1e3);
        const double ha = random.uniform(0, 1) < 0.1 ? 0.0 : flow * random.log_uniform(1e-12, 1e6);
        const double storage = random.uniform(0, 1) < 0.3 ? 0.0 : flow * random.log_uniform(1e-12, 1e6);
        const double inlet = random.uniform(300, 2000), before = random.uniform(300, 2000);
        const double solid = random.uniform(300, 2000), step = random.log_uniform(1e-9, 1e9);
        const double low = std::fmin(inlet, std::fmin(before, solid)),
                     high = std::fmax(inlet, std::fmax(before, solid));
        const double room = 1e-9 * (high - low);
        const through_flow<> cell(flow, ha, storage, inlet, before);
        // Below a millionth of exchange in a step, the round-off of the particle's enthalpy is what the gas would feel.
        const double mass = std::fmax(cell.conductance(), 1e-9) * step / 1000 * random.log_uniform(1e-6, 1e6);
        const auto taken = etd2_secant::advance(solid, mass, caloric, cell.bath(), step);
        const auto gas = cell.settle(taken.heat / step);
        for (const double t : {taken.temperature, gas.mean, gas.outlet}) {
            REQUIRE(t >= low - room);
            REQUIRE(t <= high + room);
        }
        const double in = flow * (inlet - gas.outlet), kept = storage * (gas.mean - before), given = taken.heat / step;
        REQUIRE(std::fabs(in - kept - given) <= 1e-12 * (flow * inlet + storage * before + std::fabs(given)));
    }
}

}  // namespace
