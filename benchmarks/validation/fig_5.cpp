// SPDX-License-Identifier: MIT
// Fig. 5 of Spijker et al. (2023) for examples/solvers/README.md, as tables: fig_5 FOLDER [TABLE ...].
//   cubic     drag in simple cubic arrays of spheres that the mesh resolves, beside Zick and Homsy
//   sphere    drag of one such sphere in a wide stream, beside Schiller and Naumann
//   speeds    pressure gradient of a bed in a tube by Ergun in cells of voids, over speed and method
//   work      the same at one speed: gradient and run time over method and cells per diameter
//   wide      the same without side walls, over what Ergun gives for the bed's own profile
//   resolved  the bed of the tube with spheres that the mesh resolves, over speed and cells per diameter
#include <algorithm>
#include <cmath>
#include <string>

#include <hearth/closure/eisfeld_schnitzlein.hpp>

#include "packed_bed/methods.hpp"
#include "support/blown_bed.hpp"
#include "support/resolved_bed.hpp"
#include "support/tables.hpp"

namespace {

using namespace hearth::test;
using bench::cpu_seconds;

constexpr double tube_to_particle = 4;
constexpr auto speeds_of_figure = {0.02, 0.2, 0.5, 1.0, 1.5, 2.0};  // [m/s]

/// 145 mm of spheres of 14 mm in a tube of 56 mm, whose gradient is taken where neither floor nor surface shows.
const tube_bed& bed() {
    static const tube_bed b(tube_to_particle, 0.12);
    return b;
}

blown_gas air(double speed) {
    blown_gas gas;
    gas.speed = speed;
    return gas;
}

std::string one_word(std::string text) {
    std::replace(text.begin(), text.end(), ' ', '_');
    return text;
}

void cubic(std::ostream& out) {
    out << "pitch cells drag zick_homsy\n";
    struct array {
        double pitch, drag;
    };
    // Zick & Homsy (1982), doi:10.1017/S0022112082000627, table 2: solid fractions 0.125, 0.343 and, touching, 0.5236
    for (const array& a : {array{1.61199, 4.292}, array{1.15144, 15.4}, array{1, 42.1}})
        for (const int cells : {8, 12, 16, 20, 24})
            out << a.pitch << ' ' << cells << ' ' << simple_cubic_drag(a.pitch, cells) << ' ' << a.drag << std::endl;
}

/// A quarter of a sphere in a stream five diameters wide, four beyond it: drag coefficients of friction and of
/// pressure.
void sphere(std::ostream& out) {
    using namespace hearth::gas;
    constexpr double half_width = 2.5, before = 3, behind = 4, quarters = 4, disc = 3.14159265358979323846 / 4;
    out << "cells reynolds friction pressure schiller_naumann\n";
    for (const int cells : {8, 12, 16})
        for (const double reynolds : {20.0, 100.0, 200.0}) {
            solids one;
            one.spheres.positions.push_back({0, 0, before});
            one.spheres.radii.push_back(0.5);
            const int across = static_cast<int>(half_width * cells),
                      along = static_cast<int>((before + behind) * cells);
            resolved_flow flow(resolved_space(one, {0, 0, 0}, {across, across, along}, 1.0 / cells), 1, 1 / reynolds);
            flow.set_inflow(half_width * half_width);
            const mesh& m = flow.space.mesh;
            double friction = 0, pressure = 0;
            for (int rounds = 0; rounds < 30; ++rounds) {
                const double last = friction + pressure;
                for (int i = 0; i < 10; ++i) flow.solver->iterate();
                const flow_state& state = flow.solver->gas.flow;
                friction = pressure = 0;
                for (int c = 0; c < m.cells(); ++c)
                    friction += flow.solver->bed.exchange[c] * state.velocity[c].z * m.volume[c];
                const patch& side = m.find_patch("side");
                for (int f = side.first; f < side.first + side.count; ++f) {
                    const int c = m.owner[f];
                    const double at_face =
                        state.pressure[c] + dot(state.pressure_gradient[c], m.face_centre[f] - m.centre[c]);
                    pressure += at_face * m.area[f].z;
                }
                if (std::abs(friction + pressure - last) < 3e-4 * last) break;
            }
            const double scale = quarters / (0.5 * disc);
            out << cells << ' ' << reynolds << ' ' << scale * friction << ' ' << scale * pressure << ' '
                << 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687)) << std::endl;
        }
}

template <class Drag = hearth::closure::ergun>
double by_voids(const std::string& method, double d_dx, double speed, const Drag& drag = {}) {
    const hearth::gas::mesh mesh = bed().mesh(d_dx);
    return blow(mesh, bench::solid_fraction(method, mesh, bed().spheres), tube_bed::diameter, air(speed),
                hearth::gas::wall(), bed().from(), bed().to(), 150, hearth::gas::make_drag(drag))
        .gradient;
}

void speeds(std::ostream& out) {
    const double e = bed().void_fraction();
    const hearth::closure::eisfeld_schnitzlein walled(tube_to_particle);
    out << "# " << bed().spheres.radii.size() << " spheres, surface at " << bed().top << " m, void fraction " << e
        << '\n'
        << "speed ergun eisfeld filtered filtered_eisfeld vfs_1 vfs_2 divided\n";
    for (const double speed : speeds_of_figure) {
        const blown_gas gas = air(speed);
        const double eisfeld = hearth::closure::pressure_gradient(
            walled, hearth::closure::bed_flow<double>{e, speed / e, gas.density, gas.viscosity, tube_bed::diameter});
        out << speed << ' ' << gas.ergun(e, tube_bed::diameter) << ' ' << eisfeld << ' '
            << by_voids("filtered", 2, speed) << ' ' << by_voids("filtered", 2, speed, walled) << ' '
            << by_voids("VFS of the paper", 1, speed) << ' ' << by_voids("VFS of the paper", 2, speed) << ' '
            << by_voids("divided, clamped", 1, speed) << std::endl;
    }
}

/// The methods and cells per diameter of a comparison; beyond 4 the others leave cells at the threshold beside free
/// ones, and the flow does not come to rest.
template <class Visit>
void each_method(double least, const Visit& visit) {
    for (const char* method : {"filtered", "VFS of the paper", "VFS completed", "divided, clamped", "centre, clamped"})
        for (const double d_dx : {0.5, 1.0, 2.0, 4.0, 8.0})
            if (d_dx >= least && (d_dx <= 4 || std::string(method) == "filtered")) visit(std::string(method), d_dx);
}

void work(std::ostream& out) {
    out << "method d_dx gradient seconds\n";
    each_method(1, [&](const std::string& method, double d_dx) {
        const double begin = cpu_seconds(), gradient = by_voids(method, d_dx, 1);
        out << one_word(method) << ' ' << d_dx << ' ' << gradient << ' ' << cpu_seconds() - begin << std::endl;
    });
}

void wide(std::ostream& out) {
    const wide_bed packed(0.56, 101);
    void_profile profile = packed.profile();
    profile.filter(0.5 * wide_bed::diameter);
    const double expected = profile.pressure_drop(air(1), wide_bed::diameter);
    out << "method d_dx over_ergun seconds\n";
    each_method(0.5, [&](const std::string& method, double d_dx) {
        const double begin = cpu_seconds();
        const auto fraction = bench::solid_fraction(method, packed.repeated(d_dx), packed.spheres);
        const blown result =
            blow(packed.mesh(d_dx), fraction, wide_bed::diameter, air(1), hearth::gas::slip(), 0, 0, 150);
        out << one_word(method) << ' ' << d_dx << ' ' << result.pressure_drop / expected << ' ' << cpu_seconds() - begin
            << std::endl;
    });
}

void resolved(std::ostream& out) {
    out << "cells_per_diameter speed gradient change iterations cells seconds\n";
    for (const int cells : {8, 12, 16}) {
        resolved_tube tube(bed(), cells);
        for (const double speed : speeds_of_figure) {
            const double begin = cpu_seconds();
            const resolved_tube::answer a = tube.blow(speed);
            out << cells << ' ' << speed << ' ' << a.gradient << ' ' << a.change << ' ' << a.iterations << ' '
                << tube.cells() << ' ' << cpu_seconds() - begin << std::endl;
        }
    }
}

}  // namespace

int main(int count, char** words) {
    return bench::write_tables(count, words,
                               {{"cubic", cubic},
                                {"sphere", sphere},
                                {"speeds", speeds},
                                {"work", work},
                                {"wide", wide},
                                {"resolved", resolved}});
}
