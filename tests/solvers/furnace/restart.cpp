// SPDX-License-Identifier: MIT
// A furnace that DEM packs, saved and restored at every phase.
#include <doctest/doctest.h>

#include <string>

#include "coarse_column.hpp"

using namespace hearth::furnace;

namespace {

void restart_everywhere(bed_motion motion) {
    settings scene = short_shaft(4, 0.3);
    scene.shaft.hopper_height = 0;
    scene.bed.packing = bed_packing::dem;
    scene.bed.motion = motion;
    scene.bed.coarse_graining = 10;
    scene.time.acceleration_factor = 300;
    scene.time.couplings = 2;
    scene.time.residence_times = 0.05;
    furnace calm(scene);
    int steps = 0, compared = 0;
    for (; !calm.done(); ++steps) {
        const phase before = calm.current();
        if (before == phase::fill && steps % 12 != 0) {
            calm.step();
            continue;
        }
        furnace restored(scene);
        restored.restore(calm.save());
        CHECK(restored.current() == before);
        calm.step();
        restored.step();
        CAPTURE(steps);
        CAPTURE(std::string(name(before)));
        const saved_state one = timeless(calm.save()), other = timeless(restored.save());
        for (const auto& entry : one) {
            CAPTURE(entry.first);
            CHECK(same_bits(other.at(entry.first), entry.second));
        }
        CHECK(other.size() == one.size());
        ++compared;
    }
    CHECK(compared >= 5);  // filling, ignition, and the couplings
}

}  // namespace

TEST_CASE("restart: before and after every phase the state holds all that the next step depends on") {
    SUBCASE("motion by a recording") { restart_everywhere(bed_motion::recorded); }
    SUBCASE("motion by DEM") { restart_everywhere(bed_motion::dem); }
}
