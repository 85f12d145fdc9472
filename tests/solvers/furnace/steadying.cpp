// SPDX-License-Identifier: MIT
// Leaps towards the steady state, in a coarse column.
#include <cmath>

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
