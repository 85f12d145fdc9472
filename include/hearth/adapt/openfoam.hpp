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

    static index cell_count(const Foam::fvMesh& mesh) { return mesh.nCells(); }
    static scalar volume(const Foam::fvMesh& mesh, index cell) { return mesh.V()[cell]; }
    static const Foam::vector& centre(const Foam::fvMesh& mesh, index cell) { return mesh.C()[cell]; }
    static Foam::vector extent(const Foam::fvMesh& mesh, index cell) {
        return Foam::boundBox(mesh.cells()[cell].points(mesh.faces(), mesh.points()), false).span();
    }
    static index find_cell(const Foam::fvMesh& mesh, const point& x) { return mesh.findCell({x[0], x[1], x[2]}); }

    /// Of patches that are coupled along an axis; all ranks call it.
    static Foam::vector period(const Foam::fvMesh& mesh) {
        Foam::vector length(Foam::Zero);
        for (const Foam::polyPatch& patch : mesh.boundaryMesh()) {
            const auto* coupled = Foam::isA<Foam::coupledPolyPatch>(patch);
            if (coupled == nullptr || !coupled->parallel()) continue;
            for (const Foam::vector& apart : coupled->separation()) length = Foam::max(length, Foam::cmptMag(apart));
        }
        Foam::reduce(length, Foam::maxOp<Foam::vector>());
        for (Foam::scalar& l : length) l = l > 1e-9 * Foam::mag(length) ? l : 0;  // round-off of face centres
        return length;
    }

    template <class Visit>
    static void for_each_face(const Foam::fvMesh& mesh, Visit&& visit) {
        const auto& areas = mesh.magSf();
        const auto& inverse_distances = mesh.nonOrthDeltaCoeffs();
        for (index f = 0; f < mesh.nInternalFaces(); ++f) {
            visit(mesh.owner()[f], mesh.neighbour()[f], areas[f], areas[f] * inverse_distances[f]);
        }
        for (index p = 0; p < mesh.boundaryMesh().size(); ++p) {  // both sides of a cyclic patch lie on this rank
            const auto* patch = Foam::isA<Foam::cyclicPolyPatch>(mesh.boundaryMesh()[p]);
            if (patch == nullptr || !patch->owner()) continue;
            for (index f = 0; f < patch->size(); ++f) {
                const scalar area = areas.boundaryField()[p][f];
                visit(patch->faceCells()[f], patch->neighbPatch().faceCells()[f], area,
                      area * inverse_distances.boundaryField()[p][f]);
            }
        }
    }

    static std::uint64_t revision(const Foam::fvMesh& mesh) {
        const auto moved = mesh.changing() ? mesh.time().timeIndex() : 0;
        return static_cast<std::uint64_t>(mesh.nCells()) ^ static_cast<std::uint64_t>(mesh.nFaces()) << 20 ^
               static_cast<std::uint64_t>(moved) << 40;
    }
};

namespace hearth::openfoam {

/// A mesh that decomposePar spread over ranks; cells keep the numbers of the undecomposed mesh where it wrote them
/// (cellProcAddressing), so that results do not depend on the decomposition.  Make a new one after the mesh changes.
/// OpenFOAM's ranks are those of MPI_COMM_WORLD.
class distributed_mesh {
  public:
    explicit distributed_mesh(const Foam::fvMesh& mesh) : mesh_(mesh), ids_(mesh.nCells()) {
        const Foam::labelIOList given(Foam::IOobject("cellProcAddressing", mesh.facesInstance(), Foam::polyMesh::meshSubDir,
                                                     mesh, Foam::IOobject::READ_IF_PRESENT, Foam::IOobject::NO_WRITE, false));
        const Foam::globalIndex counted(mesh.nCells());
        forAll(ids_, c) ids_[c] = given.size() == ids_.size() ? given[c] : counted.toGlobal(c);
        Foam::syncTools::swapBoundaryCellList(mesh, ids_, beyond_);
    }

    const Foam::fvMesh& mesh() const { return mesh_; }
    const Foam::labelList& ids() const { return ids_; }
    /// Number of the cell beyond each boundary face, where that face is between ranks.
    const Foam::labelList& beyond() const { return beyond_; }

  private:
    const Foam::fvMesh& mesh_;
    Foam::labelList ids_, beyond_;
};

}  // namespace hearth::openfoam

template <>
struct hearth::mesh_traits<hearth::openfoam::distributed_mesh> {
    using local = mesh_traits<Foam::fvMesh>;
    using index = Foam::label;
    using scalar = Foam::scalar;
    using mesh_type = openfoam::distributed_mesh;

    static index cell_count(const mesh_type& m) { return local::cell_count(m.mesh()); }
    static scalar volume(const mesh_type& m, index cell) { return local::volume(m.mesh(), cell); }
    static const Foam::vector& centre(const mesh_type& m, index cell) { return local::centre(m.mesh(), cell); }
    static Foam::vector extent(const mesh_type& m, index cell) { return local::extent(m.mesh(), cell); }
    static index find_cell(const mesh_type& m, const point& x) { return local::find_cell(m.mesh(), x); }
    static Foam::vector period(const mesh_type& m) { return local::period(m.mesh()); }
    static std::int64_t global_index(const mesh_type& m, index cell) { return m.ids()[cell]; }
    static std::uint64_t revision(const mesh_type& m) { return local::revision(m.mesh()); }
    template <class Visit>
    static void for_each_face(const mesh_type& m, Visit&& visit) { local::for_each_face(m.mesh(), visit); }

    template <class Visit>
    static void for_each_remote_face(const mesh_type& m, Visit&& visit) {
        const Foam::fvMesh& mesh = m.mesh();
        for (index p = 0; p < mesh.boundaryMesh().size(); ++p) {
            const auto* patch = Foam::isA<Foam::processorPolyPatch>(mesh.boundaryMesh()[p]);
            if (patch == nullptr) continue;
            for (index f = 0; f < patch->size(); ++f) {
                const scalar area = mesh.magSf().boundaryField()[p][f];
                visit(patch->faceCells()[f], patch->neighbProcNo(),
                      std::int64_t{m.beyond()[patch->start() + f - mesh.nInternalFaces()]}, area,
                      area * mesh.nonOrthDeltaCoeffs().boundaryField()[p][f]);
            }
        }
    }
};
