// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/rung.hpp>

#include "../describe.hpp"

namespace hearth::furnace::rungs {

/// S1: a bed between a hot and a cold plate (Figs. 2 and 3): its effective conductivity beside Yagi and Kunii's Eq. 15
/// (AIChE J. 3 (1957) 373, doi:10.1002/aic.690030317) for the iron spheres of their Table 4.
struct plates {
    static constexpr const char* kind = "plates";

    std::string title = "bed between two plates";
    double diameter = 0.011, density = 7870, conductivity = 52.3, emissivity = 0.95;
    double modulus = 2e11, softened_modulus = 1e8, poisson_ratio = 0.29, friction = 0.3;
    double radius_in_diameters = 7, height_in_diameters = 34, load = 1000;
    std::vector<double> temperatures{400, 500, 600, 700, 800, 900, 1000, 1100};
    double temperature_difference = 20, cutoff = 2.5;
    std::vector<double> cutoffs{1.001, 1.25, 1.5, 2, 2.5, 3, 4};
    std::uint64_t seed = 1;

    template <class Self, class Key>
    static void describe(Self& s, Key&& key) {
        key("", "title", s.title, range{}, "What the scene is called in tables and pictures");
        key("particles", "diameter_mm", s.diameter, range{0.1, 500, 1e-3}, "Diameter");
        key("particles", "density_kg_per_m3", s.density, range{100, 3e4}, "Density (assumed: iron)");
        key("particles", "conductivity_W_per_mK", s.conductivity, range{0.01, 1000}, "Thermal conductivity");
        key("particles", "emissivity", s.emissivity, range{0.2, 1}, "Emissivity (assumed: oxidised iron)");
        key("particles", "modulus_Pa", s.modulus, range{1e6, 1e13}, "True Young's modulus, for the contact areas (assumed: iron)");
        key("particles", "softened_modulus_Pa", s.softened_modulus, range{1e6, 1e13}, "Young's modulus of the motion");
        key("particles", "poisson_ratio", s.poisson_ratio, range{0, 0.49}, "Poisson ratio (assumed: iron)");
        key("particles", "friction", s.friction, range{0, 2}, "Friction between particles (assumed: gives a void fraction of 0.40); plates and tube are smooth");
        key("vessel", "radius_in_diameters", s.radius_in_diameters, range{4, 50}, "Radius of the insulated tube (assumed)");
        key("vessel", "fill_height_in_diameters", s.height_in_diameters, range{12, 200}, "Height of the loose column that falls onto the lower plate (assumed)");
        key("vessel", "load_Pa", s.load, range{1, 1e6}, "Pressure of the upper plate on the bed (assumed)");
        key("heat", "temperatures_K", s.temperatures, range{273.15, 1473.15}, "Mean temperatures");
        key("heat", "temperature_difference_K", s.temperature_difference, range{0.1, 200}, "Between the plates");
        key("heat", "cutoff_in_diameters", s.cutoff, range{1, 6}, "How far radiation looks");
        key("heat", "compared_cutoffs", s.cutoffs, range{1, 6}, "Cutoffs for error against run time, beside the largest of them");
        key("output", "seed", s.seed, range{0, 1e18}, "Seed of the packing");
    }
};

void check(const plates& scene);
rung_plan foresee(const plates& scene);
rung_result run(const plates& scene, const watcher& watch);

}  // namespace hearth::furnace::rungs
