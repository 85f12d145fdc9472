// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/rung.hpp>

#include "../describe.hpp"

namespace hearth::furnace::rungs {

/// S5: a silo that is filled, fed and emptied by DEM: Janssen's stress on the floor, plug flow, exact mass flow.
struct silo {
    static constexpr const char* kind = "silo";

    std::string title = "silo";
    double diameter = 0.16, height = 0.72;
    int fillings = 4;
    double smallest = 0.016, largest = 0.0195, density = 3580;
    double modulus = 3.77e7, poisson_ratio = 0.26, friction = 0.5, restitution = 0.5;
    double mass_flow = 2, duration = 4;
    std::uint64_t seed = 1;

    template <class Self, class Key>
    static void describe(Self& s, Key&& key) {
        key("", "title", s.title, range{}, "What the scene is called in tables and pictures");
        key("silo", "diameter_m", s.diameter, range{0.01, 20}, "Inner diameter (assumed: a slim furnace)");
        key("silo", "height_m", s.height, range{0.05, 50}, "Level of the filling");
        key("silo", "fillings", s.fillings, range{2, 100}, "Levels at which the floor is weighed on the way there");
        key("particles", "smallest_mm", s.smallest, range{0.1, 500, 1e-3}, "Smallest diameter");
        key("particles", "largest_mm", s.largest, range{0.1, 500, 1e-3}, "Largest diameter; the mass is spread evenly between");
        key("particles", "density_kg_per_m3", s.density, range{100, 3e4}, "Density (assumed: spinel)");
        key("particles", "softened_modulus_Pa", s.modulus, range{1e6, 1e13}, "Young's modulus of the motion");
        key("particles", "poisson_ratio", s.poisson_ratio, range{0, 0.49}, "Poisson ratio (assumed: spinel)");
        key("particles", "friction", s.friction, range{0, 2}, "Friction between particles and with the wall (assumed)");
        key("particles", "restitution", s.restitution, range{0.01, 1}, "Coefficient of restitution (assumed)");
        key("flow", "mass_flow_kg_per_s", s.mass_flow, range{1e-3, 1e4}, "Fed at the top and taken out below, by the clock of the motion");
        key("flow", "duration_s", s.duration, range{0.1, 1e4}, "Time of the motion");
        key("output", "seed", s.seed, range{0, 1e18}, "Seed of the feed");
    }
};

void check(const silo& scene);
rung_plan foresee(const silo& scene);
rung_result run(const silo& scene, const watcher& watch);

}  // namespace hearth::furnace::rungs
