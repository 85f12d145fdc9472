// SPDX-License-Identifier: MIT
// Ways to get a shaft furnace wrong, each as a small case; those of closures, motion and integrators are tested with them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "coarse_column.hpp"

using namespace hearth::furnace;

TEST_CASE("trap: axial cells of half the height do not move the peak as first-order upwind would") {
    settings scene = coarse_column();
    const auto peak = [&] {
        furnace shaft(scene);
        run_couplings(shaft, 8);
        return shaft.now().peak_particle_temperature;
    };
    const double coarse = peak();
    for (double* size : {&scene.mesh.axial_size, &scene.mesh.axial_size_bottom, &scene.mesh.axial_size_burners}) *size *= 0.5;
    // Upwind would lose 57 K at the 50 mm of the burners and 28 K at half of it: 29 K apart.
    CHECK(std::abs(peak() - coarse) < 10);
}

TEST_CASE("trap: cells are flat where cold air meets hot stones") {
    settings scene = coarse_column();
    scene.mesh.axial_size_bottom = 0.025;
    const furnace shaft(scene);
    const cell_shapes cells = shaft.cells();
    REQUIRE(!cells.cells.empty());
    for (const auto& cell : cells.cells) {
        const double low = cells.points[static_cast<std::size_t>(cell[0])][2], high = cells.points[static_cast<std::size_t>(cell[4])][2];
        CHECK(high > low);
        // The lowest 0.8 m have the size asked for, but for the rounding to whole cells.
        if (high < 0.8) CHECK(high - low < 0.025 * 1.1);
    }
}

TEST_CASE("trap: as much solid leaves as the scene says, to the last parcel; the shaft holds its true volume") {
    const settings scene = coarse_column();
    furnace shaft(scene);
    const double before = [&] {
        run_couplings(shaft, 0);
        return *shaft.summarise().bed_mass;
    }();
    run_couplings(shaft, 12);
    const status now = shaft.now();
    const summary books = shaft.summarise();
    CHECK(*books.bed_mass == doctest::Approx(before).epsilon(1e-12));
    const double shaft_volume = 3.14159265358979 / 4 * 0.17 * 0.17 * 10;
    CHECK(now.mean_void_fraction == doctest::Approx(1 - before / scene.particles.density / shaft_volume).epsilon(1e-12));
    const saved_state state = shaft.save();
    double left = 0;
    for (const double mass : state.at("past/product")) left += mass;
    const double parcel = state.at("bed/masses").front(), asked = scene.particles.mass_flow * now.process_time;
    CAPTURE(asked);
    // Parcels leave where their centres pass the bottom: those of one turn of the lattice, some thirty, in no even order.
    CHECK(std::abs(left - asked) < 30 * parcel);
}

TEST_CASE("trap: a peak that stands still is no steady furnace") {
    settings scene = coarse_column();
    scene.time.balance_tolerance = 1e-3;
    furnace shaft(scene);
    run_couplings(shaft, 6);
    const double early = shaft.now().peak_particle_temperature;
    shaft.step();
    CHECK(std::abs(shaft.now().peak_particle_temperature - early) < 5);
    CHECK_FALSE(shaft.summarise().converged);
}

TEST_CASE("trap: steps far beyond the explicit limits of radiation, 6 s, and of gas and stones, 95 s, stay bounded") {
    settings scene = coarse_column();
    scene.time.couplings = 4;
    scene.time.residence_times = 0.6;  // 2000 s a coupling
    furnace shaft(scene);
    run_couplings(shaft, 4);
    for (const double t : shaft.look().particle_temperature) {
        CHECK(t >= 300 - 1e-6);
        CHECK(t < 2700);
    }
    CHECK(std::abs(*shaft.summarise().enthalpy_audit) < 0.01 * shaft.now().fuel_power);
}

TEST_CASE("trap: hotter than the flame of cold gas is told, with the cell") {
    settings scene = coarse_column();
    scene.burners.temperature = 1000;
    furnace shaft(scene);
    run_couplings(shaft, 3);
    const summary end = shaft.summarise();
    REQUIRE(*end.maximum_temperature > 2327);
    REQUIRE(!end.warnings.empty());
    CHECK(end.warnings.front().find(" in cell ") != std::string::npos);
}

namespace {

/// Three metres of the paper's shaft in parcels of ten stones' width, packed and moved by DEM.
settings coarse_moving_shaft() {
    settings scene = short_shaft(4, 0.3);
    scene.bed.motion = bed_motion::recorded;
    scene.bed.coarse_graining = 10;
    scene.time.couplings = 30;
    scene.time.residence_times = 1.5;
    scene.time.balance_tolerance = 1;
    return scene;
}

}  // namespace

TEST_CASE("trap: a bed that moves by a recording keeps its level, its flow and its void fraction") {
    const settings scene = coarse_moving_shaft();
    const double parcel = scene.bed.coarse_graining * 19.5e-3;
    furnace shaft(scene);
    run_couplings(shaft, 1);
    const double mass = *shaft.summarise().bed_mass;
    double least = mass, most = mass;
    for (int k = 1; k < 30; ++k) {
        shaft.step();
        const double now = *shaft.summarise().bed_mass;
        least = std::min(least, now);
        most = std::max(most, now);
        int above = 0, near_top = 0;
        for (const auto& x : shaft.look().particle_position) {
            above += x[2] > scene.shaft.height + 1.5 * parcel;
            near_top += x[2] > scene.shaft.height - 1.5 * parcel;
        }
        CHECK(above == 0);
        CHECK(near_top > 0);
    }
    // A recording's number of parcels changes by 5 % at most, its last frame being chosen near the first.
    CHECK(most - least < 0.05 * mass);
    CHECK(shaft.now().mean_void_fraction == doctest::Approx(1 - mass / 3580 / (3.14159265358979 / 4 * 0.85 * 0.85 * 3)).epsilon(0.05));
    const saved_state state = shaft.save();
    double left = 0;
    for (const double product : state.at("past/product")) left += product;
    // A frame leaves when it is due as a whole; frames are a fifth of a parcel apart, or a little more.
    const double frame = 0.5 * parcel / scene.shaft.height * mass, asked = scene.particles.mass_flow * shaft.now().process_time;
    CHECK(left <= asked * (1 + 1e-12));
    CHECK(left > asked - frame);
    CHECK(std::abs(*shaft.summarise().solid_mass_imbalance) < 1e-12);
    CHECK(std::abs(*shaft.summarise().enthalpy_audit) < 1e-3 * shaft.now().fuel_power);
}

TEST_CASE("trap: Gamma changes nothing in a bed that moves by a recording") {
    const auto run = [](double acceleration_factor) {
        settings scene = coarse_moving_shaft();
        scene.time.acceleration_factor = acceleration_factor;
        furnace shaft(scene);
        run_couplings(shaft, 5);
        return shaft.look().particle_temperature;
    };
    const auto reference = run(200);
    for (const double acceleration_factor : {50.0, 678.0}) {
        const auto other = run(acceleration_factor);
        REQUIRE(other.size() == reference.size());
        double apart = 0;
        for (std::size_t i = 0; i < other.size(); ++i) apart = std::max(apart, std::abs(other[i] - reference[i]));
        CHECK(apart < 1e-3);  // of rounding, through iterations that end at 0.2 K of change
    }
}

TEST_CASE("trap: after enough time the furnace has forgotten where it started") {
    const auto run = [](start_from start) {
        settings scene = coarse_column();
        scene.shaft.height = 3;
        scene.burners.height = 2;
        scene.bed.coarse_graining = 3;
        scene.time.start = start;
        scene.time.couplings = 240;
        scene.time.residence_times = 12;
        scene.time.balance_tolerance = 1e-3;
        furnace shaft(scene);
        run_couplings(shaft, 240);
        return shaft.summarise();
    };
    const summary cold = run(start_from::cold), near = run(start_from::one_dimensional);
    CHECK(std::abs(*cold.peak_particle_temperature - *near.peak_particle_temperature) < 5);
    CHECK(std::abs(*cold.offgas_temperature - *near.offgas_temperature) < 5);
    CHECK(std::abs(*cold.solids_outlet_temperature - *near.solids_outlet_temperature) < 5);
}
