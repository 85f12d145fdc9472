// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <hearth/core/graph_builder.hpp>
#include <hearth/core/halo.hpp>
#include <hearth/core/lattice.hpp>
#include <hearth/core/mesh_traits.hpp>

namespace hearth {

/// What the algorithms run on: a compact copy of the host's mesh as a graph of cells, built once per mesh revision.
///
/// Holds the owned cells, one layer of ghosts, global indices, volumes [m^3], and conductances [m] where the host has
/// faces.  Neighbours of a cell stand in the order of their global indices, so that a sum over them does not depend on
/// how the host stores its mesh nor on the number of ranks.  About 60 bytes a cell for hexahedra, 8 more where the host
/// has global indices of its own.  One layer of ghosts is enough: every algorithm exchanges once per sweep.
///
/// Conductances are stored as float, the same on both sides of a face: fluxes cancel exactly, and a relative error of
/// 6e-8 in a smoothing width is far below what any use of it can see.
///
/// Keeps a pointer to the mesh to ask for its revision: the mesh must outlive the graph.
/// Errors: bad_value for volumes or conductances that are not finite and positive, neighbours out of range or not
/// mutual, duplicate global indices, ranks that disagree on a face.  Thrown on every rank.
template <class Communicator = serial_communicator>
class cell_graph {
  public:
    using index = std::int32_t;
    using communicator_type = Communicator;

    template <class Mesh>
    explicit cell_graph(const Mesh& mesh, Communicator communicator = {})
        : mesh_(&mesh), revision_(&host_revision<Mesh>), built_at_(host_revision<Mesh>(&mesh)) {
        require_cell_graph<Mesh>();
        if constexpr (is_cell_graph_v<Mesh>) {
            detail::graph_builder<Mesh, Communicator> build(mesh, communicator);
            owned_ = build.owned;
            offsets_ = std::move(build.offsets);
            neighbours_ = std::move(build.neighbours);
            conductances_ = std::move(build.conductances);
            volumes_ = std::move(build.volumes);
            global_ = std::move(build.global);
            ghost_owners_ = std::move(build.ghost_owners);
            halo_ = hearth::halo<Communicator>(communicator, owned_, std::move(build.export_cells),
                                               std::move(build.exports), std::move(build.imports));
            if constexpr (has_lattice_v<Mesh> && !Communicator::is_distributed) {
                lattice_ = mesh_traits<Mesh>::lattice(mesh);
            }
        }
    }

    /// Owned cells; a field of a host holds at least these.
    index cell_count() const { return owned_; }
    /// Owned cells and ghosts; a working field of an algorithm holds these.
    index total_count() const { return static_cast<index>(volumes_.size()); }

    /// Volume of an owned or ghost cell [m^3].
    double volume(index cell) const { return volumes_[static_cast<std::size_t>(cell)]; }
    const double* volumes() const { return volumes_.data(); }

    /// Persistent index of an owned or ghost cell, unique over all ranks.
    std::int64_t global_index(index cell) const {
        return global_.empty() ? cell : global_[static_cast<std::size_t>(cell)];
    }

    /// Rank that owns a ghost.
    int owner(index ghost) const { return ghost_owners_[static_cast<std::size_t>(ghost - owned_)]; }
    bool is_owned(index cell) const { return cell < owned_; }

    /// Neighbours of an owned cell: positions [row_begin, row_end) of neighbours() and conductances().
    std::uint32_t row_begin(index cell) const { return offsets_[static_cast<std::size_t>(cell)]; }
    std::uint32_t row_end(index cell) const { return offsets_[static_cast<std::size_t>(cell) + 1]; }
    const std::uint32_t* row_bounds() const { return offsets_.data(); }
    const index* neighbours() const { return neighbours_.data(); }
    /// Face conductances [m], area over distance of the centres; empty where the host has no faces.
    const float* conductances() const { return conductances_.data(); }
    bool has_conductances() const { return !conductances_.empty() || neighbours_.empty(); }

    template <class Visit>
    void for_each_neighbour(index cell, Visit&& visit) const {
        for (std::uint32_t k = row_begin(cell); k < row_end(cell); ++k) visit(neighbours_[k]);
    }

    /// Shape of the mesh where the host says that it is a lattice, on one rank.
    const std::optional<lattice_shape>& lattice() const { return lattice_; }

    const hearth::halo<Communicator>& halo() const { return halo_; }
    const Communicator& communicator() const { return halo_.communicator(); }

    /// Throws stale_graph on every rank where the host changed its mesh since the graph was built.
    void require_current() const {
        const std::uint64_t now = revision_(mesh_);
        if (communicator().any(now != built_at_)) throw stale_graph(built_at_, now);
    }

    /// What the graph holds [bytes].
    std::size_t memory() const {
        return offsets_.capacity() * sizeof(offsets_[0]) + neighbours_.capacity() * sizeof(neighbours_[0]) +
               conductances_.capacity() * sizeof(conductances_[0]) + volumes_.capacity() * sizeof(volumes_[0]) +
               global_.capacity() * sizeof(global_[0]) + ghost_owners_.capacity() * sizeof(ghost_owners_[0]) +
               halo_.export_cells().capacity() * sizeof(index);
    }

  private:
    template <class Mesh>
    static std::uint64_t host_revision(const void* mesh) {
        if constexpr (has_revision_v<Mesh>) {
            return static_cast<std::uint64_t>(mesh_traits<Mesh>::revision(*static_cast<const Mesh*>(mesh)));
        } else if constexpr (is_cell_graph_v<Mesh>) {
            // A host without revisions: a changed number of cells is all that can be seen.
            return static_cast<std::uint64_t>(mesh_traits<Mesh>::cell_count(*static_cast<const Mesh*>(mesh)));
        } else {
            return 0;
        }
    }

    const void* mesh_;
    std::uint64_t (*revision_)(const void*);
    std::uint64_t built_at_;
    index owned_ = 0;
    std::vector<std::uint32_t> offsets_;
    std::vector<index> neighbours_;
    std::vector<float> conductances_;
    std::vector<double> volumes_;
    std::vector<std::int64_t> global_;  // empty: the local index is the global one
    std::vector<int> ghost_owners_;
    hearth::halo<Communicator> halo_;
    std::optional<lattice_shape> lattice_;
};

template <class Mesh>
cell_graph(const Mesh&) -> cell_graph<serial_communicator>;
template <class Mesh, class Communicator>
cell_graph(const Mesh&, Communicator) -> cell_graph<Communicator>;

}  // namespace hearth
