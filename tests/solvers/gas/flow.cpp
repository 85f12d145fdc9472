// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include "manufactured_flow.hpp"

TEST_CASE("flow: manufactured solution, second order on smooth meshes, first on shaken ones") {
    // The pressure's error is that of the cells off the boundary: in the others half a cell's friction is first order.
    // Its order still rises with n where viscosity counts (Re 1).
    struct row { double bend, shake, reynolds, velocity_order, pressure_order; int finest; };
    for (const row& r : {row{0, 0, 50, 1.8, 1.8, 128}, row{0.04, 0, 50, 1.8, 1.75, 64}, row{0.04, 0, 1, 1.8, 1.75, 64},
                         row{0, 0.3, 50, 1.0, 1.0, 64}}) {
        manufactured::errors last{0, 0, 0};
        for (int n = r.finest / 4; n <= r.finest; n *= 2) {
            const manufactured::errors e = manufactured::solve_flow(manufactured::square(n, r.bend, r.shake), r.reynolds);
            const double order_u = std::log2(last.velocity / e.velocity), order_p = std::log2(last.pressure / e.pressure);
            CAPTURE(r.bend); CAPTURE(r.shake); CAPTURE(r.reynolds); CAPTURE(n);
            MESSAGE("velocity " << e.velocity << " order " << order_u << ", pressure " << e.pressure << " order "
                                << order_p << ", iterations " << e.iterations);
            CHECK(e.iterations < 800);
            if (n == r.finest) {
                CHECK(order_u >= r.velocity_order);
                CHECK(order_p >= r.pressure_order);
            }
            last = e;
        }
    }
}
