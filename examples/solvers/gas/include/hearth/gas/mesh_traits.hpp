// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <hearth/core/mesh_traits.hpp>
#include <hearth/gas/mesh.hpp>

/// How the gas mesh answers hearth: all tiers, so that voidage and transfer run on it as it is.
template <>
struct hearth::mesh_traits<hearth::gas::mesh> {
    using index = int;
    using scalar = double;
    using mesh_type = hearth::gas::mesh;

    static index cell_count(const mesh_type& m) { return m.owned_cells(); }
    static scalar volume(const mesh_type& m, index cell) { return m.volume[cell]; }

    template <class Visit>
    static void for_each_face(const mesh_type& m, Visit&& visit) {
        for (int f = 0; f < m.internal_faces(); ++f)
            if (m.neighbour[f] < m.owned_cells()) visit(m.owner[f], m.neighbour[f], norm(m.area[f]), m.conductance[f]);
    }
    template <class Visit>
    static void for_each_boundary_face(const mesh_type& m, Visit&& visit) {
        int patch = 0;
        for (const auto& p : m.patches) {
            for (int f = p.first; f < p.first + p.count; ++f) visit(f, m.owner[f], patch, norm(m.area[f]));
            ++patch;
        }
    }

    static point centre(const mesh_type& m, index cell) {
        const auto& x = m.centre[cell];
        return {x.x, x.y, x.z};
    }
    static index find_cell(const mesh_type& m, const point& x) { return m.find_cell({x[0], x[1], x[2]}); }

    static std::int64_t global_index(const mesh_type& m, index cell) { return m.global.empty() ? cell : m.global[cell]; }

    /// Both ranks list each face; the ranks of the ghosts are the mesh's `ghost_rank`.
    template <class Visit>
    static void for_each_remote_face(const mesh_type& m, Visit&& visit) {
        for (int f = 0; f < m.internal_faces(); ++f) {
            const int ghost = m.neighbour[f];
            if (ghost >= m.owned_cells())
                visit(m.owner[f], m.ghost_rank[ghost - m.owned_cells()], m.global[ghost], norm(m.area[f]), m.conductance[f]);
        }
    }
};
