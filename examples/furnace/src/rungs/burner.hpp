// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/rung.hpp>

#include "../describe.hpp"

namespace hearth::furnace::rungs {

/// S6: one burner of the furnace fires into a slab of the bed, as deep as the radius allows and as wide as its share of the
/// wall.  Spheres packed by DEM stand still at one temperature after the other; the gas burns at finite rates.
struct burner {
    static constexpr const char* kind = "burner";

    std::string title = "one burner in a slab";
    double depth = 0.3, width = 0.16, height = 0.5, burner_height = 0.14;
    double diameter = 17.75e-3, density = 3580;
    std::vector<double> temperatures{800, 900, 1000, 1200, 1400, 1600, 1800, 2000};
    double burner_flow = 0.207 / 12, burner_diameter = 15e-3, equivalence_ratio = 1, burner_temperature = 300;
    double air_flux = 1.266, pressure = 1.16e5;
    double cell = 0.02;
    int iterations = 120;

    template <class Self, class Key>
    static void describe(Self& s, Key&& key) {
        key("", "title", s.title, range{}, "What the scene is called in tables and pictures");
        key("slab", "depth_m", s.depth, range{0.1, 5}, "From the wall with the burner inwards (assumed)");
        key("slab", "width_m", s.width, range{0.05, 5}, "Along that wall (assumed: with the depth a twelfth of the furnace's section)");
        key("slab", "height_m", s.height, range{0.1, 5}, "Of the bed (assumed)");
        key("particles", "diameter_mm", s.diameter, range{1, 100, 1e-3}, "Diameter");
        key("particles", "density_kg_per_m3", s.density, range{100, 3e4}, "Density (assumed: spinel)");
        key("particles", "temperatures_K", s.temperatures, range{300, 2400}, "Temperatures of the bed; air comes as hot as it");
        key("burner", "height_m", s.burner_height, range{0.01, 5}, "Above the bottom");
        key("burner", "mass_flow_kg_per_s", s.burner_flow, range{1e-5, 10}, "Premixed gas and air (assumed: not in the paper)");
        key("burner", "diameter_mm", s.burner_diameter, range{1, 500, 1e-3}, "Diameter of the mouth");
        key("burner", "equivalence_ratio", s.equivalence_ratio, range{0.05, 5}, "Fuel over stoichiometric fuel (assumed)");
        key("burner", "temperature_K", s.burner_temperature, range{200, 1000}, "Temperature of the premixed gas (assumed)");
        key("air", "mass_flux_kg_per_m2s", s.air_flux, range{0.01, 100}, "Air from below (as in the furnace)");
        key("gas", "pressure_Pa", s.pressure, range{1e3, 1e7}, "Absolute pressure at the top (as at the furnace's burners)");
        key("mesh", "cell_m", s.cell, range{1e-3, 0.2}, "Size of the cells");
        key("mesh", "iterations", s.iterations, range{1, 1e5}, "Most iterations for each temperature");
    }
};

void check(const burner& scene);
rung_plan foresee(const burner& scene);
rung_result run(const burner& scene, const watcher& watch);

}  // namespace hearth::furnace::rungs
