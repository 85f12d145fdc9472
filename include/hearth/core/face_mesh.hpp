// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <hearth/core/mesh_traits.hpp>

namespace hearth {

/// Ready-made mesh view: face-addressed arrays that the host owns, as finite-volume codes hold them.
///
///     face_mesh mesh{cell_count, face_count, owner, neighbour, areas, conductances, volumes, centres};
///
/// Internal faces only: face f lies between the cells owner[f] and neighbour[f]; areas [m^2]; conductances [m], area
/// over distance of the centres along the normal; volumes [m^3]; centres [m] as x, y, z of each cell in turn, or
/// nullptr where nothing is deposited.
template <class Index = int, class Scalar = double>
struct face_mesh {
    Index cell_count;
    Index face_count;
    const Index* owner;
    const Index* neighbour;
    const Scalar* areas;
    const Scalar* conductances;
    const Scalar* volumes;
    const Scalar* centres = nullptr;
};

template <class Index, class Scalar>
face_mesh(Index, Index, const Index*, const Index*, const Scalar*, const Scalar*, const Scalar*)
    -> face_mesh<Index, Scalar>;
template <class Index, class Scalar>
face_mesh(Index, Index, const Index*, const Index*, const Scalar*, const Scalar*, const Scalar*, const Scalar*)
    -> face_mesh<Index, Scalar>;

template <class Index, class Scalar>
struct mesh_traits<face_mesh<Index, Scalar>> {
    using index = Index;
    using scalar = Scalar;
    using mesh_type = face_mesh<Index, Scalar>;

    static index cell_count(const mesh_type& mesh) { return mesh.cell_count; }
    static scalar volume(const mesh_type& mesh, index cell) { return mesh.volumes[cell]; }
    static point centre(const mesh_type& mesh, index cell) {
        const Scalar* x = mesh.centres + 3 * static_cast<std::ptrdiff_t>(cell);
        return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
    }

    template <class Visit>
    static void for_each_face(const mesh_type& mesh, Visit&& visit) {
        for (Index f = 0; f < mesh.face_count; ++f) {
            visit(mesh.owner[f], mesh.neighbour[f], static_cast<double>(mesh.areas[f]),
                  static_cast<double>(mesh.conductances[f]));
        }
    }
};

}  // namespace hearth
