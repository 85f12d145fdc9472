// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/cell_graph.hpp>
#include <hearth/core/element.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/find_cell.hpp>
#include <hearth/core/mesh_traits.hpp>
#include <hearth/core/reproducible_sum.hpp>

namespace hearth {

/// An axis-aligned box [m]; empty where low > high.
struct box {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    point low{infinity, infinity, infinity};
    point high{-infinity, -infinity, -infinity};
};

/// Finds the cells near a sphere, from the centres and extents of the cells alone, so that it works on any mesh, on a
/// rank's share of one, and on islands of single cells.  Built once per mesh revision, beside the graph.
///
/// The *reach* of a cell is the box of all points within `widest` extents of its centre, along each axis.  Cells are
/// sorted by size into levels, powers of two of their longest side, and each level into bins of that side, so that a
/// mesh with tiny and huge cells needs few visits at either end.  About 60 bytes a cell; nothing on a lattice.
///
/// Keeps references to the mesh and to the graph: both must outlive it.
/// Errors: bad_value for centres that are not finite and extents that are not finite and positive.  Thrown on every
/// rank.
template <class Mesh, class Communicator = serial_communicator>
class cell_locator {
  public:
    using index = std::int32_t;
    static constexpr double widest = 2;

    cell_locator(const Mesh& mesh, const cell_graph<Communicator>& graph) : mesh_(&mesh), graph_(&graph) {
        require_located_mesh<Mesh>();
        if constexpr (is_located_mesh_v<Mesh>) {
            graph.require_current();
            if constexpr (has_period_v<Mesh>) {
                const auto length = traits::period(mesh);
                for (std::size_t a = 0; a < 3; ++a) period_[a] = static_cast<double>(element(length, a));
            }
            std::vector<placed> cells = read();
            throw_agreed(graph.communicator(), wrong_);
            if (!is_lattice()) sort(std::move(cells));
            measure();
            share_reach();
        }
    }

    const Mesh& mesh() const { return *mesh_; }
    const cell_graph<Communicator>& graph() const { return *graph_; }
    const Communicator& communicator() const { return graph_->communicator(); }

    /// Largest cell and sum of all cells, over all ranks [m^3].
    double largest_volume() const { return largest_volume_; }
    double total_volume() const { return total_volume_; }
    /// What the reaches of the cells of each rank cover.
    const std::vector<box>& reach_of_ranks() const { return reach_of_ranks_; }

    /// Owned cell that holds a point, or -1: the host's own answer, or by extents where it has none.
    index find(const point& x) const { return find_cell<Mesh>(*this, *mesh_, x); }

    /// Visits, at least, every owned cell whose centre is within `radius` [m] and `extents` (at most `widest`) of its
    /// own extents from x along each axis, once for each periodic image: visit(cell, centre - x [m], extent [m]).
    template <class Visit>
    void for_each_near(const point& x, double radius, double extents, Visit&& visit) const {
        for_each_image(x, radius, reach_, [&](const point& shift) {
            if (is_lattice()) {
                visit_lattice(x, shift, radius, extents, visit);
            } else {
                for (const level& l : levels_) visit_level(l, x, shift, radius, extents, visit);
            }
        });
    }

    /// Visits the shift [m] of the mesh for every periodic image of it in which the cube of half-width `radius` about x
    /// meets the box.
    template <class Visit>
    void for_each_image(const point& x, double radius, const box& target, Visit&& visit) const {
        std::array<std::int64_t, 3> first{}, last{};
        for (std::size_t a = 0; a < 3; ++a) {
            if (period_[a] > 0 && target.low[a] <= target.high[a]) {
                first[a] = static_cast<std::int64_t>(std::ceil((x[a] - radius - target.high[a]) / period_[a]));
                last[a] = static_cast<std::int64_t>(std::floor((x[a] + radius - target.low[a]) / period_[a]));
            } else if (!(x[a] - radius <= target.high[a] && x[a] + radius >= target.low[a])) {
                return;
            }
        }
        for (std::int64_t k = first[2]; k <= last[2]; ++k) {
            for (std::int64_t j = first[1]; j <= last[1]; ++j) {
                for (std::int64_t i = first[0]; i <= last[0]; ++i) {
                    visit(point{static_cast<double>(i) * period_[0], static_cast<double>(j) * period_[1],
                                static_cast<double>(k) * period_[2]});
                }
            }
        }
    }

  private:
    using traits = mesh_traits<Mesh>;
    using host_index = typename traits::index;

    struct placed {
        point centre;
        point extent;
        index cell;
    };

    /// Cells of one size class, bin by bin.
    struct level {
        point low{};     // lowest centre
        point high{};    // highest centre
        point extent{};  // largest along each axis
        point bins_per_metre{};
        std::array<std::int64_t, 3> bins{1, 1, 1};
        std::vector<std::uint32_t> starts;
        std::vector<placed> cells;

        std::int64_t bin(std::size_t axis, double x) const {
            const double at = std::floor((x - low[axis]) * bins_per_metre[axis]);
            return static_cast<std::int64_t>(std::clamp(at, 0.0, static_cast<double>(bins[axis] - 1)));
        }
        std::size_t bin(const point& x) const {
            return static_cast<std::size_t>(bin(0, x[0]) + bins[0] * (bin(1, x[1]) + bins[1] * bin(2, x[2])));
        }
    };

    bool is_lattice() const { return has_lattice_v<Mesh> && graph_->lattice().has_value(); }

    /// Reads and checks every cell, and grows the reach by it.  Returns nothing on a lattice.
    std::vector<placed> read() {
        std::vector<placed> cells;
        if (!is_lattice()) cells.reserve(static_cast<std::size_t>(graph_->cell_count()));
        for (index c = 0; c < graph_->cell_count(); ++c) {
            const auto host = static_cast<host_index>(c);
            placed p{{}, {}, c};
            const auto centre = traits::centre(*mesh_, host);
            if constexpr (has_extent_v<Mesh>) {
                const auto extent = traits::extent(*mesh_, host);
                for (std::size_t a = 0; a < 3; ++a) p.extent[a] = static_cast<double>(element(extent, a));
            } else {
                p.extent.fill(std::cbrt(graph_->volume(c)));
            }
            for (std::size_t a = 0; a < 3; ++a) {
                p.centre[a] = static_cast<double>(element(centre, a));
                if (!std::isfinite(p.centre[a])) complain("centre of cell", c, p.centre[a], "finite [m]");
                const bool positive = p.extent[a] > 0 && std::isfinite(p.extent[a]);
                if (!positive) complain("extent of cell", c, p.extent[a], "finite and > 0 [m]");
                reach_.low[a] = std::min(reach_.low[a], p.centre[a] - widest * p.extent[a]);
                reach_.high[a] = std::max(reach_.high[a], p.centre[a] + widest * p.extent[a]);
            }
            if (!is_lattice()) cells.push_back(p);
        }
        return cells;
    }

    void complain(const char* place, index cell, double value, const char* allowed) {
        if (!wrong_) wrong_.emplace(place, graph_->global_index(cell), value, allowed);
    }

    void sort(std::vector<placed> cells) {
        const auto size_class = [](const placed& p) {
            return std::ilogb(std::max({p.extent[0], p.extent[1], p.extent[2]}));
        };
        std::stable_sort(cells.begin(), cells.end(),
                         [&](const placed& a, const placed& b) { return size_class(a) < size_class(b); });
        for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
            level l;
            l.low = l.high = cells[begin].centre;
            for (end = begin; end < cells.size() && size_class(cells[end]) == size_class(cells[begin]); ++end) {
                for (std::size_t a = 0; a < 3; ++a) {
                    l.low[a] = std::min(l.low[a], cells[end].centre[a]);
                    l.high[a] = std::max(l.high[a], cells[end].centre[a]);
                    l.extent[a] = std::max(l.extent[a], cells[end].extent[a]);
                }
            }
            choose_bins(l, static_cast<double>(end - begin));
            const auto bin_count = static_cast<std::size_t>(l.bins[0] * l.bins[1] * l.bins[2]);
            l.starts.assign(bin_count + 1, 0);
            for (std::size_t k = begin; k < end; ++k) ++l.starts[l.bin(cells[k].centre) + 1];
            for (std::size_t b = 0; b < bin_count; ++b) l.starts[b + 1] += l.starts[b];
            std::vector<std::uint32_t> next(l.starts.begin(), l.starts.end() - 1);
            l.cells.resize(end - begin);
            for (std::size_t k = begin; k < end; ++k) l.cells[next[l.bin(cells[k].centre)]++] = cells[k];
            levels_.push_back(std::move(l));
        }
    }

    /// Bins as large as the largest cell of the level, larger where that would make many more bins than cells.
    static void choose_bins(level& l, double count) {
        for (double scale = 1;; scale *= 2) {
            double product = 1;
            for (std::size_t a = 0; a < 3; ++a) {
                const double along = std::min(std::floor((l.high[a] - l.low[a]) / (scale * l.extent[a])) + 1, 1e9);
                l.bins[a] = static_cast<std::int64_t>(along);
                l.bins_per_metre[a] = 1 / (scale * l.extent[a]);
                product *= along;
            }
            if (product <= 2 * count + 1) return;
        }
    }

    template <class Visit>
    static void visit_level(const level& l, const point& x, const point& shift, double radius, double extents,
                            Visit& visit) {
        std::array<std::int64_t, 3> first{}, last{};
        for (std::size_t a = 0; a < 3; ++a) {
            const double from = x[a] - shift[a] - radius - extents * l.extent[a];
            const double to = x[a] - shift[a] + radius + extents * l.extent[a];
            if (!(from <= l.high[a] && to >= l.low[a])) return;
            first[a] = l.bin(a, from);
            last[a] = l.bin(a, to);
        }
        for (std::int64_t k = first[2]; k <= last[2]; ++k) {
            for (std::int64_t j = first[1]; j <= last[1]; ++j) {
                const auto row = static_cast<std::size_t>(l.bins[0] * (j + l.bins[1] * k));
                const std::uint32_t end = l.starts[row + static_cast<std::size_t>(last[0]) + 1];
                for (std::uint32_t at = l.starts[row + static_cast<std::size_t>(first[0])]; at < end; ++at) {
                    const placed& p = l.cells[at];
                    visit(p.cell, offset(p.centre, shift, x), p.extent);
                }
            }
        }
    }

    template <class Visit>
    void visit_lattice(const point& x, const point& shift, double radius, double extents, Visit& visit) const {
        const lattice_shape& shape = *graph_->lattice();
        std::array<std::int32_t, 3> first{}, last{};
        for (std::size_t a = 0; a < 3; ++a) {
            const double at = (x[a] - shift[a] - shape.origin[a]) / shape.spacing[a] - 0.5;
            const double reach = radius / shape.spacing[a] + extents;
            const double top = shape.cells[a] - 1;
            if (!(at + reach >= 0 && at - reach <= top)) return;
            first[a] = static_cast<std::int32_t>(std::max(std::floor(at - reach), 0.0));
            last[a] = static_cast<std::int32_t>(std::min(std::ceil(at + reach), top));
        }
        for (std::int32_t k = first[2]; k <= last[2]; ++k) {
            for (std::int32_t j = first[1]; j <= last[1]; ++j) {
                for (std::int32_t i = first[0]; i <= last[0]; ++i) {
                    const point centre{shape.origin[0] + (i + 0.5) * shape.spacing[0],
                                       shape.origin[1] + (j + 0.5) * shape.spacing[1],
                                       shape.origin[2] + (k + 0.5) * shape.spacing[2]};
                    visit(i + shape.cells[0] * (j + shape.cells[1] * k), offset(centre, shift, x), shape.spacing);
                }
            }
        }
    }

    static point offset(const point& centre, const point& shift, const point& x) {
        return {(centre[0] + shift[0]) - x[0], (centre[1] + shift[1]) - x[1], (centre[2] + shift[2]) - x[2]};
    }

    void measure() {
        const double *v = graph_->volumes(), *end = v + graph_->cell_count();
        largest_volume_ = communicator().max(v == end ? 0.0 : *std::max_element(v, end));
        reproducible_sum total(largest_volume_, std::int64_t{1} << 36);
        for (; v != end; ++v) total.add(*v);
        communicator().sum(total.limbs(), reproducible_sum::limb_count());
        total_volume_ = total.value();
    }

    void share_reach() {
        reach_of_ranks_.assign(static_cast<std::size_t>(communicator().size()), reach_);
        if constexpr (Communicator::is_distributed) {
            std::vector<parcel<box>> outgoing;
            for (int r = 0; r < communicator().size(); ++r) {
                if (r != communicator().rank()) outgoing.push_back({r, {reach_}});
            }
            for (const auto& from : communicator().exchange(std::move(outgoing))) {
                reach_of_ranks_[static_cast<std::size_t>(from.rank)] = from.values.front();
            }
        }
    }

    const Mesh* mesh_;
    const cell_graph<Communicator>* graph_;
    std::optional<bad_value> wrong_;
    point period_{0, 0, 0};
    box reach_;
    double largest_volume_ = 0, total_volume_ = 0;
    std::vector<level> levels_;
    std::vector<box> reach_of_ranks_;
};

}  // namespace hearth
