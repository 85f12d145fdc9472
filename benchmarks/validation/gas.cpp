// SPDX-License-Identifier: MIT
// The gas solver for examples/solvers/README.md, as tables: gas FOLDER [TABLE ...].
//   orders   errors of a manufactured flow over the mesh
//   channel  turbulent channel in wall units
//   jump     gas that leaves a bed: pressure over the height
#include <string>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

#include "solvers/gas/channel.hpp"
#include "solvers/gas/manufactured_flow.hpp"
#include "support/tables.hpp"

namespace {

void orders(std::ostream& out) {
    out << "mesh cells velocity pressure\n";
    struct kind {
        const char* name;
        double bend, shake;
    };
    for (const kind& k : {kind{"straight", 0, 0}, kind{"bent", 0.04, 0}, kind{"shaken", 0, 0.3}})
        for (const int n : {16, 32, 64, 128}) {
            const auto e = manufactured::solve_flow(manufactured::square(n, k.bend, k.shake), 50);
            out << k.name << ' ' << n << ' ' << e.velocity << ' ' << e.pressure << std::endl;
        }
}

void channel(std::ostream& out) {
    out << "cells y_plus u_plus log_law\n";
    for (const int n : {12, 20}) {
        const hearth::test::channel flow(n);
        for (const auto& p : flow.profile)
            out << n << ' ' << p.y_plus << ' ' << p.u_plus << ' ' << p.log_law << std::endl;
    }
}

/// Along a column of 2 by 2 by `levels` cells that are bed up to the middle: pressure over the dynamic pressure in the
/// bed.
void jump(std::ostream& out) {
    using namespace hearth::gas;
    out << "void_fraction height pressure exact\n";
    constexpr int levels = 40;
    constexpr double speed = 1, density = 1.2, length = 0.3, viscosity = 1.8e-5, diameter = 0.01;
    const mesh m(box(graded(0.1, 2), graded(0.1, 2), graded(length, levels)));
    for (const double e : {0.1, 0.4, 0.8}) {
        solver_settings settings = hearth::test::cold();
        settings.turbulence = false;
        settings.tolerance = 1e-10;
        solver gas(m, hearth::test::incompressible(), settings);
        for (const char* side : {"x_min", "x_max", "y_min", "y_max"}) gas.set(side, slip());
        gas.set("z_min", mass_flow_inlet(density * speed * 0.01, {300}));
        gas.set("z_max", pressure_outlet(settings.reference_pressure));
        for (int c = 0; c < m.cells(); ++c) {
            gas.bed.void_fraction[c] = m.centre[c].z < 0.5 * length ? e : 1;
            gas.bed.diameter[c] = diameter;
        }
        gas.initialise(300);
        if (!gas.steady().converged) throw std::runtime_error("the column did not come to rest");
        const double dynamic = 0.5 * density * speed * speed / (e * e);
        const double ergun = hearth::closure::pressure_gradient(
            hearth::closure::ergun{}, hearth::closure::bed_flow<double>{e, speed / e, density, viscosity, diameter});
        for (int k = 0; k < levels; ++k) {
            const double z = m.centre[4 * k].z, below = 0.5 * length - z;
            const double exact = below > 0 ? ergun * below - dynamic * (1 - e * e) : 0;
            out << e << ' ' << z << ' ' << gas.gas.flow.pressure[4 * k] / dynamic << ' ' << exact / dynamic
                << std::endl;
        }
    }
}

}  // namespace

int main(int count, char** words) {
    return bench::write_tables(count, words, {{"orders", orders}, {"channel", channel}, {"jump", jump}});
}
