// SPDX-License-Identifier: MIT
// A bed that starts dense without a fall, and stones that wait in the hopper.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "coarse_column.hpp"

using namespace hearth::furnace;

namespace {

constexpr double pi = 3.14159265358979323846;

/// Three metres of the paper's shaft below a metre and a half of stones in the hopper, in parcels of six stones' width.
settings shaft_with_hopper() {
    settings scene = short_shaft(6, 0.2);
    scene.shaft.hopper_fill = 1.5;
    scene.bed.packing = bed_packing::dense;
    scene.bed.motion = bed_motion::plug;
    scene.bed.coarse_graining = 6;
    scene.bed.void_fraction = 0.46;
    scene.time.couplings = 6;
    scene.time.residence_times = 0.3;
    return scene;
}

double volume(double radius) { return 4.0 / 3.0 * pi * radius * radius * radius; }

/// Where parcels are as one column: the hopper's follow on the shaft's.
std::vector<std::array<double, 3>> column_of(const snapshot& seen, const settings& scene) {
    auto places = seen.particle_position;
    for (auto& x : places) x[2] -= x[2] >= scene.shaft.height ? scene.shaft.hopper_height : 0.0;
    return places;
}

}  // namespace

TEST_CASE(
    "dense: true void fraction, the scene's sizes, and no overlap beyond DEM's own, over joints and the turn of the "
    "plug too") {
    const settings scene = shaft_with_hopper();
    furnace shaft(scene);
    run_couplings(shaft, 0);
    const double height = 4.5, section = pi / 4 * 0.85 * 0.85;
    for (int moves = 0; moves < 2; ++moves) {
        const snapshot seen = shaft.look();
        const auto places = column_of(seen, scene);
        const std::size_t count = places.size();
        double solid = 0, deepest = 0, out = 0;
        int contacts = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double r = seen.particle_radius[i];
            solid += volume(r);
            out = std::max(out, (std::hypot(places[i][0], places[i][1]) + r - 0.425) / r);
            for (std::size_t j = 0; j < i; ++j) {
                const double up = std::abs(places[i][2] - places[j][2]), z = std::min(up, height - up);
                const double touch = r + seen.particle_radius[j];
                if (z > touch) continue;
                const double apart = std::hypot(places[i][0] - places[j][0], places[i][1] - places[j][1], z);
                if (apart < touch) ++contacts;
                deepest = std::max(deepest, 1 - apart / touch);
            }
        }
        CAPTURE(count);
        CHECK(solid == doctest::Approx(0.54 * section * height).epsilon(1e-9));
        // A thousandth of the mean diameter is what the packing allows, and radii differ by a tenth from the mean.
        CHECK(deepest < 1.2e-3);
        CHECK(out < 2.4e-3);
        CHECK(contacts > 1.5 * static_cast<double>(count));  // three contacts each at least: a bed, no suspension
        shaft.step();
    }
    // The sizes drawn have the shares of the table: of these 2300 parcels in three equal pieces or fewer, by mass,
    // within four standard deviations of 770 draws.
    std::array<double, 4> mass{};
    const snapshot seen = shaft.look();
    double all = 0, scale = 0;
    for (const double r : seen.particle_radius) scale = std::max(scale, 2 * r / (6 * 19.5e-3));
    for (const double r : seen.particle_radius) {
        const double d = 2 * r / scale / 6;
        mass[d < 16.5e-3 ? 0 : d < 17.5e-3 ? 1 : d < 18.7e-3 ? 2 : 3] += volume(r);
        all += volume(r);
    }
    CHECK(scale == doctest::Approx(1).epsilon(1e-3));
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(std::abs(mass[k] / all - scene.particles.sizes[k].mass_share) < 4 * 0.5 / std::sqrt(770.0));
    // The same seed, the same bits; another, another bed.
    furnace same(scene);
    run_couplings(same, 0);
    settings otherwise = scene;
    otherwise.output.seed = 2;
    furnace other(otherwise);
    run_couplings(other, 0);
    furnace first(scene);
    run_couplings(first, 0);
    CHECK(same.look().particle_position == first.look().particle_position);
    CHECK(other.look().particle_position != first.look().particle_position);
}

TEST_CASE("dense: what cannot be packed is refused with the key") {
    settings scene = shaft_with_hopper();
    scene.bed.void_fraction = 0.36;
    try {
        const furnace shaft(scene);
        FAIL("packed");
    } catch (const bad_scene& refused) {
        CHECK(std::string(refused.what()).find("bed.void_fraction is 0.36, allowed: more") == 0);
    }
}

TEST_CASE("hopper: its stones are cold, sink with the bed, enter it one by one, and neither gas nor wall sees them") {
    const settings scene = shaft_with_hopper();
    const plan planned = foresee(scene);
    furnace shaft(scene);
    run_couplings(shaft, 0);
    const auto waiting = [&] {
        const snapshot seen = shaft.look();
        std::int64_t above = 0;
        for (std::size_t i = 0; i < seen.particle_position.size(); ++i) {
            const double z = seen.particle_position[i][2];
            CHECK((z < 3 || z >= 3.5));  // none in the free space that the off-gas leaves by
            CHECK(z < 5);
            if (z < 3) continue;
            ++above;
            CHECK(seen.particle_temperature[i] == scene.particles.feed_temperature);
            CHECK(seen.heat_transfer_coefficient[i] == 0);
        }
        return above;
    };
    const auto before = static_cast<double>(waiting());
    CHECK(static_cast<double>(planned.waiting) == doctest::Approx(before).epsilon(0.03));
    CHECK(static_cast<double>(planned.parcels) ==
          doctest::Approx(static_cast<double>(shaft.look().particle_radius.size()) - before).epsilon(0.03));
    // Volume that the cells hold: all of the shaft's and nothing of the hopper's.
    const snapshot seen = shaft.look();  // before a coupling moves the bed on
    double held = 0, shafts = 0;
    for (std::size_t c = 0; c < seen.void_fraction.size(); ++c)
        held += seen.cell_volume[c] * (1 - seen.void_fraction[c]);
    for (std::size_t i = 0; i < seen.particle_radius.size(); ++i)
        shafts += seen.particle_position[i][2] < 3 ? volume(seen.particle_radius[i]) : 0.0;
    CHECK(held == doctest::Approx(shafts).epsilon(1e-9));
    run_couplings(shaft, 6);
    CHECK(static_cast<double>(waiting()) == doctest::Approx(before).epsilon(0.03));
    const summary end = shaft.summarise();
    // The shaft's own bed: void fraction and residence time are its, not those of all stones; and 0.03 for the parcels
    // that the shaft's top cuts.
    CHECK(*end.mean_void_fraction == doctest::Approx(0.46).epsilon(0.03));
    CHECK(*end.residence_time == doctest::Approx(0.54 * pi / 4 * 0.85 * 0.85 * 3 * 3580 / 3000).epsilon(0.03));
    CHECK(std::abs(*end.enthalpy_audit) < 1e-3 * *end.fuel_power);
    CHECK(std::abs(*end.solid_mass_imbalance) < 1e-12);
}

TEST_CASE("hopper: a restart has the bits of a run that went on; a hopper over a bed that is no plug is refused") {
    settings scene = shaft_with_hopper();
    furnace calm(scene);
    run_couplings(calm, 2);
    furnace restored(scene);
    restored.restore(calm.save());
    calm.step();
    restored.step();
    CHECK(same_bits(timeless(restored.save()), timeless(calm.save())));
    scene.bed.motion = bed_motion::frozen;
    CHECK_THROWS_AS(check(scene), bad_scene);
}

TEST_CASE(
    "switched off: without radiation between stones the wall still loses heat, and the centre stays behind the wall") {
    settings scene = shaft_with_hopper();
    scene.shaft.hopper_fill = 0;
    scene.time.couplings = 30;
    scene.time.residence_times = 0.6;
    const auto run = [&](bool radiation, bool conduction) {
        scene.physics.radiation = radiation;
        scene.physics.conduction = conduction;
        furnace shaft(scene);
        run_couplings(shaft, 30);
        const summary end = shaft.summarise();
        CHECK(std::abs(*end.enthalpy_audit) < 1e-3 * *end.fuel_power);
        CHECK(*end.wall_heat_loss > 0);
        return end;
    };
    const summary all = run(true, true), no_conduction = run(true, false), no_radiation = run(false, true),
                  neither = run(false, false);
    const auto gap = [](const summary& s) {
        return std::abs(*s.peak_particle_temperature - *s.centre_temperature_at_peak);
    };
    CAPTURE(gap(all));
    CAPTURE(gap(no_radiation));
    // Contacts carry some thousandths of what radiation carries.
    CHECK(std::abs(*no_conduction.peak_particle_temperature - *all.peak_particle_temperature) < 5);
    CHECK(std::abs(gap(no_conduction) - gap(all)) < 5);
    // Cells of 140 mm leave most of the gap to the burners' own; radiation levels a part of it all the same.
    CHECK(gap(no_radiation) > gap(all) + 30);
    CHECK(std::abs(gap(neither) - gap(no_radiation)) < 0.1 * gap(no_radiation));
}
