// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "channel.hpp"

using namespace hearth::gas;
using namespace hearth::test;

TEST_CASE("turbulence: a channel follows the log law and Dean's friction") {
    for (const int n : {12, 20}) {
        const channel flow(n);
        CAPTURE(n); CAPTURE(flow.report.reason);
        CHECK(flow.report.converged);
        CHECK(flow.report.mass.error < 1e-10);
        MESSAGE("Cf " << flow.friction << ", Dean " << channel::dean());
        // standard k-epsilon is known to lie some percent below
        CHECK(flow.friction == doctest::Approx(channel::dean()).epsilon(0.10));
        for (const channel::point& p : flow.profile) {
            CAPTURE(p.y_plus);
            // the wake lifts the profile in the outer part
            const double band = p.y < 0.3 * channel::half ? 0.05 : 0.08;
            CHECK(p.u_plus == doctest::Approx(p.log_law).epsilon(band));
        }
    }
}

TEST_CASE("turbulence: lives above the bed and not in it, at any bed's edge") {
    const mesh m(box(graded(0.2, 8), graded(0.2, 8), graded(0.6, 24)));
    solver gas(m, incompressible(), cold());
    for (const char* name : {"x_min", "x_max", "y_min", "y_max"}) gas.set(name, wall());
    gas.set("z_min", mass_flow_inlet(1.2 * 1.0 * 0.04, {}));
    gas.set("z_max", pressure_outlet(101325));
    for (int c = 0; c < m.cells(); ++c) {
        gas.bed.void_fraction[c] = m.centre[c].z < 0.3 ? 0.4 : 1;
        gas.bed.diameter[c] = 0.014;
    }
    gas.initialise(300);
    const report r = gas.steady();
    CAPTURE(r.reason);
    CHECK(r.converged);
    for (int c = 0; c < m.cells(); ++c) {
        CHECK(gas.gas.kinetic[c] > 0);
        if (m.centre[c].z < 0.3) {
            CHECK(gas.gas.eddy_viscosity[c] == 0);
            // 1.5 (0.2 u)^2 with the interstitial velocity of the cell
            const double w = norm(gas.gas.flow.velocity[c]) / 0.4;
            CHECK(gas.gas.kinetic[c] == doctest::Approx(1.5 * 0.04 * w * w).epsilon(0.02));
        } else {
            CHECK(gas.gas.eddy_viscosity[c] > 0);
        }
    }
}
