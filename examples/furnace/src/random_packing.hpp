// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <hearth/dem/feed.hpp>
#include <hearth/dem/particles.hpp>

namespace hearth::furnace {

/// A piece of a round shaft that repeats upwards: what sticks out of it above lies in the piece that comes next.
struct repeated_piece {
    double radius;         ///< [m]
    double height;         ///< after which it repeats; five of the largest spheres at least [m]
    double void_fraction;  ///< of the piece, from its wall on [-]
};

/// Spheres that lie at random in a piece, pushed apart and off the wall until no overlap is deeper than a thousandth of
/// the mean diameter; centres from height 0 to that of the piece.  Nothing has fallen, so nothing presses on anything,
/// but a sphere still touches 4.4 others, as many as in a packing of DEM.
///
/// The same seed gives the same spheres.  Radii are scaled, all alike and by less than a sphere's share, to hold the
/// void fraction exactly.  Spheres of one place lie near one another in the list.  Throws bad_scene where the spheres
/// cannot be pushed apart: no random packing has a void fraction much below 0.36, and near a wall it is larger.
std::vector<dem::sphere> random_packing(const repeated_piece& piece, const dem::size_distribution& sizes,
                                        std::uint64_t seed);

}  // namespace hearth::furnace
