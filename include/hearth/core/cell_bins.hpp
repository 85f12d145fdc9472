// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <hearth/core/mesh_traits.hpp>

namespace hearth::detail {

/// A cell by its centre and its lengths along the axes [m].
struct placed_cell {
    point centre;
    point extent;
    std::int32_t cell;
};

/// Centre of a cell in a mesh that is shifted, seen from x [m].
inline point seen_from(const point& x, const point& centre, const point& shift) {
    return {(centre[0] + shift[0]) - x[0], (centre[1] + shift[1]) - x[1], (centre[2] + shift[2]) - x[2]};
}

/// Cells sorted by size into levels, powers of two of their longest side, and each level into bins of that side, so
/// that a mesh with tiny and huge cells needs few visits at either end.  About 60 bytes a cell.
class cell_bins {
  public:
    cell_bins() = default;

    explicit cell_bins(std::vector<placed_cell> cells) {
        const auto size_class = [](const placed_cell& p) {
            return std::ilogb(std::max({p.extent[0], p.extent[1], p.extent[2]}));
        };
        std::stable_sort(cells.begin(), cells.end(),
                         [&](const placed_cell& a, const placed_cell& b) { return size_class(a) < size_class(b); });
        for (auto begin = cells.begin(), end = begin; begin != cells.end(); begin = end) {
            end = std::find_if(begin, cells.end(),
                               [&](const placed_cell& p) { return size_class(p) != size_class(*begin); });
            levels_.emplace_back(begin, end);
        }
    }

    /// Visits, at least, every cell whose centre, shifted, is within `radius` [m] and `extents` of its own extents from
    /// x along each axis: visit(cell, centre - x [m], extent [m]).
    template <class Visit>
    void for_each_near(const point& x, const point& shift, double radius, double extents, Visit& visit) const {
        for (const level& l : levels_) l.for_each_near(x, shift, radius, extents, visit);
    }

    /// Bytes that it holds.
    std::size_t memory() const {
        std::size_t sum = levels_.capacity() * sizeof(level);
        for (const level& l : levels_) sum += l.memory();
        return sum;
    }

  private:
    /// Cells of one size class, bin by bin.
    class level {
      public:
        template <class Iterator>
        level(Iterator begin, Iterator end)
            : low_(begin->centre), high_(begin->centre), cells_(static_cast<std::size_t>(end - begin)) {
            for (auto p = begin; p != end; ++p) {
                for (std::size_t a = 0; a < 3; ++a) {
                    low_[a] = std::min(low_[a], p->centre[a]);
                    high_[a] = std::max(high_[a], p->centre[a]);
                    extent_[a] = std::max(extent_[a], p->extent[a]);
                }
            }
            starts_.assign(choose_bins() + 1, 0);
            for (auto p = begin; p != end; ++p) ++starts_[bin(p->centre) + 1];
            for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
            std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
            for (auto p = begin; p != end; ++p) cells_[next[bin(p->centre)]++] = *p;
        }

        template <class Visit>
        void for_each_near(const point& x, const point& shift, double radius, double extents, Visit& visit) const {
            std::array<std::int64_t, 3> first{}, last{};
            for (std::size_t a = 0; a < 3; ++a) {
                const double from = x[a] - shift[a] - radius - extents * extent_[a];
                const double to = x[a] - shift[a] + radius + extents * extent_[a];
                if (!(from <= high_[a] && to >= low_[a])) return;
                first[a] = bin(a, from);
                last[a] = bin(a, to);
            }
            for (std::int64_t k = first[2]; k <= last[2]; ++k) {
                for (std::int64_t j = first[1]; j <= last[1]; ++j) {
                    const auto row = static_cast<std::size_t>(bins_[0] * (j + bins_[1] * k));
                    const std::uint32_t end = starts_[row + static_cast<std::size_t>(last[0]) + 1];
                    for (std::uint32_t at = starts_[row + static_cast<std::size_t>(first[0])]; at < end; ++at) {
                        const placed_cell& p = cells_[at];
                        const point offset = seen_from(x, p.centre, shift);
                        double beyond = 0;
                        for (std::size_t a = 0; a < 3; ++a) {
                            beyond = std::max(beyond, std::fabs(offset[a]) - (radius + extents * p.extent[a]));
                        }
                        if (beyond <= 0) visit(p.cell, offset, p.extent);
                    }
                }
            }
        }

        std::size_t memory() const {
            return starts_.capacity() * sizeof(starts_[0]) + cells_.capacity() * sizeof(cells_[0]);
        }

      private:
        /// Bins as large as the largest cell, larger where that would make many more bins than cells; their number.
        std::size_t choose_bins() {
            for (double scale = 1;; scale *= 2) {
                double product = 1;
                for (std::size_t a = 0; a < 3; ++a) {
                    const double along = std::min(std::floor((high_[a] - low_[a]) / (scale * extent_[a])) + 1, 1e9);
                    bins_[a] = static_cast<std::int64_t>(along);
                    bins_per_metre_[a] = 1 / (scale * extent_[a]);
                    product *= along;
                }
                if (product <= 2 * static_cast<double>(cells_.size()) + 1) return static_cast<std::size_t>(product);
            }
        }

        std::int64_t bin(std::size_t axis, double x) const {
            const double at = std::floor((x - low_[axis]) * bins_per_metre_[axis]);
            return static_cast<std::int64_t>(std::clamp(at, 0.0, static_cast<double>(bins_[axis] - 1)));
        }
        std::size_t bin(const point& x) const {
            return static_cast<std::size_t>(bin(0, x[0]) + bins_[0] * (bin(1, x[1]) + bins_[1] * bin(2, x[2])));
        }

        point low_;       // lowest centre
        point high_;      // highest centre
        point extent_{};  // largest along each axis
        point bins_per_metre_{};
        std::array<std::int64_t, 3> bins_{1, 1, 1};
        std::vector<std::uint32_t> starts_;
        std::vector<placed_cell> cells_;
    };

    std::vector<level> levels_;
};

}  // namespace hearth::detail
