// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <hearth/gas/mesh.hpp>
#include <hearth/gas/parallel.hpp>

namespace hearth::furnace {

/// Spheres are loose where they touch a wall.  Of parcels that layer is k times as wide as that of the stones that they
/// stand for, and gas takes it as a channel: so the mean solid fraction over the radius, `shares` rings wide, is
/// brought nearer to that of the bed, to a k-th of the distance.  What is random in it stays, and so does the solid
/// volume of the shaft.
inline void narrow_wall_layer(const gas::mesh& mesh, double radius, double height, double coarse_graining, int rings,
                              const gas::parallel& ranks, std::vector<double>& solid) {
    std::vector<double> held(static_cast<std::size_t>(rings)), volume(held);
    const auto ring = [&](int c) {
        const double share =
            std::sqrt(mesh.centre[c].x * mesh.centre[c].x + mesh.centre[c].y * mesh.centre[c].y) / radius;
        return static_cast<std::size_t>(std::clamp(static_cast<int>(share * rings), 0, rings - 1));
    };
    for (int c = 0; c < mesh.owned_cells(); ++c) {
        if (mesh.centre[c].z > height) continue;
        const std::size_t r = ring(c);
        held[r] += mesh.volume[c] * solid[static_cast<std::size_t>(c)];
        volume[r] += mesh.volume[c];
    }
    ranks.sum(held.data(), rings);
    ranks.sum(volume.data(), rings);
    const double mean = std::accumulate(held.begin(), held.end(), 0.0) / std::accumulate(volume.begin(), volume.end(), 0.0);
    for (int c = 0; c < mesh.owned_cells(); ++c) {
        if (mesh.centre[c].z > height) continue;
        const std::size_t r = ring(c);
        if (!(held[r] > 0)) continue;
        const double here = held[r] / volume[r];
        solid[static_cast<std::size_t>(c)] *= (mean + (here - mean) / coarse_graining) / here;
    }
}

}  // namespace hearth::furnace
