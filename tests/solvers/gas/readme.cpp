// SPDX-License-Identifier: MIT
// The program that the README of the gas solver shows: a shaft full of hot particles, air from below.
#include <memory>
#include <stdexcept>

#include <doctest/doctest.h>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

TEST_CASE("gas: the README's shaft heats its air to what particles and wall hold it at") {
    hearth::gas::shaft shaft;
    shaft.profile = {{0, 0.2}, {1, 0.2}};
    shaft.axial_size = {{0, 0.05}, {1, 0.05}};

    // [use]
    using namespace hearth::gas;
    mesh grid(make(shaft));  // or box(...), or read_poly_mesh("constant/polyMesh")
    solver gas(grid, std::make_shared<simple_gas>());
    gas.set("bottom", normal_volume_inlet(200.0 / 3600, 0.029, {300}));  // [m^3/s] [kg/mol] [K]
    gas.set("wall", wall(wall_heat{3, 320}));                            // U [W/(m^2 K)] to an ambient [K]
    gas.set("top", pressure_outlet(1e5));                                // [Pa]
    for (int cell = 0; cell < grid.cells(); ++cell) {
        gas.bed.void_fraction[cell] = 0.4;
        gas.bed.diameter[cell] = 0.018;
        gas.bed.heat_conductance[cell] = 2e4 * grid.volume[cell];       // sum of W K over the particles [W/K]
        gas.bed.heat_source[cell] = 2e4 * grid.volume[cell] * 800;      // sum of W K T_particle [W]
    }
    gas.initialise(300);
    const report r = gas.steady();  // or gas.step(dt, 1 / Gamma)
    if (!r.converged) throw std::runtime_error(r.reason);
    // [use]

    // 35 transfer units: the gas ends where particles of 2e4 * 0.126 W/(K m) and a wall of 3 * 1.257 W/(K m) hold it.
    const double particles = 2e4 * 3.14159265 * 0.2 * 0.2, sides = 3 * 3.14159265 * 0.4;
    const double expected = (particles * 800 + sides * 320) / (particles + sides);
    // The wall takes its share from the outermost cells alone.
    CHECK(gas.mean_temperature("top") == doctest::Approx(expected).epsilon(1e-3));
    CHECK(r.enthalpy.error < 1e-10);
}
