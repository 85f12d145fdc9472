// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/mesh_traits.hpp>

#include "support/random.hpp"

/// Meshes for tests: random graphs of many kinds, and any mesh spread over ranks or stored in another order.
namespace hearth::test {

using seeded = ::hearth_test::seeded;

/// A graph of cells as plain lists.
struct listed_graph {
    struct face {
        std::int32_t a, b;
        double conductance;
    };
    std::vector<double> volumes;
    std::vector<face> faces;

    std::int32_t cell_count() const { return static_cast<std::int32_t>(volumes.size()); }
    double volume() const {
        double sum = 0;
        for (const double v : volumes) sum += v;
        return sum;
    }
    void link(std::size_t a, std::size_t b) {
        faces.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), 1.0});
    }
};

/// One rank's cells of a mesh, in a random order of storage.  Global indices are those of the whole mesh (its own, or
/// the cells' numbers).  The whole mesh must outlive it.
template <class Mesh>
class partitioned_mesh {
  public:
    using whole_index = mesh_index_t<Mesh>;

    partitioned_mesh(const Mesh& whole, const std::vector<int>& owners, int rank, std::uint64_t storage_seed = 0)
        : whole_(&whole), owners_(owners), rank_(rank), local_(owners.size(), -1) {
        for (std::size_t c = 0; c < owners.size(); ++c) {
            if (owners[c] == rank) cells_.push_back(static_cast<whole_index>(c));
        }
        if (storage_seed != 0) {
            seeded random(storage_seed);
            for (std::size_t k = cells_.size(); k > 1; --k) std::swap(cells_[k - 1], cells_[random.index(k)]);
        }
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            local_[static_cast<std::size_t>(cells_[k])] = static_cast<std::int32_t>(k);
        }
    }

    const Mesh& whole() const { return *whole_; }
    std::int32_t cell_count() const { return static_cast<std::int32_t>(cells_.size()); }
    /// Cell of the whole mesh.
    whole_index cell(std::int32_t local) const { return cells_[static_cast<std::size_t>(local)]; }
    /// Local number of a cell of the whole mesh, or -1.
    std::int32_t local(whole_index cell) const { return cell < 0 ? -1 : local_[static_cast<std::size_t>(cell)]; }
    int owner(whole_index cell) const { return owners_[static_cast<std::size_t>(cell)]; }
    int rank() const { return rank_; }

    /// visit(a, b, area, conductance) for the faces of the whole mesh, as its cells.
    template <class Visit>
    void for_each_face_of_whole(Visit&& visit) const {
        if constexpr (has_faces_v<Mesh>) {
            mesh_traits<Mesh>::for_each_face(*whole_, visit);
        } else {
            for (whole_index c = 0; c < mesh_traits<Mesh>::cell_count(*whole_); ++c) {
                mesh_traits<Mesh>::for_each_neighbour(*whole_, c, [&](whole_index n) {
                    if (c < n) visit(c, n, 1.0, 1.0);
                });
            }
        }
    }

    /// The part of a field of the whole mesh.
    template <class Value>
    std::vector<Value> take(const std::vector<Value>& whole_field) const {
        std::vector<Value> mine;
        for (const whole_index c : cells_) mine.push_back(whole_field[static_cast<std::size_t>(c)]);
        return mine;
    }
    /// And back.  Ranks write different elements, so threads may do it at the same time.
    template <class Value>
    void put(const std::vector<Value>& mine, std::vector<Value>& whole_field) const {
        for (std::size_t k = 0; k < cells_.size(); ++k) whole_field[static_cast<std::size_t>(cells_[k])] = mine[k];
    }

  private:
    const Mesh* whole_;
    std::vector<int> owners_;
    int rank_;
    std::vector<whole_index> cells_;
    std::vector<std::int32_t> local_;
};

namespace detail {

template <class Mesh>
struct partitioned_graph_traits {
    using index = std::int32_t;
    using scalar = mesh_scalar_t<Mesh>;
    using mesh_type = partitioned_mesh<Mesh>;

    static index cell_count(const mesh_type& m) { return m.cell_count(); }
    static scalar volume(const mesh_type& m, index c) { return mesh_traits<Mesh>::volume(m.whole(), m.cell(c)); }
    static std::int64_t global_index(const mesh_type& m, index c) { return global(m, m.cell(c)); }

    template <class Visit>
    static void for_each_face(const mesh_type& m, Visit&& visit) {
        m.for_each_face_of_whole([&](auto a, auto b, double area, double conductance) {
            if (m.local(a) >= 0 && m.local(b) >= 0) visit(m.local(a), m.local(b), area, conductance);
        });
    }
    template <class Visit>
    static void for_each_remote_face(const mesh_type& m, Visit&& visit) {
        m.for_each_face_of_whole([&](auto a, auto b, double area, double conductance) {
            if (m.local(a) >= 0 && m.local(b) < 0) visit(m.local(a), m.owner(b), global(m, b), area, conductance);
            if (m.local(b) >= 0 && m.local(a) < 0) visit(m.local(b), m.owner(a), global(m, a), area, conductance);
        });
    }

  private:
    template <class Cell>
    static std::int64_t global(const mesh_type& m, Cell c) {
        if constexpr (has_global_index_v<Mesh>) {
            return mesh_traits<Mesh>::global_index(m.whole(), c);
        } else {
            return static_cast<std::int64_t>(c);
        }
    }
};

template <class Mesh>
struct partitioned_located_traits : partitioned_graph_traits<Mesh> {
    using mesh_type = partitioned_mesh<Mesh>;
    using index = std::int32_t;

    static point centre(const mesh_type& m, index c) {
        const auto x = mesh_traits<Mesh>::centre(m.whole(), m.cell(c));
        return {x[0], x[1], x[2]};
    }
    static index find_cell(const mesh_type& m, const point& x) {
        return m.local(mesh_traits<Mesh>::find_cell(m.whole(), x));
    }
    static point extent(const mesh_type& m, index c) {
        if constexpr (has_extent_v<Mesh>) {
            const auto e = mesh_traits<Mesh>::extent(m.whole(), m.cell(c));
            return {e[0], e[1], e[2]};
        } else {
            const double side = std::cbrt(static_cast<double>(mesh_traits<Mesh>::volume(m.whole(), m.cell(c))));
            return {side, side, side};
        }
    }
};

}  // namespace detail

/// Owners of cells, of a kind chosen by the seed: each cell to any rank (islands of one cell), runs of cells, or a few
/// ranks that own all and others that own nothing.
inline std::vector<int> random_owners(std::size_t cells, int ranks, std::uint64_t seed) {
    seeded random(seed);
    std::vector<int> owners(cells);
    const auto any = [&](int count) { return static_cast<int>(random.index(static_cast<std::size_t>(count))); };
    const int kind = any(3);
    const int used = kind == 2 ? 1 + any(ranks) : ranks;
    int run = 0;
    int owner = any(used);
    for (int& o : owners) {
        if (kind == 0 || run-- == 0) {
            owner = any(used);
            run = any(50);
        }
        o = owner;
    }
    return owners;
}

enum class graph_kind { lattice, graded, chain, tree, star, islands, polyhedral, comb };
inline constexpr int graph_kind_count = 8;

/// A connected (but for islands) random graph of about so many cells; volumes are logarithmically uniform over a ratio.
inline listed_graph random_graph(graph_kind kind, std::size_t cells, double volume_ratio, std::uint64_t seed) {
    seeded random(seed);
    listed_graph graph;
    const auto with_cells = [&](std::size_t n) {
        for (std::size_t c = 0; c < n; ++c) {
            graph.volumes.push_back(volume_ratio > 1 ? random.log_uniform(1, volume_ratio) : 1.0);
        }
    };
    const auto lattice_links = [&](std::array<std::size_t, 3> n) {
        const std::array<std::size_t, 3> stride{1, n[0], n[0] * n[1]};
        for (std::size_t k = 0; k < n[2]; ++k) {
            for (std::size_t j = 0; j < n[1]; ++j) {
                for (std::size_t i = 0; i < n[0]; ++i) {
                    const std::array<std::size_t, 3> at{i, j, k};
                    const std::size_t c = i + stride[1] * j + stride[2] * k;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        if (at[axis] + 1 < n[axis]) graph.link(c, c + stride[axis]);
                    }
                }
            }
        }
    };
    const auto box = [&] {
        const auto side = std::max<std::size_t>(1, static_cast<std::size_t>(std::cbrt(static_cast<double>(cells))));
        return std::array<std::size_t, 3>{side, side, std::max<std::size_t>(1, cells / (side * side))};
    };
    switch (kind) {
        case graph_kind::lattice:
            graph.volumes.assign(box()[0] * box()[1] * box()[2], 1.0);
            lattice_links(box());
            break;
        case graph_kind::graded:
            with_cells(box()[0] * box()[1] * box()[2]);
            lattice_links(box());
            break;
        case graph_kind::chain:
            with_cells(cells);
            for (std::size_t c = 1; c < cells; ++c) graph.link(c - 1, c);
            break;
        case graph_kind::tree:
            with_cells(cells);
            for (std::size_t c = 1; c < cells; ++c) graph.link(random.index(c), c);
            break;
        case graph_kind::star:
            with_cells(cells);
            for (std::size_t c = 1; c < cells; ++c) graph.link(0, c);
            break;
        case graph_kind::islands:  // chains with loops, of 1 to 40 cells
            with_cells(cells);
            for (std::size_t first = 0; first < cells;) {
                const std::size_t last = std::min(cells, first + 1 + random.index(40));
                for (std::size_t c = first + 1; c < last; ++c) {
                    graph.link(c - 1, c);
                    if (random.uniform(0, 1) < 0.5) graph.link(first + random.index(c - first), c);
                }
                first = last;
            }
            break;
        case graph_kind::polyhedral: {  // a lattice with random diagonals: 6 to 20 neighbours, like polyhedra
            with_cells(box()[0] * box()[1] * box()[2]);
            lattice_links(box());
            const std::size_t n = graph.volumes.size();
            for (std::size_t c = 0; c < n; ++c) {
                for (const std::size_t reach : {box()[0] + 1, box()[0] * box()[1] + 1, box()[0] * box()[1] + box()[0]}) {
                    if (c + reach < n && random.uniform(0, 1) < 0.7) graph.link(c, c + reach);
                }
            }
            break;
        }
        case graph_kind::comb:  // a chain with a tooth on every cell: many dead ends
            with_cells(2 * ((cells + 1) / 2));
            for (std::size_t c = 0; c + 2 < graph.volumes.size(); c += 2) graph.link(c, c + 2);
            for (std::size_t c = 0; c + 1 < graph.volumes.size(); c += 2) graph.link(c, c + 1);
            break;
    }
    return graph;
}

}  // namespace hearth::test

template <>
struct hearth::mesh_traits<hearth::test::listed_graph> {
    using index = std::int32_t;
    using scalar = double;
    using mesh_type = test::listed_graph;
    static index cell_count(const mesh_type& m) { return m.cell_count(); }
    static scalar volume(const mesh_type& m, index c) { return m.volumes[static_cast<std::size_t>(c)]; }
    template <class Visit>
    static void for_each_face(const mesh_type& m, Visit&& visit) {
        for (const auto& f : m.faces) visit(f.a, f.b, 1.0, f.conductance);
    }
};

template <class Mesh>
struct hearth::mesh_traits<hearth::test::partitioned_mesh<Mesh>>
    : std::conditional_t<hearth::is_located_mesh_v<Mesh>, hearth::test::detail::partitioned_located_traits<Mesh>,
                         hearth::test::detail::partitioned_graph_traits<Mesh>> {};
