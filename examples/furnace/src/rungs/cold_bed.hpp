// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/rung.hpp>

#include "../describe.hpp"

namespace hearth::furnace::rungs {

/// S2: cold air blows through a bed that DEM packed, under free space (Fig. 5): pressure drop by each way to make a solid
/// fraction, beside Ergun's equation and that of Eisfeld and Schnitzlein at the void fraction that the bed has.
struct cold_bed {
    static constexpr const char* kind = "cold_bed";

    std::string title = "cold bed under flow";
    double diameter = 0.014, density = 2500, level = 0.145, free = 0.155, tube_to_particle = 7;
    double gas_density = 1.2, viscosity = 1.81e-5, pressure = 1e5;
    std::vector<double> velocities{0.2, 0.5, 1, 2};
    double cells_per_diameter = 2;
    std::vector<double> compared_meshes{1, 1.5, 2};
    bool compare_methods = true;
    int iterations = 100;
    std::uint64_t seed = 1;

    template <class Self, class Key>
    static void describe(Self& s, Key&& key) {
        key("", "title", s.title, range{}, "What the scene is called in tables and pictures");
        key("bed", "height_m", s.level, range{0.01, 10}, "Height of the bed");
        key("bed", "free_height_m", s.free, range{0, 10}, "Free space above it");
        key("bed", "tube_to_particle", s.tube_to_particle, range{4, 100}, "Diameter of the tube over that of the particles (assumed: not in the paper)");
        key("particles", "diameter_mm", s.diameter, range{0.1, 500, 1e-3}, "Diameter");
        key("particles", "density_kg_per_m3", s.density, range{100, 3e4}, "Density (assumed: glass)");
        key("gas", "velocities_m_per_s", s.velocities, range{1e-3, 20}, "Superficial velocities");
        key("gas", "density_kg_per_m3", s.gas_density, range{0.01, 100}, "Density of the gas (assumed: air at 293 K)");
        key("gas", "viscosity_Pa_s", s.viscosity, range{1e-7, 1e-2}, "Viscosity of the gas (assumed: air at 293 K)");
        key("gas", "outlet_pressure_Pa", s.pressure, range{1e3, 1e7}, "Absolute pressure at the outlet (assumed)");
        key("mesh", "cells_per_diameter", s.cells_per_diameter, range{1, 8}, "Cells over a particle's diameter");
        key("mesh", "compared_cells_per_diameter", s.compared_meshes, range{1, 8}, "The same for error against run time, at the middle velocity");
        key("mesh", "iterations", s.iterations, range{1, 1e5}, "Most iterations of the flow");
        key("voidage", "compare", s.compare_methods, range{}, "Beside the filtered fraction also the paper's smoother, the completed one, and cutting off at 0.9");
        key("output", "seed", s.seed, range{0, 1e18}, "Seed of the packing");
    }
};

void check(const cold_bed& scene);
rung_plan foresee(const cold_bed& scene);
rung_result run(const cold_bed& scene, const watcher& watch);

}  // namespace hearth::furnace::rungs
