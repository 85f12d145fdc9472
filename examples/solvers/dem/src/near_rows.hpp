// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "pair_list.hpp"

namespace hearth::dem::detail {

/// Spheres sorted into cells that are finer than the reach of a search: fewer tests.
struct fine_cells {
    cell_grid grid;
    std::vector<index> order, start;  ///< as of cell_grid::sort
    index wide;                       ///< cells within reach to each side

    fine_cells(const sphere* spheres, std::size_t count, double reach)
        : grid(spheres, count, reach / 3), wide(static_cast<index>(std::ceil(reach * grid.inverse_size() - 1e-12))) {
        grid.sort(spheres, count, order, start);
    }
};

/// Calls use(place a, places b, how many): those later places b whose centres are within `reach` of that of a.  Every place
/// has its row; `centres` are in the order of places.
template <class Use>
void for_each_near_row(const fine_cells& cells, const std::vector<vector3>& centres, double reach, Use&& use) {
    const cell_grid& grid = cells.grid;
    std::vector<index> found;
    for (std::size_t a = 0; a < centres.size(); ++a) {
        const vector3 x = centres[a];
        std::size_t count = 0;
        for_each_run(grid, cells.start, grid.along(0, x.x), grid.along(1, x.y), grid.along(2, x.z), cells.wide, true,
                     [&](index begin, index end) {
                         const index from = std::max(begin, static_cast<index>(a) + 1);
                         if (end <= from) return;
                         const std::size_t room = count + static_cast<std::size_t>(end - from);
                         if (found.size() < room) found.resize(2 * room);
                         for (index b = from; b < end; ++b) {
                             const vector3 d = centres[static_cast<std::size_t>(b)] - x;
                             found[count] = b;
                             count += dot(d, d) < reach * reach ? 1u : 0u;
                         }
                     });
        use(static_cast<index>(a), found.data(), count);
    }
}

/// Pairs of spheres closer than factor * (R_i + R_j), each once, and perhaps some that are farther apart.
std::vector<bed::pair> near_pairs(const std::vector<sphere>& spheres, double factor);

}  // namespace hearth::dem::detail
