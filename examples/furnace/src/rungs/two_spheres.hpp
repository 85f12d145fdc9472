// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/rung.hpp>

#include "../describe.hpp"

namespace hearth::furnace::rungs {

/// S1: two spheres, and a sphere and a wall, pressed together by DEM with a softened modulus: heat over force (Fig. 1).
struct two_spheres {
    static constexpr const char* kind = "two_spheres";

    std::string title = "two spheres in contact";
    double diameter = 19.8e-3, density = 7850, conductivity = 45;
    double modulus = 2e11, softened_modulus = 3.77e8, poisson_ratio = 0.29;
    double temperature_difference = 10, gas_conductivity = 0.026;
    std::vector<double> forces{1, 2, 5, 10, 20, 50, 100};

    template <class Self, class Key>
    static void describe(Self& s, Key&& key) {
        key("", "title", s.title, range{}, "What the scene is called in tables and pictures");
        key("particles", "diameter_mm", s.diameter, range{0.1, 500, 1e-3}, "Diameter");
        key("particles", "density_kg_per_m3", s.density, range{100, 3e4}, "Density (assumed: steel)");
        key("particles", "conductivity_W_per_mK", s.conductivity, range{0.01, 1000}, "Thermal conductivity (assumed: steel)");
        key("particles", "modulus_Pa", s.modulus, range{1e6, 1e13}, "True Young's modulus, for the contact areas");
        key("particles", "softened_modulus_Pa", s.softened_modulus, range{1e6, 1e13}, "Young's modulus of the motion");
        key("particles", "poisson_ratio", s.poisson_ratio, range{0, 0.49}, "Poisson ratio (assumed: steel)");
        key("contact", "forces_N", s.forces, range{1e-3, 1e5}, "Forces that press them together");
        key("contact", "temperature_difference_K", s.temperature_difference, range{0.01, 1000}, "Between the two bodies (assumed)");
        key("gas", "conductivity_W_per_mK", s.gas_conductivity, range{0, 10}, "Of the gas in the gap around the contact; 0: vacuum (assumed: air)");
    }
};

void check(const two_spheres& scene);
rung_plan foresee(const two_spheres& scene);
rung_result run(const two_spheres& scene, const watcher& watch);

}  // namespace hearth::furnace::rungs
