// SPDX-License-Identifier: MIT
// The column furnace (scene S4): everything thermal, mixed-is-burnt, a plug-flow bed; coarse, so that it runs in seconds.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <hearth/furnace/furnace.hpp>

using namespace hearth::furnace;

namespace {

settings coarse_column() {
    settings scene;
    scene.bed.motion = bed_motion::plug;
    scene.physics.combustion = burning::mixed_is_burnt;
    scene.bed.coarse_graining = 6;
    scene.mesh.across = 6;
    scene.mesh.axial_size = 0.12;
    scene.mesh.axial_size_bottom = 0.04;
    scene.mesh.axial_size_burners = 0.05;
    scene.time.couplings = 24;
    scene.time.residence_times = 0.3;
    return scene;
}

}  // namespace

TEST_CASE("column: heat is kept between gas, stones and wall, and nothing leaves the range of what enters and burns") {
    const settings scene = coarse_column();
    furnace shaft(scene);
    while (!shaft.done()) shaft.step();
    const status end = shaft.now();
    // The bed holds the scene's solid, to the last parcel.
    CHECK(end.mean_void_fraction == doctest::Approx(scene.bed.void_fraction).epsilon(1e-3));
    // What fuel brings leaves with gas and stones, through the wall, or is stored.  The gas is iterated to 1e-3 of that.
    CHECK(std::abs(end.enthalpy_imbalance) < 5e-3 * end.fuel_power);
    CHECK(end.fuel_power == doctest::Approx(571e3).epsilon(0.01));  // 0.207 kg/s of stoichiometric CH4 and air, 50 MJ/kg of CH4
    const snapshot seen = shaft.look();
    for (const double t : seen.particle_temperature) {
        CHECK(t >= 300 - 1e-6);
        CHECK(t <= 2700);  // CH4 in air preheated to 1000 K burns at 2670 K
    }
    for (const double t : seen.gas_temperature) CHECK(t >= 300 - 1e-6);
    // 67 kPa in the paper; the column starts from the one-dimensional solution, 66 kPa, and stays near it.
    CHECK(end.pressure_drop == doctest::Approx(shaft.profile().pressure_drop).epsilon(0.15));
    // The hottest stones were at the burners, 8 m, within the 3 m that the bed has sunk.
    CHECK(end.peak_height < 8.2);
    CHECK(end.peak_height > 5);
}

TEST_CASE("column: the same bits from the same scene, and Gamma changes nothing in a bed that moves as a plug") {
    settings scene = coarse_column();
    scene.time.couplings = 4;
    scene.time.residence_times = 0.05;
    const auto run = [&](double acceleration_factor) {
        scene.time.acceleration_factor = acceleration_factor;
        furnace shaft(scene);
        while (!shaft.done()) shaft.step();
        return shaft.look().particle_temperature;
    };
    const auto first = run(512), again = run(512), slow = run(64);  // powers of two, so that Gamma cancels without rounding
    CHECK(first == again);
    CHECK(first == slow);
}

TEST_CASE("column: without fuel it cools towards what enters; a scene that it cannot run is refused") {
    settings scene = coarse_column();
    scene.time.couplings = 6;
    furnace shaft(scene);
    const double before = shaft.now().peak_particle_temperature;
    shaft.set_burner_flow(0);
    while (!shaft.done()) shaft.step();
    CHECK(shaft.now().peak_particle_temperature < before);
    CHECK(shaft.now().maximum_gas_temperature < before);
    scene.bed.motion = bed_motion::dem;
    CHECK_THROWS_AS(furnace{scene}, bad_scene);
}

TEST_CASE("column: a furnace that restores a state goes on as the one that saved it, bit for bit") {
    settings scene = coarse_column();
    scene.time.couplings = 6;
    scene.time.residence_times = 0.05;
    furnace first(scene);
    for (int k = 0; k < 2; ++k) first.step();
    first.set_burner_flow(0.15);
    first.step();
    const saved_state saved = first.save();
    furnace second(scene);
    second.restore(saved);
    CHECK(second.steps_done() == 3);
    CHECK(second.save() == saved);
    while (!first.done()) first.step();
    while (!second.done()) second.step();
    saved_state one = first.save(), other = second.save();
    for (const char* clock : {"seconds", "coupling_seconds"}) {
        one.erase(clock);
        other.erase(clock);
    }
    CHECK(one == other);
    CHECK(first.now().enthalpy_imbalance == second.now().enthalpy_imbalance);
    CHECK(first.now().fuel_power == second.now().fuel_power);

    SUBCASE("what does not fit is refused, and changes nothing") {
        saved_state lacking = saved, shorter = saved;
        lacking.erase("gas/enthalpy");
        shorter["bed/temperature"].pop_back();
        CHECK_THROWS_WITH_AS(second.restore(lacking), "the state lacks gas/enthalpy", bad_scene);
        CHECK_THROWS_AS(second.restore(shorter), bad_scene);
        saved_state after = second.save();
        for (const char* clock : {"seconds", "coupling_seconds"}) after.erase(clock);
        CHECK(after == other);
    }
}
