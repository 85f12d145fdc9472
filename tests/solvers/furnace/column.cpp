// SPDX-License-Identifier: MIT
// The column furnace (scene S4): everything thermal, mixed-is-burnt, a plug-flow bed; coarse, so that it runs in seconds.
#include <doctest/doctest.h>

#include <cmath>

#include "coarse_column.hpp"

using namespace hearth::furnace;

TEST_CASE("column: heat and mass are kept between gas, stones and wall, and nothing leaves the range of what enters and burns") {
    const settings scene = coarse_column();
    furnace shaft(scene);
    run_couplings(shaft, 12);
    const status end = shaft.now();
    const summary books = shaft.summarise();
    // The bed holds the scene's solid.
    CHECK(end.mean_void_fraction == doctest::Approx(scene.bed.void_fraction).epsilon(1e-3));
    // What fuel brings leaves with gas and stones, through the wall, or is stored.
    CHECK(std::abs(*books.enthalpy_audit) < 1e-3 * end.fuel_power);
    CHECK(std::abs(*books.gas_mass_imbalance) < 5e-3 * 0.04 * 0.925);
    CHECK(std::abs(*books.solid_mass_imbalance) < 1e-12);  // who leaves is fed anew at once
    CHECK(*books.element_imbalance < 1e-6);
    CHECK(end.fuel_power == doctest::Approx(0.04 * 571e3).epsilon(0.01));  // 0.207 kg/s of stoichiometric CH4 and air, 50 MJ/kg of CH4
    const snapshot seen = shaft.look();
    for (const double t : seen.particle_temperature) {
        CHECK(t >= 300 - 1e-6);
        CHECK(t <= 2700);  // CH4 in air preheated to 1000 K burns at 2670 K
    }
    for (const double t : seen.gas_temperature) CHECK(t >= 300 - 1e-6);
    // 67 kPa in the paper; the column starts from the one-dimensional solution and stays near it.
    CHECK(end.pressure_drop == doctest::Approx(shaft.profile().pressure_drop).epsilon(0.08));
    CHECK(end.peak_height == doctest::Approx(8).epsilon(0.03));
    CHECK(end.peak_particle_temperature == doctest::Approx(shaft.profile().peak_particle_temperature).epsilon(0.03));
    // The paper's range of heat transfer, 120 to 300, with a tenth on either side.
    CHECK(*books.heat_transfer_coefficient_p05 > 108);
    CHECK(*books.heat_transfer_coefficient_p95 < 330);
    // 24.9 mol/s of air bring 5.23 of oxygen, which burnt stoichiometric gas leaves alone; with its 0.71 of CO2 and 5.36 of
    // nitrogen that is 0.1689 of the dry gas.
    CHECK(std::abs(*books.oxygen_dry_outlet - 0.1689) < 5e-4);
    CHECK(*books.methane_outlet == 0);
    CHECK_FALSE(books.product_share_above_2130_K.has_value());  // nobody who was watched from the feed has left yet
}

TEST_CASE("column: the same bits from the same scene, and Gamma changes nothing in a bed that moves as a plug") {
    settings scene = coarse_column();
    const auto run = [&](double acceleration_factor) {
        scene.time.acceleration_factor = acceleration_factor;
        furnace shaft(scene);
        run_couplings(shaft, 3);
        return shaft.look().particle_temperature;
    };
    const auto first = run(512), again = run(512), slow = run(64);  // powers of two, so that Gamma cancels without rounding
    CHECK(first == again);
    CHECK(first == slow);
}

TEST_CASE("column: without fuel it cools towards what enters; a scene that it cannot run is refused") {
    settings scene = coarse_column();
    furnace shaft(scene);
    run_couplings(shaft, 0);
    const double before = shaft.now().peak_particle_temperature;
    shaft.set_burner_flow(0);
    run_couplings(shaft, 6);
    CHECK(shaft.now().peak_particle_temperature < before);
    CHECK(shaft.now().maximum_gas_temperature < before);
    CHECK_THROWS_AS(shaft.set_burner_flow(-1), bad_scene);
    scene.time.acceleration_factor = 0;
    CHECK_THROWS_AS(furnace{scene}, bad_scene);
}

TEST_CASE("column: a furnace that restores a state goes on as the one that saved it, bit for bit") {
    settings scene = coarse_column();
    scene.time.couplings = 60;
    scene.time.residence_times = 0.3;
    scene.time.steadying_interval = 2;  // it is saved within the watch of a bed that leaps after the next step
    furnace first(scene);
    run_couplings(first, 2);
    first.set_burner_flow(0.006);
    first.step();
    const saved_state saved = first.save();
    furnace second(scene);
    second.restore(saved);
    CHECK(second.steps_done() == 3);
    CHECK(same_bits(second.save(), saved));
    for (int k = 0; k < 3; ++k) {
        first.step();
        second.step();
    }
    CHECK(same_bits(timeless(first.save()), timeless(second.save())));
    CHECK(first.now().enthalpy_imbalance == second.now().enthalpy_imbalance);
    CHECK(first.now().fuel_power == second.now().fuel_power);

    SUBCASE("what does not fit is refused, and changes nothing") {
        saved_state lacking = saved, shorter = saved;
        lacking.erase("gas/enthalpy");
        shorter["gas/temperature"].pop_back();
        CHECK_THROWS_WITH_AS(second.restore(lacking), "the state lacks gas/enthalpy", bad_scene);
        CHECK_THROWS_AS(second.restore(shorter), bad_scene);
        CHECK(same_bits(timeless(second.save()), timeless(first.save())));
    }
}
