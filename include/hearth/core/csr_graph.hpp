// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/mesh_traits.hpp>

namespace hearth {

/// Ready-made mesh view: a graph of cells in three plain arrays that the host owns.
///
///     csr_graph mesh{cell_count, offsets, neighbours, volumes};
///
/// offsets has cell_count + 1 entries; the neighbours of a cell are neighbours[offsets[cell]] up to, without,
/// neighbours[offsets[cell + 1]], each pair listed from both sides; volumes [m^3].
template <class Index = int, class Offset = Index, class Scalar = double>
struct csr_graph {
    Index cell_count;
    const Offset* offsets;
    const Index* neighbours;
    const Scalar* volumes;
};

template <class Index, class Offset, class Scalar>
csr_graph(Index, const Offset*, const Index*, const Scalar*) -> csr_graph<Index, Offset, Scalar>;

template <class Index, class Offset, class Scalar>
struct mesh_traits<csr_graph<Index, Offset, Scalar>> {
    using index = Index;
    using scalar = Scalar;
    using mesh_type = csr_graph<Index, Offset, Scalar>;

    static index cell_count(const mesh_type& mesh) { return mesh.cell_count; }
    static scalar volume(const mesh_type& mesh, index cell) { return mesh.volumes[cell]; }

    template <class Visit>
    static void for_each_neighbour(const mesh_type& mesh, index cell, Visit&& visit) {
        for (Offset k = mesh.offsets[cell]; k < mesh.offsets[cell + 1]; ++k) visit(mesh.neighbours[k]);
    }
};

}  // namespace hearth
