// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/rung.hpp>

#include "../describe.hpp"

namespace hearth::furnace::rungs {

/// S3: hot air heats a fixed bed (Fig. 6 of the paper), exchange by Gunn and nothing else, beside Schumann's exact solution.
struct heated_bed {
    static constexpr const char* kind = "heated_bed";

    std::string title = "heated fixed bed";
    double height = 0.15, diameter = 0.01, void_fraction = 0.4;
    double density = 2500, specific_heat = 840, temperature = 300;
    std::vector<double> heights{0.02, 0.05, 0.1};
    double velocity = 0.5, gas_temperature = 400, property_temperature = 350, pressure = 101325;
    std::vector<double> factors{10, 50, 200, 678, 2000};
    double compared = 200;
    double duration = 800, step = 1e-3;
    int cells = 150, samples = 200;

    template <class Self, class Key>
    static void describe(Self& s, Key&& key) {
        key("", "title", s.title, range{}, "What the scene is called in tables and pictures");
        key("bed", "height_m", s.height, range{0.01, 100}, "Height of the bed");
        key("bed", "heights_mm", s.heights, range{1, 1e5, 1e-3}, "Where temperatures are compared");
        key("bed", "void_fraction", s.void_fraction, range{0.2, 0.9}, "Void fraction (assumed: not in the paper)");
        key("particles", "diameter_mm", s.diameter, range{0.1, 500, 1e-3}, "Diameter of the particles");
        key("particles", "density_kg_per_m3", s.density, range{100, 2e4}, "Density (assumed: glass)");
        key("particles", "specific_heat_J_per_kgK", s.specific_heat, range{10, 1e4}, "Specific heat (assumed: glass)");
        key("particles", "temperature_K", s.temperature, range{200, 2000}, "Temperature at the start");
        key("gas", "velocity_m_per_s", s.velocity, range{1e-3, 100}, "Superficial velocity of the air as it enters");
        key("gas", "temperature_K", s.gas_temperature, range{200, 2000}, "Temperature of the air as it enters");
        key("gas", "property_temperature_K", s.property_temperature, range{200, 2000}, "Temperature at which viscosity, conductivity and specific heat are taken (assumed: of the film)");
        key("gas", "pressure_Pa", s.pressure, range{1e3, 1e7}, "Absolute pressure (assumed)");
        key("mesh", "cells", s.cells, range{2, 1e5}, "Cells over the height");
        key("time", "duration_s", s.duration, range{1, 1e6}, "Process time");
        key("time", "step_s", s.step, range{1e-6, 100}, "Step by the clock of the gas");
        key("time", "samples", s.samples, range{2, 1e4}, "Times at which temperatures are compared");
        key("time", "acceleration_factors", s.factors, range{1, 1e5}, "Values of Gamma beside 1");
        key("time", "compared_acceleration_factor", s.compared, range{1, 1e5}, "The Gamma of the paper's figure");
    }
};

void check(const heated_bed& scene);
rung_plan foresee(const heated_bed& scene);
rung_result run(const heated_bed& scene, const watcher& watch);

}  // namespace hearth::furnace::rungs
