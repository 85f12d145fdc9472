// SPDX-License-Identifier: MIT
// Leaps towards the steady state, in a coarse column.
#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "coarse_column.hpp"

using namespace hearth::furnace;

namespace {

summary ran(start_from start, double acceleration_factor) {
    settings scene = coarse_column();
    scene.time.couplings = 160;
    scene.time.residence_times = 1.6;
    scene.time.acceleration_factor = acceleration_factor;
    scene.time.start = start;
    scene.time.steadying_interval = 20;
    furnace shaft(scene);
    run_couplings(shaft, scene.time.couplings);
    return shaft.summarise();
}

}  // namespace

TEST_CASE("steadying: a cold start and one from one dimension come to the same steady furnace, at any Gamma") {
    const summary led = ran(start_from::one_dimensional, 678), from_cold = ran(start_from::cold, 50);
    for (const summary* s : {&led, &from_cold}) {
        CHECK(std::abs(*s->enthalpy_imbalance) < 0.01 * *s->fuel_power);
        CHECK(std::abs(*s->enthalpy_audit) < 1e-3 * *s->fuel_power);
    }
    // 5 K is what the furnace promises; after as many couplings the parcels lie in the same places, whose noise
    // cancels.
    const auto near = [](const summary::number& a, const summary::number& b) { return std::abs(*a - *b) < 5; };  // [K]
    CHECK(near(led.peak_particle_temperature, from_cold.peak_particle_temperature));
    CHECK(near(led.centre_temperature_at_peak, from_cold.centre_temperature_at_peak));
    CHECK(near(led.offgas_temperature, from_cold.offgas_temperature));
    CHECK(near(led.solids_outlet_temperature, from_cold.solids_outlet_temperature));
}

TEST_CASE("steadying: a leap leads no stone beyond what can be steady, and says how often it was held there") {
    settings scene = short_shaft(4, 0.25);
    scene.bed.packing = bed_packing::lattice;
    scene.bed.motion = bed_motion::plug;
    scene.bed.coarse_graining = 10;
    scene.time.couplings = 40;
    scene.time.residence_times = 1;
    scene.time.balance_tolerance = 1;
    scene.time.start = start_from::cold;
    scene.time.steadying_interval = 4;  // far from steady, and few couplings to see it by
    furnace shaft(scene);
    run_couplings(shaft, 0);
    std::vector<double> before;
    int leaps = 0;
    double beyond = 0;
    for (int k = 0; k < scene.time.couplings; ++k) {
        shaft.step();
        const std::vector<double> after = shaft.look().particle_temperature;
        if (const int now = static_cast<int>(*shaft.summarise().steadying_leaps); now > leaps) {
            leaps = now;
            for (const double t : after) beyond = std::max({beyond, 300 - t, t - steady_range(scene).hottest});
        }
    }
    const summary books = shaft.summarise();
    MESSAGE(leaps << " leaps, " << *books.steadying_leaps_halved << " halved; stones held " << *books.steadying_held
                  << " times; at most " << beyond << " K beyond");
    CHECK(leaps > 2);
    CHECK(*books.steadying_held > 0);
    // Without bounds some of its stones were led to 200 K, the end of the tables and 100 K below all that enters.  What a
    // slice changed by within a window may come on top of the bounds.
    CHECK(beyond < 100);
    CHECK(std::abs(*books.enthalpy_audit) < 1e-3 * *books.fuel_power);
}

TEST_CASE("steadying: between what enters and the burners' flame lies what is steady") {
    const settings paper;
    const temperature_range range = steady_range(paper);
    CHECK(range.coldest == 300);
    // Methane in air at 300 K, completely burnt: 2327 K by GRI-Mech's thermodynamics.
    CHECK(range.hottest == doctest::Approx(2327).epsilon(2e-3));
    settings other = paper;
    other.burners.mass_flow = 0;
    CHECK(steady_range(other).hottest == 320);  // the ambient of its walls
    other = paper;
    other.burners.temperature = 600;
    CHECK(steady_range(other).hottest > range.hottest);
    other = paper;
    other.burners.equivalence_ratio = 0.8;
    CHECK(steady_range(other).hottest < range.hottest);
    other.burners.equivalence_ratio = 1.1;  // what it lacks comes as hot as the flame
    CHECK(steady_range(other).hottest > range.hottest);
    const shaft_profile steady = solve_shaft_profile(paper);
    for (const double t : steady.particle_temperature) {
        CHECK(t > range.coldest - 1e-6);
        CHECK(t < range.hottest);
    }
}
