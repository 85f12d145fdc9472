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
#include <hearth/core/cell_bins.hpp>
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
/// The *reach* of a cell is the box of all points within `widest` extents of its centre, along each axis.  Holds about
/// 60 bytes a cell (see cell_bins.hpp); nothing on a lattice.
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
            std::vector<detail::placed_cell> cells = read();
            throw_agreed(graph.communicator(), wrong_);
            if (!is_lattice()) bins_ = detail::cell_bins(std::move(cells));
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

    /// What this rank holds [bytes].
    std::size_t memory() const { return bins_.memory() + reach_of_ranks_.capacity() * sizeof(box); }

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
                bins_.for_each_near(x, shift, radius, extents, visit);
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

    bool is_lattice() const { return has_lattice_v<Mesh> && graph_->lattice().has_value(); }

    /// Reads and checks every cell, and grows the reach by it.  Returns nothing on a lattice.
    std::vector<detail::placed_cell> read() {
        std::vector<detail::placed_cell> cells;
        if (!is_lattice()) cells.reserve(static_cast<std::size_t>(graph_->cell_count()));
        for (index c = 0; c < graph_->cell_count(); ++c) {
            const auto host = static_cast<host_index>(c);
            detail::placed_cell p{{}, {}, c};
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
                    visit(i + shape.cells[0] * (j + shape.cells[1] * k), detail::seen_from(x, centre, shift),
                          shape.spacing);
                }
            }
        }
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
    detail::cell_bins bins_;  // empty on a lattice
    std::vector<box> reach_of_ranks_;
};

}  // namespace hearth
