// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <hearth/dem/bed.hpp>

#include "cell_grid.hpp"
#include "history.hpp"
#include "store.hpp"

namespace hearth::dem::detail {

/// Pairs of particles that may touch before the lists are rebuilt, with their springs: 32 bytes a pair.
/// The first of a pair is the one with the lower id, and pairs are in the order of cells and ids: forces have the same bits
/// on any number of ranks.  A pair with a ghost is on the lists of both ranks.
struct pair_list {
    std::vector<bed::pair> pairs;
    std::vector<vector3> springs;
    std::vector<vector3> rolls;  ///< of rolling friction, else empty

    std::size_t bytes() const {
        return pairs.capacity() * sizeof(bed::pair) + (springs.capacity() + rolls.capacity()) * sizeof(vector3);
    }
};

/// Calls visit(first place, end of places) for the runs of places in the rows of cells around (x, y, z), `wide` cells to
/// each side.  `forward`: only the later half, beginning behind the place `from`.
template <class Visit>
void for_each_run(const cell_grid& grid, const std::vector<index>& start, index x, index y, index z, index wide,
                  bool forward, Visit&& visit) {
    const auto begin_of = [&](index cell) { return start[static_cast<std::size_t>(cell)]; };
    const index x0 = std::max<index>(0, x - wide), x1 = std::min<index>(grid.count(0) - 1, x + wide);
    const index y0 = std::max<index>(0, y - wide), y1 = std::min<index>(grid.count(1) - 1, y + wide);
    const index z0 = forward ? z : std::max<index>(0, z - wide), z1 = std::min<index>(grid.count(2) - 1, z + wide);
    for (index k = z0; k <= z1; ++k) {
        for (index j = (forward && k == z) ? y : y0; j <= y1; ++j) {
            const index left = (forward && k == z && j == y) ? x : x0;
            visit(begin_of(grid.number(left, j, k)), begin_of(grid.number(x1, j, k) + 1));
        }
    }
}

/// Particles sorted into the cells of one grid: owned ones, and all that count for contacts.
struct sorted_cells {
    cell_grid grid;
    std::vector<index> owned_start;
    std::vector<index> members, start;  ///< with ghosts among them, in the order of cells and ids; empty without ghosts
};

/// Fills the list with the pairs of at least one owned particle whose gap is below `reach`; springs come from the history,
/// whose rows are those of the owned particles before they were sorted (old_place).
void build_pairs(pair_list& list, const store& particles, const sorted_cells& cells, double reach, const history& past,
                 const std::vector<index>& old_place, bool rolling);

}  // namespace hearth::dem::detail
