// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <hearth/gas/mesh.hpp>
#include <hearth/gas/partition.hpp>

namespace hearth::furnace {

/// Takes arrays of the gas from the shares of so many ranks to the share of one among another number of ranks.
/// Throws bad_scene where the parts do not fit the mesh.
class redistribution {
  public:
    /// A part of each of the ranks that there were, in order of rank.
    using parts = std::vector<std::vector<double>>;

    redistribution(gas::mesh whole, int before, int now, int rank);

    /// Some numbers a cell, ghosts included.
    std::vector<double> of_cells(const parts& saved) const;
    /// A number a face, positive from the owner to the neighbour.
    std::vector<double> of_faces(const parts& saved) const;
    /// A number a face of the boundary.
    std::vector<double> of_boundary(const parts& saved) const;

  private:
    struct share {
        std::size_t own = 0;                    ///< cells, the others are ghosts
        std::vector<std::size_t> cells;         ///< in the whole mesh
        gas::array<gas::shared_face> faces;
        std::size_t internal = 0;               ///< faces, the others are the boundary
    };
    share share_of(const gas::array<int>& rank_of_cell, int rank) const;
    std::vector<double> of_faces_from(const parts& saved, bool boundary) const;

    gas::mesh whole_;
    std::vector<share> before_;
    share now_;
};

}  // namespace hearth::furnace
