// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <hearth/dem/bed.hpp>

namespace hearth::dem::detail {

/// A particle on whatever rank: without gaps between the members.
struct placed {
    vector3 centre;
    double radius, mass;
    std::int64_t id;
};

/// Those that are wanted of all ranks, on each rank, the lowest id first.
template <class Wanted>
std::vector<placed> gathered(const bed& b, Wanted&& wanted) {
    std::vector<placed> mine;
    for (index i = 0; i < b.size(); ++i)
        if (wanted(i)) mine.push_back({b.spheres()[i].centre, b.spheres()[i].radius, b.mass(i), b.ids()[i]});
    std::vector<placed> all = b.among().gather(mine);
    std::sort(all.begin(), all.end(), [](const placed& one, const placed& other) { return one.id < other.id; });
    return all;
}

}  // namespace hearth::dem::detail
