// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <hearth/core/mesh_traits.hpp>

namespace hearth {

/// Owned cell that holds a point, or -1: the host's own answer where it has one; else, of the cells whose extents hold
/// the point, that with the nearest centre, and of equally near ones that of the lowest global index.
///
/// Locator: a cell_locator of the mesh.
template <class Mesh, class Locator>
std::int32_t find_cell(const Locator& locator, const Mesh& mesh, const point& x) {
    if constexpr (has_find_cell_v<Mesh>) {
        return static_cast<std::int32_t>(mesh_traits<Mesh>::find_cell(mesh, x));
    } else {
        std::int32_t found = -1;
        double nearest = 0;
        locator.for_each_near(x, 0, 0.5, [&](std::int32_t cell, const point& offset, const point& extent) {
            double away = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                if (std::fabs(offset[a]) > 0.5 * extent[a]) return;
                away += offset[a] * offset[a];
            }
            const auto id = [&](std::int32_t c) { return locator.graph().global_index(c); };
            if (found >= 0 && (away > nearest || (away == nearest && id(cell) > id(found)))) return;
            found = cell;
            nearest = away;
        });
        return found;
    }
}

}  // namespace hearth
