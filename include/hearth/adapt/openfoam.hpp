// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

#include <fvMesh.H>
#include <cyclicPolyPatch.H>
#include <globalIndex.H>
#include <labelIOList.H>
#include <processorPolyPatch.H>
#include <surfaceFields.H>
#include <syncTools.H>

#include <hearth/core/mesh_traits.hpp>

/// Foam::fvMesh, and what is derived from it, as located and faced mesh.  Fields are already fields of hearth: a
/// volScalarField is indexable.  A program that links OpenFOAM is under OpenFOAM's licence, the GPL.
template <class Mesh>
struct hearth::mesh_traits<Mesh, std::enable_if_t<std::is_base_of_v<Foam::fvMesh, Mesh>>> {
    using index = Foam::label;
    using scalar = Foam::scalar;
    using fv_mesh = Foam::fvMesh;

    static index cell_count(const fv_mesh& mesh) { return mesh.nCells(); }
    static scalar volume(const fv_mesh& mesh, index cell) { return mesh.V()[cell]; }
    static const Foam::vector& centre(const fv_mesh& mesh, index cell) { return mesh.C()[cell]; }
    static Foam::vector extent(const fv_mesh& mesh, index cell) {
        return Foam::boundBox(mesh.cells()[cell].points(mesh.faces(), mesh.points()), false).span();
    }
    static index find_cell(const fv_mesh& mesh, const point& x) { return mesh.findCell({x[0], x[1], x[2]}); }

    /// Of patches that are coupled along an axis; all ranks call it.
    static Foam::vector period(const fv_mesh& mesh) {
        Foam::vector length(Foam::Zero);
        for (const Foam::polyPatch& patch : mesh.boundaryMesh()) {
            if (const auto* pair = Foam::isA<Foam::coupledPolyPatch>(patch); pair != nullptr && pair->parallel())
                for (const Foam::vector& apart : pair->separation()) length = Foam::max(length, Foam::cmptMag(apart));
        }
        Foam::reduce(length, Foam::maxOp<Foam::vector>());
        for (Foam::scalar& l : length) l = l > 1e-9 * Foam::mag(length) ? l : 0;  // round-off of face centres
        return length;
    }

    template <class Visit>
    static void for_each_face(const fv_mesh& mesh, Visit&& visit) {
        const Foam::scalarField &areas = mesh.magSf(), &inverse_distances = mesh.nonOrthDeltaCoeffs();
        for (index f = 0; f < mesh.nInternalFaces(); ++f)
            visit(mesh.owner()[f], mesh.neighbour()[f], areas[f], areas[f] * inverse_distances[f]);
        for_each_patch_face<Foam::cyclicPolyPatch>(mesh, [&](const auto& patch, index f, scalar area, scalar conductance) {
            if (patch.owner())  // both sides of a cyclic patch lie on this rank
                visit(patch.faceCells()[f], patch.neighbPatch().faceCells()[f], area, conductance);
        });
    }

    static std::uint64_t revision(const fv_mesh& mesh) {
        const auto bits = [](Foam::label n, int shift) { return static_cast<std::uint64_t>(n) << shift; };
        return bits(mesh.nCells(), 0) ^ bits(mesh.nFaces(), 20) ^ bits(mesh.changing() ? mesh.time().timeIndex() : 0, 40);
    }

  protected:
    template <class Patch, class Visit>
    static void for_each_patch_face(const fv_mesh& mesh, Visit&& visit) {
        forAll(mesh.boundaryMesh(), p) {
            const auto* patch = Foam::isA<Patch>(mesh.boundaryMesh()[p]);
            if (patch == nullptr) continue;
            const auto &areas = mesh.magSf().boundaryField()[p], &inverse = mesh.nonOrthDeltaCoeffs().boundaryField()[p];
            forAll(*patch, f) visit(*patch, f, areas[f], areas[f] * inverse[f]);
        }
    }
};

namespace hearth::openfoam {

/// A mesh that decomposePar spread over ranks; cells keep the numbers of the undecomposed mesh where it wrote them
/// (cellProcAddressing), so that results do not depend on the decomposition.  Make a new one after the mesh changes.
/// OpenFOAM's ranks are those of MPI_COMM_WORLD.
struct distributed_mesh {
    const Foam::fvMesh& mesh;
    Foam::labelList ids;
    Foam::labelList beyond;  ///< number of the cell beyond each boundary face, where that face is between ranks

    explicit distributed_mesh(const Foam::fvMesh& local) : mesh(local), ids(local.nCells()) {
        const Foam::labelIOList given(Foam::IOobject("cellProcAddressing", mesh.facesInstance(), Foam::polyMesh::meshSubDir,
                                                     mesh, Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::NO_WRITE, false));
        const Foam::globalIndex counted(mesh.nCells());
        forAll(ids, c) ids[c] = given.size() == ids.size() ? given[c] : counted.toGlobal(c);
        Foam::syncTools::swapBoundaryCellList(mesh, ids, beyond);
    }
    operator const Foam::fvMesh&() const { return mesh; }
};

}  // namespace hearth::openfoam

template <>
struct hearth::mesh_traits<hearth::openfoam::distributed_mesh> : hearth::mesh_traits<Foam::fvMesh> {
    using mesh_type = openfoam::distributed_mesh;
    static std::int64_t global_index(const mesh_type& m, index cell) { return m.ids[cell]; }

    template <class Visit>
    static void for_each_remote_face(const mesh_type& m, Visit&& visit) {
        for_each_patch_face<Foam::processorPolyPatch>(m, [&](const auto& patch, index f, scalar area, scalar conductance) {
            const index boundary_face = patch.start() + f - m.mesh.nInternalFaces();
            visit(patch.faceCells()[f], patch.neighbProcNo(), std::int64_t{m.beyond[boundary_face]}, area, conductance);
        });
    }
};
