// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/gas/array.hpp>
#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// Cuts a mesh into parts of equal size: recursive bisection of the cell centres across the longest side of their
/// bounding box (Berger & Bokhari 1987, doi:10.1109/TC.1987.1676942), ties by cell number.  Returns the part of each
/// cell.  Sizes differ by one cell at most; the result depends on the mesh alone.
/// Throws std::invalid_argument for parts < 1 or more parts than cells.
///
///     const mesh whole(make(shaft));                                   // the same on every rank
///     const mesh mine(whole, partition(whole, ranks), rank);           // whole may go from here on
///
/// Every rank builds the whole mesh for a moment: 0.38 kB per cell of it (hexahedra), where a solver needs 1.2 kB
/// per cell of the share.
array<int> partition(const mesh& whole, int parts);

/// A face of a share: its number in the whole mesh, and whether owner and neighbour have changed places, because a face's
/// owner is a cell of the rank.
struct shared_face {
    int face;
    bool turned;
};
/// The faces of a rank's share, in their order there.
array<shared_face> faces_of_share(const mesh& whole, const array<int>& rank_of_cell, int rank);

}  // namespace hearth::gas
