// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <hearth/core/mesh_traits.hpp>

namespace hearth {

/// Numbers of cells, spacing [m] and origin [m] of a structured mesh; cell = i + nx (j + ny k).
struct lattice_shape {
    std::array<std::int32_t, 3> cells{1, 1, 1};
    std::array<double, 3> spacing{1, 1, 1};
    std::array<bool, 3> periodic{false, false, false};
    point origin{0, 0, 0};  ///< lowest corner

    std::int64_t count() const {
        return std::int64_t{cells[0]} * std::int64_t{cells[1]} * std::int64_t{cells[2]};
    }
};

/// Ready-made mesh view: a structured lattice of equal boxes.
struct lattice : lattice_shape {};

template <>
struct mesh_traits<lattice> {
    using index = std::int32_t;
    using scalar = double;

    static index cell_count(const lattice& mesh) { return static_cast<index>(mesh.count()); }
    static scalar volume(const lattice& mesh, index) { return mesh.spacing[0] * mesh.spacing[1] * mesh.spacing[2]; }
    static lattice_shape lattice(const hearth::lattice& mesh) { return mesh; }

    template <class Visit>
    static void for_each_face(const hearth::lattice& mesh, Visit&& visit) {
        const auto& n = mesh.cells;
        const std::array<std::int64_t, 3> stride{1, n[0], std::int64_t{n[0]} * n[1]};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double area = volume(mesh, 0) / mesh.spacing[axis];
            const double conductance = area / mesh.spacing[axis];
            for (std::int32_t k = 0; k < n[2]; ++k) {
                for (std::int32_t j = 0; j < n[1]; ++j) {
                    for (std::int32_t i = 0; i < n[0]; ++i) {
                        const std::array<std::int32_t, 3> at{i, j, k};
                        const auto cell = static_cast<index>(i + stride[1] * j + stride[2] * k);
                        if (at[axis] + 1 < n[axis]) {
                            visit(cell, static_cast<index>(cell + stride[axis]), area, conductance);
                        } else if (mesh.periodic[axis]) {
                            visit(cell, static_cast<index>(cell - stride[axis] * (n[axis] - 1)), area, conductance);
                        }
                    }
                }
            }
        }
    }

    static point centre(const hearth::lattice& mesh, index cell) {
        const auto& n = mesh.cells;
        const std::array<std::int32_t, 3> at{cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
        point x{};
        for (std::size_t a = 0; a < 3; ++a) x[a] = mesh.origin[a] + (at[a] + 0.5) * mesh.spacing[a];
        return x;
    }

    static point extent(const hearth::lattice& mesh, index) { return mesh.spacing; }

    static point period(const hearth::lattice& mesh) {
        point length{};
        for (std::size_t a = 0; a < 3; ++a) length[a] = mesh.periodic[a] ? mesh.cells[a] * mesh.spacing[a] : 0.0;
        return length;
    }

    static index find_cell(const hearth::lattice& mesh, const point& x) {
        std::int64_t cell = 0;
        for (std::size_t a = 3; a-- > 0;) {
            const auto n = static_cast<double>(mesh.cells[a]);
            double at = std::floor((x[a] - mesh.origin[a]) / mesh.spacing[a]);
            if (mesh.periodic[a]) at -= n * std::floor(at / n);
            if (!(at >= 0 && at < n)) return -1;
            cell = cell * mesh.cells[a] + static_cast<std::int64_t>(at);
        }
        return static_cast<index>(cell);
    }
};

}  // namespace hearth
