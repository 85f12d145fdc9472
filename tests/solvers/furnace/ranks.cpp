// SPDX-License-Identifier: MIT
// A furnace that several ranks share.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include <hearth/mpi/communicator.hpp>

#include "coarse_column.hpp"

using namespace hearth::furnace;

namespace {

/// The paper's furnace at a third of its height, with jets and a pipe in the side, that each lie on one rank.
settings small_furnace() {
    settings scene = short_shaft(6, 0.2);
    scene.bed.packing = bed_packing::lattice;
    scene.bed.motion = bed_motion::plug;
    scene.bed.coarse_graining = 8;
    scene.time.couplings = 4;
    scene.time.residence_times = 0.05;
    return scene;
}

settings moved_by_dem(bed_motion motion) {
    settings scene = small_furnace();
    scene.bed.packing = bed_packing::dem;
    scene.bed.motion = motion;
    scene.bed.coarse_graining = 10;
    scene.time.acceleration_factor = 300;
    return scene;
}

/// The parts of all ranks, one behind the other: what a checkpoint holds.
saved_state whole_of(const furnace& shaft, const ranks& among) {
    saved_state whole;
    for (const auto& [name, part] : shaft.save()) whole[name] = among.gather(part);
    return whole;
}

/// What the temperatures of gas and stones of two furnaces differ by [K], on rank 0.
double apart(const snapshot& a, const snapshot& b) {
    REQUIRE(a.gas_temperature.size() == b.gas_temperature.size());
    REQUIRE(a.particle_temperature.size() == b.particle_temperature.size());
    double most = 0;
    for (std::size_t k = 0; k < a.gas_temperature.size(); ++k) most = std::max(most, std::abs(a.gas_temperature[k] - b.gas_temperature[k]));
    for (std::size_t k = 0; k < a.particle_temperature.size(); ++k) {
        most = std::max(most, std::abs(a.particle_temperature[k] - b.particle_temperature[k]));
    }
    return most;
}

// The gas of a coupling is iterated until no temperature moves by 0.2 K, and its iterations contract by a half or better; so
// two that differ in round-off, and take a different number of them, end no farther apart than twice that.
constexpr double tolerance = 0.4;

}  // namespace

TEST_CASE("ranks: any number of them gives the same furnace, and its books close") {
    const ranks among = hearth::mpi::communicator();
    const settings scene = small_furnace();
    furnace shared(scene, among), alone(scene);
    run_couplings(shared, 4);
    run_couplings(alone, 4);
    const snapshot seen = shared.look(), expected = alone.look();
    if (among.rank() == 0) {
        CHECK(seen.cell_centre == expected.cell_centre);
        CHECK(seen.particle_position == expected.particle_position);
        CHECK(shared.cells().cells == alone.cells().cells);
        const double difference = apart(seen, expected);
        MESSAGE("temperatures differ by " << difference << " K");
        CHECK(difference < tolerance);
        for (std::size_t k = 0; k < seen.pressure.size(); ++k) CHECK(seen.pressure[k] == doctest::Approx(expected.pressure[k]).epsilon(1e-4));
    } else {
        CHECK(seen.gas_temperature.empty());
    }

    const summary one = alone.summarise(), all = shared.summarise();
    for_each_number(one, [&](const char* key, const summary::number& value) {
        const std::string name = key;
        for (const char* other : {"time", "memory", "share", "imbalance", "audit"}) {
            if (name.find(other) != std::string::npos) return;
        }
        for_each_number(all, [&](const char* same, const summary::number& here) {
            if (name != same) return;
            CAPTURE(name);
            CHECK(value.has_value() == here.has_value());
            // Temperatures to the tolerance; what follows from them as far as 0.4 of 300 K go.
            if (value && here) CHECK(*here == doctest::Approx(*value).epsilon(2e-3));
        });
    });
    CHECK(std::abs(*all.enthalpy_audit) < 1e-3 * *all.fuel_power);
    CHECK(std::abs(*all.gas_mass_imbalance) < 1e-6);
    CHECK(std::abs(*all.solid_mass_imbalance) < 1e-12 * *all.bed_mass);
    CHECK(*all.element_imbalance < 1e-6);
    // Every rank knows the same.
    const auto everywhere = among.gather(std::vector<double>{*all.enthalpy_audit, *all.offgas_temperature, shared.now().maximum_gas_temperature});
    for (std::size_t k = 0; k < everywhere.size(); ++k) CHECK(everywhere[k] == everywhere[k % 3]);

    const axial_profile profile = shared.axial(10), reference = alone.axial(10);
    for (std::size_t k = 0; k < 10; ++k) {
        CAPTURE(k);
        CHECK(profile.void_fraction[k] == doctest::Approx(reference.void_fraction[k]).epsilon(1e-9));
        CHECK(std::abs(profile.gas_temperature[k] - reference.gas_temperature[k]) < tolerance);
        CHECK(profile.radiation[k] == doctest::Approx(reference.radiation[k]).epsilon(1e-2).scale(1e3));
        CHECK(profile.wall[k] == doctest::Approx(reference.wall[k]).epsilon(1e-2).scale(1e3));
    }
}

TEST_CASE("ranks: as many go on with the same bits, another number to the solvers' tolerance") {
    const ranks among = hearth::mpi::communicator();
    const settings scene = small_furnace();
    furnace calm(scene, among);
    run_couplings(calm, 2);
    const saved_state state = whole_of(calm, among);
    run_couplings(calm, 2);

    furnace again(scene, among);
    again.restore(state);
    run_couplings(again, 2);
    CHECK(same_bits(timeless(again.save()), timeless(calm.save())));

    furnace alone(scene);
    alone.restore(state);
    CHECK(alone.steps_done() == 2);
    run_couplings(alone, 2);
    const snapshot seen = calm.look(), seen_alone = alone.look();
    if (among.rank() == 0) CHECK(apart(seen, seen_alone) < tolerance);

    // And back: what one rank has saved, several take up.
    furnace back(scene, among);
    back.restore(alone.save());
    const snapshot resumed = back.look();
    if (among.rank() == 0) {
        CHECK(resumed.gas_temperature == seen_alone.gas_temperature);
        CHECK(resumed.superficial_velocity == seen_alone.superficial_velocity);
        CHECK(resumed.particle_temperature == seen_alone.particle_temperature);
    }
    back.step();
    alone.step();
    const snapshot next = back.look(), next_alone = alone.look();
    if (among.rank() == 0) CHECK(apart(next, next_alone) < tolerance);
}

TEST_CASE("ranks: DEM packs and records the same bits on any number of them, and goes on on any") {
    const ranks among = hearth::mpi::communicator();
    const settings scene = moved_by_dem(bed_motion::recorded);
    furnace shared(scene, among), alone(scene), resumed(scene, among);
    int steps = 0;
    for (; alone.current() == phase::fill; ++steps) {
        alone.step();
        if (steps % 40 == 20) resumed.restore(alone.save());  // what one rank has saved, while it fell and while it moved
        else if (steps % 40 > 20) resumed.step();
        shared.step();
        const snapshot seen = shared.look(), expected = alone.look();
        REQUIRE(seen.particle_position == expected.particle_position);
        CHECK(shared.now().share_done == alone.now().share_done);
    }
    CHECK(steps > 21);
    CHECK(shared.current() == phase::ignite);
    if (steps % 40 > 20) CHECK(resumed.look().particle_position == alone.look().particle_position);
    furnace back(scene);
    furnace half(scene, among);
    half.step();
    back.restore(whole_of(half, among));  // what all have saved, one takes up
    half.step();
    back.step();
    CHECK(half.look().particle_position == back.look().particle_position);
}

TEST_CASE("ranks: DEM that moves the bed all the time has the same bits on any number of them, and goes on on any") {
    const ranks among = hearth::mpi::communicator();
    const settings scene = moved_by_dem(bed_motion::dem);
    furnace shared(scene, among), alone(scene);
    run_couplings(shared, 2);
    run_couplings(alone, 2);
    const auto agree = [&](const furnace& here, const furnace& there) {
        const snapshot seen = here.look(), expected = there.look();
        if (among.rank() != 0) return;
        CHECK(seen.particle_position == expected.particle_position);
        CHECK(apart(seen, expected) < tolerance);
    };
    agree(shared, alone);
    const summary books = shared.summarise();
    CHECK(std::abs(*books.enthalpy_audit) < 1e-3 * *books.fuel_power);
    CHECK(std::abs(*books.solid_mass_imbalance) < 1e-12 * *books.bed_mass);

    furnace again(scene, among), fewer(scene), more(scene, among);
    const saved_state state = whole_of(shared, among);
    again.restore(state);
    fewer.restore(state);
    more.restore(alone.save());
    for (furnace* f : {&shared, &alone, &again, &fewer, &more}) run_couplings(*f, 2);
    CHECK(same_bits(timeless(again.save()), timeless(shared.save())));
    agree(shared, fewer);
    agree(more, alone);
}

TEST_CASE("ranks: a state that does not fit is refused on every rank, and changes nothing") {
    const ranks among = hearth::mpi::communicator();
    const settings scene = small_furnace();
    furnace shaft(scene, among);
    run_couplings(shaft, 1);
    const saved_state good = whole_of(shaft, among);
    saved_state lacking = good, short_of_one = good, of_none = good;
    lacking.erase("gas/mass_flux");
    short_of_one["gas/temperature"].pop_back();
    of_none["ranks"] = {0};
    for (const saved_state* bad : {&lacking, &short_of_one, &of_none}) {
        CHECK_THROWS_AS(shaft.restore(*bad), bad_scene);
        CHECK(same_bits(whole_of(shaft, among), good));
    }
}
