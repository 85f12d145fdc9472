// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/dem/facet.hpp>
#include <hearth/dem/particles.hpp>

#include "quantile.hpp"

namespace hearth::dem::detail {

/// Equal cubic cells over the bed, x fastest.  Points outside belong to the cells at the border, which keeps neighbours in
/// neighbouring cells: no particle can be lost, however far it flies.  A rank can look at a part of the cells.
class cell_grid {
  public:
    /// Cells at least `size` wide over the centres of all ranks, which lie within `extent`; at most about as many cells as
    /// particles in a dense bed.
    template <class Centre>
    cell_grid(std::size_t count, const box3& extent, const Centre& centre, double size, const ranks& among)
        : low_(extent.low), high_(extent.high) {
        const std::int64_t everybody = among.sum(static_cast<std::int64_t>(count));
        const double most = 4.0 * static_cast<double>(everybody) + 64;
        if (cells_of(size) > most) {
            // A few strays far away must not make the cells of all others huge: a thousandth at either end is left out.
            const std::int64_t few = everybody / 1000 + 1;
            for (int a = 0; a < 3; ++a) {
                const auto along_axis = [&](std::size_t i) { return centre(i)[a]; };
                const double low = quantile(count, along_axis, low_[a], high_[a], few, among);
                const double high = quantile(count, along_axis, low_[a], high_[a], everybody - few, among);
                low_[a] = std::fmin(low, high);
                high_[a] = std::fmax(low, high);
            }
        }
        while (cells_of(size) > most) size *= 1.26;
        inverse_size_ = 1 / size;
        for (int a = 0; a < 3; ++a) n_[at(a)] = static_cast<index>((high_[a] - low_[a]) * inverse_size_) + 1;
    }

    /// The same over spheres of this rank alone.
    cell_grid(const sphere* spheres, std::size_t count, double size)
        : cell_grid(count, extent_of(spheres, count), [&](std::size_t i) -> const vector3& { return spheres[i].centre; },
                    size, *over(serial_communicator{})) {}

    /// From here on only the cells between two coordinates; those beyond belong to the cells at the border.
    void narrow(int axis, double low, double high) {
        const index first = along(axis, low), last = std::max(first, along(axis, high));
        first_[at(axis)] = first;
        n_[at(axis)] = last - first + 1;
    }

    double inverse_size() const { return inverse_size_; }
    index cells() const { return n_[0] * n_[1] * n_[2]; }
    index count(int axis) const { return n_[at(axis)]; }
    index number(index x, index y, index z) const { return (z * n_[1] + y) * n_[0] + x; }

    index along(int axis, double coordinate) const {
        const double c = std::floor((coordinate - low_[axis]) * inverse_size_) - first_[at(axis)];
        return c > 0 ? static_cast<index>(std::fmin(c, n_[at(axis)] - 1)) : 0;
    }
    index cell(const vector3& p) const { return number(along(0, p.x), along(1, p.y), along(2, p.z)); }

    /// Counting sort of points into cells: order[new place] = old place, stable; and where each cell starts.
    template <class Centre>
    void sort(std::size_t count, const Centre& centre, std::vector<index>& order, std::vector<index>& start) const {
        std::vector<index> key(count);
        start.assign(static_cast<std::size_t>(cells()) + 1, 0);
        for (std::size_t i = 0; i < count; ++i) {
            key[i] = cell(centre(i));
            ++start[static_cast<std::size_t>(key[i]) + 1];
        }
        for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
        order.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            order[static_cast<std::size_t>(start[static_cast<std::size_t>(key[i])]++)] = static_cast<index>(i);
        }
        for (std::size_t c = start.size() - 1; c > 0; --c) start[c] = start[c - 1];
        start[0] = 0;
    }
    void sort(const sphere* spheres, std::size_t count, std::vector<index>& order, std::vector<index>& start) const {
        sort(count, [&](std::size_t i) -> const vector3& { return spheres[i].centre; }, order, start);
    }

    /// Sorts the points of each cell by their ids.
    template <class Id>
    static void sort_within_cells(const Id& id, std::vector<index>& order, const std::vector<index>& start) {
        for (std::size_t c = 0; c + 1 < start.size(); ++c) {
            if (start[c + 1] - start[c] < 2) continue;
            std::sort(order.begin() + start[c], order.begin() + start[c + 1],
                      [&](index a, index b) { return id(a) < id(b); });
        }
    }

  private:
    static constexpr std::size_t at(int axis) { return static_cast<std::size_t>(axis); }

    static box3 extent_of(const sphere* spheres, std::size_t count) {
        if (count == 0) return {};
        box3 box{spheres[0].centre, spheres[0].centre};
        for (std::size_t i = 1; i < count; ++i) {
            for (int a = 0; a < 3; ++a) {
                box.low[a] = std::fmin(box.low[a], spheres[i].centre[a]);
                box.high[a] = std::fmax(box.high[a], spheres[i].centre[a]);
            }
        }
        return box;
    }

    double cells_of(double size) const {
        double product = 1;
        for (int a = 0; a < 3; ++a) product *= std::floor((high_[a] - low_[a]) / size) + 1;
        return product;
    }

    vector3 low_, high_;
    double inverse_size_ = 1;
    std::array<index, 3> n_{1, 1, 1}, first_{0, 0, 0};
};

}  // namespace hearth::dem::detail
