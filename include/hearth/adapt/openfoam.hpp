// SPDX-License-Identifier: MIT
#pragma once

#include <fvMesh.H>
#include <cyclicPolyPatch.H>
#include <globalIndex.H>
#include <labelIOList.H>
#include <processorPolyPatch.H>
#include <surfaceFields.H>
#include <syncTools.H>

#include <hearth/core/mesh_traits.hpp>

namespace hearth::openfoam {

/// A mesh that decomposePar spread over ranks; cells keep the numbers of the undecomposed mesh where it wrote them
/// (cellProcAddressing), so that results do not depend on the decomposition.  Make a new one after the mesh changes.
/// OpenFOAM's ranks are those of MPI_COMM_WORLD.
struct distributed_mesh {
    const Foam::fvMesh& mesh;
    Foam::labelIOList ids{{"cellProcAddressing", mesh.facesInstance(), "polyMesh", mesh, mesh.READ_IF_PRESENT}};

    explicit distributed_mesh(const Foam::fvMesh& local) : mesh(local) {
        const Foam::globalIndex counted(mesh.nCells());
        if (ids.size() != mesh.nCells()) ids = Foam::identity(mesh.nCells(), counted.localStart());
    }
    operator const Foam::fvMesh&() const { return mesh; }
};

/// visit(patch, number of the face, area, conductance) for each face of the patches of one type.
template <class Patch, class Visit>
void for_each_patch_face(const Foam::fvMesh& mesh, Visit&& visit) {
    const auto& inverse = mesh.nonOrthDeltaCoeffs().boundaryField();
    for (const Foam::fvPatch& side : mesh.boundary())
        if (const auto* patch = Foam::isA<Patch>(side.patch()))
            forAll(*patch, f) visit(*patch, f, side.magSf()[f], side.magSf()[f] * inverse[side.index()][f]);
}

}  // namespace hearth::openfoam

/// Foam::fvMesh, and what is derived from it, as located and faced mesh.  Fields are already fields of hearth: a
/// volScalarField is indexable.  A program that links OpenFOAM is under OpenFOAM's licence, the GPL.
template <class Mesh>
struct hearth::mesh_traits<Mesh, std::enable_if_t<std::is_base_of_v<Foam::fvMesh, Mesh>>> {
    using index = Foam::label;
    using scalar = Foam::scalar;

    static index cell_count(const Mesh& mesh) { return mesh.nCells(); }
    static scalar volume(const Mesh& mesh, index cell) { return mesh.V()[cell]; }
    static const Foam::vector& centre(const Mesh& mesh, index cell) { return mesh.C()[cell]; }
    static Foam::vector extent(const Mesh& mesh, index cell) {
        return Foam::boundBox(mesh.cells()[cell].points(mesh.faces(), mesh.points()), false).span();
    }
    static index find_cell(const Mesh& mesh, const point& x) { return mesh.findCell({x[0], x[1], x[2]}); }

    /// Of the times at which points and faces changed last: two moves within a time step count as one.
    static auto revision(const Mesh& m) { return std::hash<std::string>()(m.pointsInstance() + m.facesInstance()); }

    /// Of patches that are coupled along an axis; all ranks call it.
    static Foam::vector period(const Mesh& mesh) {
        Foam::vector length(Foam::Zero);
        for (const Foam::polyPatch& patch : mesh.boundaryMesh())
            if (const auto* pair = Foam::isA<Foam::coupledPolyPatch>(patch); pair != nullptr && pair->parallel())
                for (const Foam::vector& apart : pair->separation()) length = Foam::max(length, Foam::cmptMag(apart));
        for (Foam::scalar& l : length) l = l > 1e-9 * Foam::mag(length) ? l : 0;  // round-off of face centres
        return Foam::returnReduce(length, Foam::maxOp<Foam::vector>());
    }

    template <class Visit>
    static void for_each_face(const Mesh& mesh, Visit&& visit) {
        const Foam::scalarField &areas = mesh.magSf(), &inverse = mesh.nonOrthDeltaCoeffs();
        forAll(mesh.neighbour(), f) visit(mesh.owner()[f], mesh.neighbour()[f], areas[f], areas[f] * inverse[f]);
        // Both sides of a cyclic patch lie on one rank.
        openfoam::for_each_patch_face<Foam::cyclicPolyPatch>(mesh, [&](auto& patch, index f, auto... numbers) {
            if (patch.owner()) visit(patch.faceCells()[f], patch.neighbPatch().faceCells()[f], numbers...);
        });
    }
};

template <>
struct hearth::mesh_traits<hearth::openfoam::distributed_mesh> : hearth::mesh_traits<Foam::fvMesh> {
    static std::int64_t global_index(const openfoam::distributed_mesh& m, index cell) { return m.ids[cell]; }

    template <class Visit>
    static void for_each_remote_face(const openfoam::distributed_mesh& m, Visit&& visit) {
        Foam::labelList beyond;  // id of the cell beyond each boundary face
        Foam::syncTools::swapBoundaryCellList(m.mesh, m.ids, beyond);
        openfoam::for_each_patch_face<Foam::processorPolyPatch>(m, [&](auto& p, index f, auto... numbers) {
            visit(p.faceCells()[f], p.neighbProcNo(), beyond[p.start() + f - m.mesh.nInternalFaces()], numbers...);
        });
    }
};
