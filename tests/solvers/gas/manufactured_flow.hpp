// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/gas/flow.hpp>

#include "manufactured.hpp"

namespace manufactured {

using namespace hearth::gas;

/// A medium that rests, without friction, with the fields that a flow_medium only looks into.
struct resting_medium : flow_medium {
    resting_medium(const mesh& m, double rho)
        : densities(m.cells(), rho), voids(m.cells(), 1.0), viscosities(m.cells(), 0.0), forces(m.cells()) {
        density = densities;
        void_fraction = voids;
        momentum_source = forces;
        viscosity = viscosities;
        for (auto* field : {&exchange, &mass_source}) field->assign(m.cells(), 0.0);
    }
    array<double> densities, voids, viscosities;
    array<vector3> forces;
};

inline flow_boundary slip_everywhere(const mesh& m) {
    const auto n = static_cast<std::size_t>(m.boundary_faces());
    flow_boundary b;
    b.type.assign(n, flow_boundary::kind::slip);
    b.mass_flux.assign(n, 0.0);
    b.pressure.assign(n, 0.0);
    b.wall_viscosity.assign(n, 0.0);
    b.velocity.assign(n, {});
    return b;
}

struct errors {
    double velocity, pressure;
    int iterations;
};

/// Flow through a bed of smoothly varying void fraction with drag, friction and inertia, every term of order one.
inline errors solve_flow(const mesh& m, double reynolds) {
    const double density = 1.3, viscosity = density / reynolds, drag = 0.7;
    const function stream = [](const vector3& x) {
        return x.y + 0.3 / pi * std::sin(pi * x.x + 0.2) * std::sin(pi * x.y + 0.3);
    };
    const function void_fraction = [](const vector3& x) {
        return 0.65 + 0.25 * std::cos(pi * x.x) * std::cos(pi * x.y);
    };
    const function pressure = [](const vector3& x) { return std::cos(pi * x.x) * std::sin(pi * x.y); };
    const function w[2] = {[&](const vector3& x) { return derivative(stream, x, 1); },
                           [&](const vector3& x) { return -derivative(stream, x, 0); }};
    resting_medium medium(m, density);
    flow_boundary boundary = slip_everywhere(m);
    for (int c = 0; c < m.cells(); ++c) {
        const vector3& x = m.centre[c];
        const double e = void_fraction(x);
        medium.voids[c] = e;
        medium.viscosities[c] = viscosity;
        medium.exchange[c] = drag;
        for (int k = 0; k < 2; ++k) {
            const function u = [&](const vector3& y) { return w[k](y) / void_fraction(y); };
            double friction = 0, inertia = 0;
            for (int i = 0; i < 2; ++i) {
                friction += derivative([&](const vector3& y) { return derivative(w[k], y, i); }, x, i);
                inertia += density * w[i](x) * derivative(u, x, i);
            }
            const double force = inertia - viscosity * friction + e * derivative(pressure, x, k) + drag * u(x);
            medium.forces[c][k] = force * m.volume[c];
        }
    }
    for (int f = m.internal_faces(); f < m.faces(); ++f) {
        const int b = f - m.internal_faces();
        const vector3 s = m.area[f];
        if (std::abs(s.z) > 0.5 * norm(s)) continue;
        boundary.type[b] = flow_boundary::kind::inlet;
        boundary.velocity[b] = {w[0](m.face_centre[f]), w[1](m.face_centre[f]), 0};
        boundary.wall_viscosity[b] = viscosity;
        // exact flux of a stream function: its difference between the ends of the edge, so that all of them add up to 0
        const auto corner = [&](int i) { return m.shape.points[m.shape.face_points[m.shape.face_first[f] + i]]; };
        for (int i = 0; i < 4; ++i) {
            const vector3 from = corner(i), to = corner((i + 1) % 4);
            if (from.z > 1e-9 || to.z > 1e-9) continue;
            const double turn = cross(to - from, {0, 0, 1}).x * s.x + cross(to - from, {0, 0, 1}).y * s.y;
            boundary.mass_flux[b] =
                (turn > 0 ? 1 : -1) * density * (stream(to) - stream(from)) * norm(s) / norm(to - from);
        }
    }
    const pattern p(m);
    const gradient g(m);
    const parallel one;
    workspace work(p);
    flow solver(m, p, g, one, work);
    flow_state state = solver.make_state();
    flow_settings settings;
    settings.inertia = false;
    settings.resistance_floor = 1;
    settings.relaxation = 0.9;
    solver.iterate(state, medium, boundary, {}, settings);
    settings.inertia = true;
    int i = 0;
    for (double change = 1; change > 1e-8 && i < 800; ++i)
        change = solver.iterate(state, medium, boundary, {}, settings).velocity_change;
    return {std::hypot(error(
                           m, [&](int c) { return state.velocity[c].x; }, w[0], false),
                       error(
                           m, [&](int c) { return state.velocity[c].y; }, w[1], false)),
            error(
                m, [&](int c) { return state.pressure[c]; }, pressure, true, true),
            i};
}

}  // namespace manufactured
