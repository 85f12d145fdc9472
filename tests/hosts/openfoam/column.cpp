// SPDX-License-Identifier: MIT
// A packed column in rhoPimpleFoam against Ergun's pressure drop and Schumann's exact temperatures.
//     column PRESSURES PARTICLES...      numbers from column.sh: z p of each cell, and x y z T of each sphere
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <hearth/closure/drag.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/gunn.hpp>

#include "support/schumann.hpp"

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    constexpr double diameter = 0.01, superficial = 0.5, density = 1, viscosity = 1.8e-5, gas_heat = 1005,
                     solid_heat = 840;
    constexpr double solid_density = 2500, prandtl = 0.7, acceleration = 200, process_time = 400;
    const double solid = std::acos(-1.0) / 6, void_fraction = 1 - solid;  // of the cubic lattice
    int wrong = 0;

    // Between the ends, which see walls: the slope over the middle half.
    std::ifstream pressures(argv[1]);
    double low_z = 0, low_p = 0, high_z = 0, high_p = 0;
    for (double z, p; pressures >> z >> p;) {
        if (z < 0.08) low_z = z, low_p = p;
        if (z < 0.22) high_z = z, high_p = p;
    }
    const double gradient = (low_p - high_p) / (high_z - low_z);
    const double ergun = hearth::closure::pressure_gradient(
        hearth::closure::ergun{},
        hearth::closure::bed_flow<double>{void_fraction, superficial / void_fraction, density, viscosity, diameter});
    std::printf("pressure gradient %.6g Pa/m, Ergun %.6g Pa/m\n", gradient, ergun);
    // The kernel leaves 1e-5 of the lattice in the void fraction; the gradient goes with its third power.
    if (!(std::abs(gradient - ergun) < 1e-4 * ergun)) ++wrong, std::printf("FAILED\n");

    const double nusselt =
        hearth::closure::gunn::nusselt(void_fraction, density * superficial * diameter / viscosity, prandtl);
    const double per_volume =
        nusselt * (viscosity * gas_heat / prandtl) / diameter * 6 * solid / diameter;  // h a [W/(m^3 K)]
    double off = 0, mean = 0;
    int count = 0;
    for (int file = 2; file < argc; ++file) {
        std::ifstream particles(argv[file]);
        for (double x, y, z, t; particles >> x >> y >> z >> t; ++count) {
            const double xi = per_volume * z / (density * gas_heat * superficial);
            // The solver stores heat in all of its volume, by its own clock: the gas comes Gamma z / U later.
            const double tau = per_volume * std::max(0.0, process_time - acceleration * z / superficial) /
                               (solid * solid_density * solid_heat);
            const double exact = 300 + 100 * static_cast<double>(hearth_test::schumann::solid(xi, tau));
            off = std::max(off, std::abs(t - exact));
            mean += std::abs(t - exact);
        }
    }
    if (count == 0) return 2;
    mean /= count;
    std::printf(
        "%d spheres, transfer units %.1f: temperatures off Schumann's by %.2f K at most, %.2f K in the mean, of 100 "
        "K\n",
        count, per_volume * 0.3 / (density * gas_heat * superficial), off, mean);
    // W sees and gives with a standard deviation of 6 mm (kernel 5 mm, ramp 3 mm) what is local in Schumann's bed; over
    // a front of 49 mm to the transfer unit that is (6/49)^2 / 2 = 0.8 % of the step.
    if (!(off < 1)) ++wrong, std::printf("FAILED\n");
    return wrong;
}
