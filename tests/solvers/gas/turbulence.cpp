// SPDX-License-Identifier: MIT
#include <cmath>
#include <memory>

#include <doctest/doctest.h>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

using namespace hearth::gas;

namespace {

solver_settings cold() {
    solver_settings s;
    s.energy = false;
    s.gravity = {0, 0, 0};
    s.flow.relaxation = 0.5;
    s.flow.momentum_sweeps = 8;  // cells far narrower than long: two sweeps carry friction across the channel slowly
    s.max_iterations = 2500;
    return s;
}

std::shared_ptr<simple_gas> incompressible() {
    auto air = std::make_shared<simple_gas>();
    air->constant_density = 1.2;
    air->sutherland = 0;
    air->viscosity_reference = 1.8e-5;
    return air;
}

}  // namespace

TEST_CASE("turbulence: a channel follows the log law and Dean's friction") {
    // half channel of Re 67000 on the height, 60 heights long; the profile 2 cells before the end
    const double half = 0.05, speed = 10, length = 60 * 2 * half, density = 1.2, viscosity = 1.8e-5;
    for (const int n : {12, 20}) {
        const mesh m(box(graded(length, 80, 4), graded(half, n), graded(0.01, 1)));
        solver gas(m, incompressible(), cold());
        for (const char* name : {"z_min", "z_max", "y_max"}) gas.set(name, slip());
        gas.set("y_min", wall());
        stream in;
        in.turbulence_length = 0.005;
        gas.set("x_min", mass_flow_inlet(density * speed * half * 0.01, in));
        gas.set("x_max", pressure_outlet(101325));
        gas.initialise(300);
        const report r = gas.steady();
        CAPTURE(n); CAPTURE(r.reason);
        CHECK(r.converged);
        CHECK(r.mass.error < 1e-10);
        double gradient = 0;
        for (int j = 0; j < n; ++j) gradient -= gas.gas.flow.pressure_gradient[76 + 80 * j].x / n;
        const double stress = gradient * half, friction_velocity = std::sqrt(stress / density);
        // Dean (1978): Cf = 0.073 Re^-0.25, data within 5 %; standard k-epsilon is known to lie some percent below
        const double friction = stress / (0.5 * density * speed * speed);
        const double dean = 0.073 * std::pow(density * speed * 2 * half / viscosity, -0.25);
        MESSAGE("Cf " << friction << ", Dean " << dean);
        CHECK(friction == doctest::Approx(dean).epsilon(0.10));
        for (int j = 0; j < n; ++j) {
            const int c = 76 + 80 * j;
            const double y_plus = density * friction_velocity * m.centre[c].y / viscosity;
            const double log_law = std::log(9.8 * y_plus) / 0.41;
            CAPTURE(y_plus);
            // the wake lifts the profile in the outer part
            const double band = m.centre[c].y < 0.3 * half ? 0.05 : 0.08;
            CHECK(gas.gas.flow.velocity[c].x / friction_velocity == doctest::Approx(log_law).epsilon(band));
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
