// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

namespace hearth::test {

/// Turbulent flow without heat and gravity.
inline gas::solver_settings cold() {
    gas::solver_settings s;
    s.energy = false;
    s.gravity = {0, 0, 0};
    s.flow.relaxation = 0.5;
    s.flow.momentum_sweeps = 8;  // cells far narrower than long: two sweeps carry friction across the channel slowly
    s.max_iterations = 2500;
    return s;
}

inline std::shared_ptr<gas::simple_gas> incompressible() {
    auto air = std::make_shared<gas::simple_gas>();
    air->constant_density = 1.2;
    air->sutherland = 0;
    air->viscosity_reference = 1.8e-5;
    return air;
}

/// Half a channel of Re 67000 on its height, 60 heights long; the profile two cells before the end.
struct channel {
    static constexpr double half = 0.05, speed = 10, length = 60 * 2 * half, density = 1.2, viscosity = 1.8e-5;
    struct point {
        double y, y_plus, u_plus, log_law;
    };  ///< [m], then in wall units

    explicit channel(int n) {
        using namespace gas;
        const mesh m(box(graded(length, 80, 4), graded(half, n), graded(0.01, 1)));
        solver flow(m, incompressible(), cold());
        for (const char* name : {"z_min", "z_max", "y_max"}) flow.set(name, slip());
        flow.set("y_min", wall());
        stream in;
        in.turbulence_length = 0.005;
        flow.set("x_min", mass_flow_inlet(density * speed * half * 0.01, in));
        flow.set("x_max", pressure_outlet(101325));
        flow.initialise(300);
        report = flow.steady();
        double gradient = 0;
        for (int j = 0; j < n; ++j) gradient -= flow.gas.flow.pressure_gradient[76 + 80 * j].x / n;
        const double stress = gradient * half, friction_velocity = std::sqrt(stress / density);
        friction = stress / (0.5 * density * speed * speed);
        for (int j = 0; j < n; ++j) {
            const int c = 76 + 80 * j;
            const double y = m.centre[c].y, y_plus = density * friction_velocity * y / viscosity;
            profile.push_back(
                {y, y_plus, flow.gas.flow.velocity[c].x / friction_velocity, std::log(9.8 * y_plus) / 0.41});
        }
    }

    /// Dean (1978): Cf = 0.073 Re^-0.25, data within 5 %.
    static double dean() { return 0.073 * std::pow(density * speed * 2 * half / viscosity, -0.25); }

    gas::report report;
    double friction = 0;  ///< wall stress over the mean flow's dynamic pressure [-]
    std::vector<point> profile;
};

}  // namespace hearth::test
