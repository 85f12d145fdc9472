// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <cmath>
#include <numeric>
#include <cstdio>
#include <cstdlib>

#include "coarse_column.hpp"

using namespace hearth::furnace;

namespace {

settings short_shaft(bed_motion motion) {
    settings scene;
    scene.shaft.height = 2;
    scene.shaft.hopper_height = 0.5;
    scene.burners.height = 1.3;
    scene.bed.motion = motion;
    scene.bed.coarse_graining = 8;
    scene.bed.softened_modulus = 3.77e7;
    scene.physics.combustion = burning::mixed_is_burnt;
    scene.mesh.across = 4;
    scene.mesh.axial_size = 0.25;
    scene.mesh.axial_size_bottom = scene.mesh.axial_size_burners = 0.125;
    scene.time.acceleration_factor = 200;
    scene.time.couplings = 20;
    scene.time.residence_times = 1;
    scene.time.balance_tolerance = 1;
    return scene;
}

}  // namespace

TEST_CASE("driven: probe") {
    for (const bed_motion m : {bed_motion::dem, bed_motion::recorded}) {
        settings scene = short_shaft(m);
        if (const char* g = std::getenv("GAMMA")) scene.time.acceleration_factor = std::atof(g);
        if (const char* g = std::getenv("RES")) scene.time.residence_times = std::atof(g);
        if (const char* g = std::getenv("COUP")) scene.time.couplings = std::atoi(g);
        if (const char* g = std::getenv("SOFT")) scene.bed.softened_modulus = std::atof(g);
        furnace shaft(scene);
        run_couplings(shaft, 0);
        std::printf("motion %d, %zu parcels, plan %g\n", static_cast<int>(m), shaft.look().particle_radius.size(), foresee(scene).motion_steps);
        double left = 0;
        while (!shaft.done() && shaft.steps_done() < scene.time.couplings) {
            shaft.step();
            const auto s = shaft.save();
            left += s.at("past/product").back();
            const auto b = shaft.summarise();
            double top = 0;
            for (const auto& x : shaft.look().particle_position) top = std::max(top, x[2]);
            std::printf("%2d t %6.0f mass %7.1f out-due %6.1f missing %8.1e audit %8.1e W of %g  peak %6.0f at %.2f out %6.0f offgas %6.0f top %.2f n %zu\n", shaft.steps_done(), shaft.now().process_time, *b.bed_mass,
                left - scene.particles.mass_flow * shaft.now().process_time, s.at("past/solid_missing").back(), *b.enthalpy_audit, *b.fuel_power, s.at("past/peak").back(), s.at("past/peak_height").back(), shaft.now().solids_outlet_temperature, shaft.now().offgas_temperature, top, s.at("bed/state").size());
        }
        const auto b = shaft.summarise();
        for (const auto& w : b.warnings) std::printf("W %s\n", w.c_str());
        for (const auto& x : b.modules) std::printf("%s %.2f ", x.name.c_str(), x.seconds);
        std::printf("\npeak %g out %g\n", *b.peak_particle_temperature, *b.solids_outlet_temperature);
    }
}
