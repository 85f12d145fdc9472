// SPDX-License-Identifier: MIT
// Spheres on a lattice in a closed box of liquid, 0.1 s after they were let go, against the exact hindered settling.
//     settling SPHERES...      a line a sphere: number, x y z, vertical velocity, temperature
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <hearth/closure/drag.hpp>
#include <hearth/closure/gidaspow.hpp>

int main(int argc, char** argv) {
    constexpr double diameter = 0.002, spacing = 0.004, density = 1100, solid_density = 2500, viscosity = 0.02;
    const double volume = std::acos(-1.0) / 6 * diameter * diameter * diameter;
    const double solid = volume / (spacing * spacing * spacing), void_fraction = 1 - solid;
    // Away from top and bottom everything is uniform.  Gas: e grad p = -n f, so of a sphere's force f - V grad p, f / e
    // is left of its weight in the liquid: f = e V (rho_s - rho) g.
    const double drag = void_fraction * volume * (solid_density - density) * 9.81;
    double low = 0, high = 1;  // slip speed [m/s], by bisection
    for (int k = 0; k < 100; ++k) {
        const double slip = 0.5 * (low + high);
        const hearth::closure::bed_flow<double> flow{void_fraction, slip, density, viscosity, diameter};
        (hearth::closure::particle_coefficient(hearth::closure::gidaspow{}, flow) * slip < drag ? low : high) = slip;
    }
    // No net flow through the box: e u + (1 - e) v = 0, so v = -e slip.
    const double expected = -void_fraction * low;

    double off = 0;
    int count = 0, all = 0;
    for (int file = 1; file < argc; ++file) {
        std::ifstream spheres(argv[file]);
        for (double id, x, y, z, v, t; spheres >> id >> x >> y >> z >> v >> t; ++all) {
            if (z < 0.02 || z > 0.04) continue;
            off = std::max(off, std::abs(v - expected));
            ++count;
        }
    }
    std::printf("%d spheres, settling at %.6f m/s: the middle is off by %.2g of it\n", all, expected, off / -expected);
    // Cells of one diameter and a kernel of half of one leave 1e-3 of the lattice in the void fraction, of which the
    // settling speed takes the fourth power.
    if (all == 325 && count >= 100 && off < 1e-2 * -expected) return 0;
    std::printf("FAILED\n");
    return 1;
}
