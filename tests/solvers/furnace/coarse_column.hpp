// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstring>
#include <iterator>
#include <vector>

#include <hearth/furnace/furnace.hpp>

namespace hearth::furnace {

/// A fifth of the shaft's diameter, so that few parcels will do: fluxes and losses per mass are those of the paper.
inline settings coarse_column() {
    settings scene;
    scene.title = "coarse column";
    scene.shaft.diameter = 0.17;
    scene.shaft.hopper_height = 0;
    scene.shaft.zones = {{0, 10, 3 * 0.2, 320}};
    for (double* flow : {&scene.particles.mass_flow, &scene.air.volume_flow, &scene.burners.mass_flow}) *flow *= 0.04;
    scene.burners.feed = burner_feed::section;
    scene.bed.packing = bed_packing::lattice;
    scene.bed.motion = bed_motion::plug;
    scene.bed.coarse_graining = 2.2;
    scene.physics.combustion = burning::mixed_is_burnt;
    scene.mesh.across = 4;
    scene.mesh.axial_size = 0.12;
    scene.mesh.axial_size_bottom = 0.04;
    scene.mesh.axial_size_burners = 0.05;
    scene.time.couplings = 12;
    scene.time.residence_times = 0.06;
    scene.time.balance_tolerance = 1;
    return scene;
}

/// The lowest 3 m of the paper's shaft with burners at 2 m, on cells of a height, half as high at the bottom and at the burners.
inline settings short_shaft(int cells_across, double cell_height) {
    settings scene;
    scene.shaft.height = 3;
    scene.shaft.hopper_height = 0.5;
    scene.burners.height = 2;
    scene.physics.combustion = burning::mixed_is_burnt;
    scene.mesh.across = cells_across;
    scene.mesh.axial_size = cell_height;
    scene.mesh.axial_size_bottom = scene.mesh.axial_size_burners = 0.5 * cell_height;
    return scene;
}

/// Without what a clock tells.
inline saved_state timeless(saved_state state) {
    for (auto at = state.begin(); at != state.end();) at = at->first.compare(0, 8, "seconds/") == 0 ? state.erase(at) : std::next(at);
    return state;
}

/// Bits, not values: DEM's state is bytes, and some of them look like numbers that are not.
inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}
inline bool same_bits(const saved_state& a, const saved_state& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
        return one.first == other.first && same_bits(one.second, other.second);
    });
}

inline void run_couplings(furnace& shaft, int count) {
    while (shaft.current() == phase::fill || shaft.current() == phase::ignite) shaft.step();
    for (int k = 0; k < count; ++k) shaft.step();
}

}  // namespace hearth::furnace
