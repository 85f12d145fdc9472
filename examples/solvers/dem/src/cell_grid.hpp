// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include <hearth/dem/particles.hpp>

namespace hearth::dem::detail {

/// Equal cubic cells over the bed, x fastest.  Points outside belong to the cells at the border, which keeps neighbours in
/// neighbouring cells: no particle can be lost, however far it flies.
class cell_grid {
  public:
    /// Cells at least `size` wide over `count` centres; at most about as many cells as particles in a dense bed.
    cell_grid(const sphere* spheres, std::size_t count, double size) {
        const std::size_t most = 4 * count + 64;
        for (int a = 0; a < 3; ++a) std::tie(low_[a], high_[a]) = extent(spheres, count, a, 0.0);
        if (cells_of(size) > static_cast<double>(most)) {
            // A few strays far away must not make the cells of all others huge.
            for (int a = 0; a < 3; ++a) std::tie(low_[a], high_[a]) = extent(spheres, count, a, 1e-3);
        }
        while (cells_of(size) > static_cast<double>(most)) size *= 1.26;
        inverse_size_ = 1 / size;
        for (int a = 0; a < 3; ++a) n_[at(a)] = static_cast<index>((high_[a] - low_[a]) * inverse_size_) + 1;
    }

    double inverse_size() const { return inverse_size_; }
    index cells() const { return n_[0] * n_[1] * n_[2]; }
    index count(int axis) const { return n_[at(axis)]; }
    index number(index x, index y, index z) const { return (z * n_[1] + y) * n_[0] + x; }

    index along(int axis, double coordinate) const {
        const double c = (coordinate - low_[axis]) * inverse_size_;
        return c > 0 ? static_cast<index>(std::fmin(c, n_[at(axis)] - 1)) : 0;
    }
    index cell(const vector3& p) const { return number(along(0, p.x), along(1, p.y), along(2, p.z)); }

    /// Counting sort of points into cells: order[new place] = old place, stable; and where each cell starts.
    void sort(const sphere* spheres, std::size_t count, std::vector<index>& order, std::vector<index>& start) const {
        std::vector<index> key(count);
        start.assign(static_cast<std::size_t>(cells()) + 1, 0);
        for (std::size_t i = 0; i < count; ++i) {
            key[i] = cell(spheres[i].centre);
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

  private:
    static constexpr std::size_t at(int axis) { return static_cast<std::size_t>(axis); }

    /// Range of coordinates without the given share at either end.
    static std::pair<double, double> extent(const sphere* spheres, std::size_t count, int axis, double share) {
        if (count == 0) return {0.0, 0.0};
        if (share == 0.0) {
            double low = spheres[0].centre[axis], high = low;
            for (std::size_t i = 1; i < count; ++i) {
                low = std::fmin(low, spheres[i].centre[axis]);
                high = std::fmax(high, spheres[i].centre[axis]);
            }
            return {low, high};
        }
        std::vector<double> values(count);
        for (std::size_t i = 0; i < count; ++i) values[i] = spheres[i].centre[axis];
        const auto skip = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(count)));
        const auto first = values.begin() + std::min<std::ptrdiff_t>(skip, static_cast<std::ptrdiff_t>(count) - 1);
        const auto last = values.end() - 1 - std::min<std::ptrdiff_t>(skip, static_cast<std::ptrdiff_t>(count) - 1);
        std::nth_element(values.begin(), first, values.end());
        const double low = *first;
        std::nth_element(values.begin(), last, values.end());
        return {std::fmin(low, *last), std::fmax(low, *last)};
    }

    double cells_of(double size) const {
        double product = 1;
        for (int a = 0; a < 3; ++a) product *= std::floor((high_[a] - low_[a]) / size) + 1;
        return product;
    }

    vector3 low_, high_;
    double inverse_size_ = 1;
    std::array<index, 3> n_{1, 1, 1};
};

}  // namespace hearth::dem::detail
