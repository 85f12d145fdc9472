// SPDX-License-Identifier: MIT
#include <cmath>
#include <memory>
#include <random>

#include <doctest/doctest.h>

#include <hearth/gas/solver.hpp>

#include "manufactured.hpp"
#include "two_gases.hpp"

using namespace hearth::gas;
using manufactured::derivative;
using manufactured::pi;

namespace {

struct scalar_error { double error; int iterations; };

/// Convection by a stream function and diffusion of one scalar, every term of order one.  The error is that of the cells
/// off the boundary: what leaves takes the value of its cell, which is first order there.
scalar_error solve_manufactured(const mesh& m, double diffusivity) {
    const manufactured::function stream = [](const vector3& x) {
        return x.y + 0.3 / pi * std::sin(pi * x.x + 0.2) * std::sin(pi * x.y);  // walls at y = 0 and 1
    };
    const manufactured::function exact = [](const vector3& x) {
        return 1 + 0.3 * std::exp(0.7 * x.x + 0.5 * x.y) + 0.2 * std::sin(0.9 * x.x + 1.2 * x.y);  // no extremum inside
    };
    const manufactured::function source = [&](const vector3& x) {
        double laplacian = 0;
        for (int i = 0; i < 2; ++i)
            laplacian += derivative([&](const vector3& y) { return derivative(exact, y, i); }, x, i);
        return derivative(stream, x, 1) * derivative(exact, x, 0) - derivative(stream, x, 0) * derivative(exact, x, 1) -
               diffusivity * laplacian;
    };
    const pattern p(m);
    const gradient g(m);
    const parallel one;
    workspace work(p);
    transport t(m, p, g, one, work);
    t.diffusivity.assign(m.cells(), diffusivity);
    array<double> flux(m.faces(), 0.0), outside(m.boundary_faces(), 0.0),
        conducting(m.boundary_faces(), 0.0), field(m.cells(), 1.0);
    for (int f = 0; f < m.faces(); ++f) {
        const vector3 s = m.area[f];
        if (std::abs(s.z) > 0.5 * norm(s)) continue;
        for (int i = 0; i < 4; ++i) {  // of the two edges in the plane z = 0 and its mirror, the lower one
            const vector3 a = m.shape.points[m.shape.face_points[m.shape.face_first[f] + i]];
            const vector3 b = m.shape.points[m.shape.face_points[m.shape.face_first[f] + (i + 1) % 4]];
            if (a.z > 1e-9 || b.z > 1e-9) continue;
            const double turn = dot(cross(b - a, {0, 0, 1}), s);
            flux[f] = (turn > 0 ? 1 : -1) * (stream(b) - stream(a)) * norm(s) / norm(b - a);
        }
        if (f >= m.internal_faces()) {
            outside[f - m.internal_faces()] = exact(m.face_centre[f]);
            conducting[f - m.internal_faces()] = diffusivity * m.conductance[f];
        }
    }
    double change = 1;
    int i = 0;
    for (; change > 1e-11 && i < 300; ++i) {
        t.assemble(flux, conducting);
        t.start(field.data(), outside);
        for (int c = 0; c < m.cells(); ++c) t.right[c] += m.volume[c] * source(m.centre[c]);
        const array<double> before = field;
        t.solve(field.data(), {1e-8, 0, 500});
        change = 0;
        for (int c = 0; c < m.cells(); ++c) change = std::max(change, std::abs(field[c] - before[c]));
    }
    return {manufactured::error(m, [&](int c) { return field[c]; }, exact, false, true), i};
}

solver_settings warm() {
    solver_settings s;
    s.gravity = {0, 0, 0};
    s.turbulence = false;
    s.tolerance = 3e-7;
    return s;
}

void check_balances(const report& r) {
    CHECK(r.mass.error < 1e-10);
    CHECK(r.enthalpy.error < 1e-10);
    for (const balance& s : r.species) CHECK(s.error < 1e-10);
}

}  // namespace

TEST_CASE("transport: manufactured solution, second order on smooth meshes, first on shaken ones") {
    struct row { double bend, shake, diffusivity, least_order; };
    // Without diffusion the one-sided slopes in the cells along walls cost some order.
    for (const row& r : {row{0, 0, 0.05, 1.9}, row{0.04, 0, 0.05, 1.9}, row{0.04, 0, 1e-5, 1.6}, row{0, 0.3, 0.05, 1.0}}) {
        double last = 0;
        for (const int n : {16, 32, 64}) {
            const scalar_error e = solve_manufactured(manufactured::square(n, r.bend, r.shake), r.diffusivity);
            const double order = std::log2(last / e.error);
            CAPTURE(r.bend); CAPTURE(r.shake); CAPTURE(r.diffusivity); CAPTURE(n);
            MESSAGE("error " << e.error << " order " << order << ", iterations " << e.iterations);
            CHECK(e.iterations < 300);
            if (n == 64) CHECK(order >= r.least_order);
            last = e.error;
        }
    }
}

TEST_CASE("heat: a tube with transmittance cools as its number of transfer units says") {
    // exp(-U perimeter L / (m c)) for plug flow of constant c; the mesh adds (NTU per cell)^2 / 12 in the exponent
    const double side = 0.1, length = 2, flow = 0.01, u = 25, ambient = 320, heat = 1005;
    const mesh m(box(graded(side, 1), graded(side, 1), graded(length, 200)));
    solver gas(m, std::make_shared<simple_gas>(), warm());
    for (const char* name : {"x_min", "x_max", "y_min", "y_max"}) gas.set(name, wall(wall_heat{u, ambient}));
    gas.set("x_min", wall(wall_heat{9, 500}));  // set again: the last one counts
    gas.set("x_min", wall(wall_heat{u, ambient}));
    gas.set("z_min", mass_flow_inlet(flow, {1200}));
    gas.set("z_max", pressure_outlet(1e5));
    gas.initialise(300);
    const report r = gas.steady();
    CAPTURE(r.reason);
    CHECK(r.converged);
    check_balances(r);
    const double units = u * 4 * side * length / (flow * heat);
    const double expected = ambient + (1200 - ambient) * std::exp(-units);
    CHECK(gas.mean_temperature("z_max") == doctest::Approx(expected).epsilon(1e-4));
}

TEST_CASE("heat: exchange with particles is implicit, keeps between both temperatures, and what one loses the other gains") {
    const mesh m(box(graded(0.1, 1), graded(0.1, 1), graded(0.5, 50)));
    for (const double conductance : {1e-6, 1e-2, 1.0, 1e4}) {
        solver gas(m, std::make_shared<two_gases>(), warm());
        gas.set("z_min", mass_flow_inlet(0.02, {400, {0.1, 0.9}}));
        gas.set("z_max", pressure_outlet(1e5, {400, {0, 1}}));
        for (const char* name : {"x_min", "x_max", "y_min", "y_max"}) gas.set(name, slip());
        std::fill(gas.bed.void_fraction.begin(), gas.bed.void_fraction.end(), 0.4);
        for (int c = 0; c < m.cells(); ++c) {
            gas.bed.heat_conductance[c] = conductance;
            gas.bed.heat_source[c] = conductance * 2300;
        }
        gas.initialise(300, {0, 1});
        const report r = gas.steady();
        CAPTURE(conductance); CAPTURE(r.reason);
        CHECK(r.converged);
        check_balances(r);
        double taken = 0;
        for (int c = 0; c < m.cells(); ++c) {
            CHECK(gas.gas.temperature[c] > 400 - 1e-6);
            CHECK(gas.gas.temperature[c] < 2300 + 1e-6);
            CHECK(gas.gas.mass_fraction[2 * c] == doctest::Approx(0.1).epsilon(1e-9));
            taken += conductance * (2300 - gas.gas.temperature[c]);
        }
        CHECK(taken == doctest::Approx(r.enthalpy.out - r.enthalpy.in).epsilon(1e-8));
    }
}

TEST_CASE("heat: time steps from 1e-6 to 1e3 s conserve mass, enthalpy and species, for any storage factor") {
    const mesh m(box(graded(0.2, 2), graded(0.2, 2), graded(0.5, 10)));
    for (const double storage : {1.0, 1.0 / 678, 1e-4}) {
        for (const double dt : {1e-6, 1e-3, 1.0, 1e3}) {
            solver gas(m, std::make_shared<two_gases>(), warm());
            gas.set("z_min", mass_flow_inlet(0.05, {400, {0.2, 0.8}}));
            gas.set("z_max", pressure_outlet(1e5, {400, {0, 1}}));
            for (int c = 0; c < m.cells(); ++c) {
                gas.bed.void_fraction[c] = m.centre[c].z < 0.25 ? 0.4 : 1;
                gas.bed.heat_conductance[c] = m.centre[c].z < 0.25 ? 0.5 : 0;
                gas.bed.heat_source[c] = gas.bed.heat_conductance[c] * 1500;
            }
            gas.initialise(600, {0.05, 0.95});
            for (int i = 0; i < 3; ++i) {
                const report r = gas.step(dt, storage);
                CAPTURE(storage); CAPTURE(dt); CAPTURE(i); CAPTURE(r.reason); CAPTURE(r.iterations);
                CHECK(r.converged);
                check_balances(r);
            }
            for (int c = 0; c < m.cells(); ++c) {
                CHECK(gas.gas.temperature[c] > 400 - 1e-6);
                CHECK(gas.gas.temperature[c] < 1500 + 1e-6);
                CHECK(gas.gas.mass_fraction[2 * c] > 0.05 - 1e-9);
                CHECK(gas.gas.mass_fraction[2 * c] < 0.2 + 1e-7);
            }
        }
    }
}

TEST_CASE("heat: a reaction of any rate drives to its mixture, keeps all balances and leaves no range") {
    const mesh m(box(graded(0.1, 1), graded(0.1, 1), graded(1, 40)));
    for (const double rate : {1e-3, 1.0, 1e6}) {
        CAPTURE(rate);
        solver gas(m, std::make_shared<two_gases>(), warm());
        gas.set("z_min", mass_flow_inlet(0.01, {900, {0.05, 0.95}}));
        gas.set("z_max", pressure_outlet(1.01325e5, {900, {0.05, 0.95}}));
        for (const char* name : {"x_min", "x_max", "y_min", "y_max"}) gas.set(name, slip());
        gas.sources.conversion.assign(2 * m.cells(), 0.0);
        gas.sources.converted.assign(2 * m.cells(), 0.0);
        for (int c = 0; c < m.cells(); ++c) {
            gas.sources.conversion[2 * c] = rate * 0.01 / m.cells();
            gas.sources.converted[2 * c] = 0.02;
        }
        gas.initialise(900, {0.05, 0.95});
        const report r = gas.steady();
        CHECK(r.converged);
        CHECK(r.mass.error < 1e-10);
        CHECK(r.enthalpy.error < 1e-8);
        CHECK(r.species[0].error < 1e-8);
        for (int c = 0; c < m.cells(); ++c) {
            CHECK(gas.gas.mass_fraction[2 * c] >= 0.02 - 1e-12);
            CHECK(gas.gas.mass_fraction[2 * c] <= 0.05 + 1e-12);
        }
        // It changes with the way: dY/dx = rate (0.02 - Y), so what leaves is exp(-rate) from the mixture that it is driven to; what
        // leaves is taken from the last cell, half of its length before the end.
        const double off = (r.species[0].out / 0.01 - 0.02) / 0.03;
        CHECK(std::abs(off - std::exp(-rate)) < rate * std::exp(-rate) / 80 + 1e-3);
    }
}

TEST_CASE("heat: nozzles bring their mass, momentum, enthalpy and species") {
    const mesh m(box(graded(0.3, 6), graded(0.3, 6), graded(0.5, 10)));
    auto settings = warm();
    settings.max_iterations = 4000;
    solver gas(m, std::make_shared<two_gases>(), settings);
    gas.set("z_min", mass_flow_inlet(0.05, {900, {0, 1}}));
    gas.set("z_max", pressure_outlet(1e5, {300, {0, 1}}));
    std::fill(gas.bed.void_fraction.begin(), gas.bed.void_fraction.end(), 0.42);
    gas.add(nozzle{m.find_cell({0.02, 0.15, 0.2}), 0.01, {70, 0, 0}, {300, {0.06, 0.94}}});
    gas.initialise(900, {0, 1});
    const report r = gas.steady();
    CAPTURE(r.reason);
    CHECK(r.converged);
    check_balances(r);
    CHECK(gas.mass_flow("z_max") == doctest::Approx(0.06).epsilon(1e-10));
    CHECK(r.species[0].out == doctest::Approx(0.0006).epsilon(1e-9));
    CHECK_THROWS_AS(gas.add(nozzle{-1, 0.01, {}, {}}), std::invalid_argument);
    CHECK_THROWS_AS(gas.add(nozzle{0, 0.01, {}, {300, {1}}}), std::invalid_argument);
}

TEST_CASE("heat: drying particles add vapour; a step of the inlet runs through at first order in time") {
    const mesh m(box(graded(0.1, 1), graded(0.1, 1), graded(1, 20)));
    solver gas(m, std::make_shared<two_gases>(), warm());
    gas.set("z_min", mass_flow_inlet(0.01, {400, {0, 1}}));
    gas.set("z_max", pressure_outlet(1e5, {400, {0, 1}}));
    for (const char* name : {"x_min", "x_max", "y_min", "y_max"}) gas.set(name, slip());
    const double vapour[2] = {1, 0};
    for (int c = 0; c < m.cells(); ++c) {
        gas.sources.species[2 * c] = 1e-5;
        gas.sources.enthalpy[c] = 1e-5 * gas.model().enthalpy(350, vapour);
    }
    gas.initialise(400, {0, 1});
    const report r = gas.steady();
    CAPTURE(r.reason);
    CHECK(r.converged);
    check_balances(r);
    CHECK(gas.mass_flow("z_max") == doctest::Approx(0.01 + 20e-5).epsilon(1e-10));
    CHECK(gas.gas.mass_fraction[2 * 19] == doctest::Approx(20e-5 / (0.01 + 20e-5)).epsilon(1e-8));
}
