// SPDX-License-Identifier: MIT
// Reads an OpenFOAM case and a list of particles, and writes the solid fraction that each method gives: OpenFOAM's own
// (the cell that holds the centre), the paper's Volume Fraction Smoother, and hearth's filtered fraction.
//
//     hearthVoidFraction -particles bed.csv            (a line a particle: x y z radius, metres)
//     mpirun -np 2 hearthVoidFraction -particles bed.csv -parallel
//
// With -compare it also reads the fields that an earlier run wrote, and fails where the solid in a cell differs from
// theirs by more than 1e-13 of the cell's volume.
//
// Linked with OpenFOAM, so the program is under the GPL; this file is not.
#include "fvCFD.H"

#include <hearth/adapt/openfoam.hpp>
#include <hearth/mpi/communicator.hpp>
#include <hearth/voidage/filtered_fraction.hpp>
#include <hearth/voidage/vfs.hpp>

#include "read_particles.hpp"

#include <exception>

namespace {

volScalarField make_field(const Foam::word& name, const fvMesh& mesh) {
    return volScalarField(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::AUTO_WRITE), mesh,
                          dimensionedScalar("zero", dimless, 0), "zeroGradient");
}

/// What each method costs and keeps.
void report(const volScalarField& field) {
    Info << field.name() << ": volume " << gSum(scalarField(field.primitiveField() * field.mesh().V()))
         << " m3, largest fraction " << gMax(field) << nl;
}

/// Largest difference from the field of an earlier run.
scalar difference(const volScalarField& field) {
    const volScalarField before(IOobject(field.name(), field.instance(), field.db(), IOobject::MUST_READ),
                                field.mesh());
    return gMax(scalarField(mag(field.primitiveField() - before.primitiveField())));
}

/// Returns false where a comparison was asked for and failed.
template <class Mesh, class Communicator>
bool write_fractions(const fvMesh& mesh, const Mesh& cells, const Communicator& ranks, const particle_list& particles,
                     bool compare) {
    const auto cloud = particles.view();
    const hearth::cell_graph<Communicator> graph(cells, ranks);
    const hearth::cell_locator<Mesh, Communicator> locator(cells, graph);

    volScalarField centre = make_field("solidFraction.centre", mesh);
    hearth::deposit_solid_fraction(locator, cloud, centre, hearth::deposit::centre{});

    volScalarField smoothed = make_field("solidFraction.vfs", mesh);
    smoothed = centre;
    hearth::volume_fraction_smoother smoother(graph, hearth::vfs_settings{0.9});
    const auto vfs = smoother.smooth(smoothed);

    volScalarField filtered = make_field("solidFraction", mesh);
    hearth::transfer_operator<Mesh, Communicator> transfer(locator);
    const auto kernel = transfer.distribute(cloud, filtered);

    scalar largest = 0;
    for (volScalarField* field : {&centre, &smoothed, &filtered}) {
        field->correctBoundaryConditions();
        report(*field);
        if (compare) largest = max(largest, difference(*field));
        field->write();
    }
    Info << "smoother: " << vfs.sweeps << " sweeps, " << Foam::label(vfs.smoothed_cells)
         << " cells smoothed; kernel: width " << kernel.width << " m, " << kernel.terms << " terms, "
         << kernel.capped_volume << " m3 capped" << endl;
    if (compare) Info << "largest difference " << largest << " of a cell's volume" << endl;
    return largest <= 1e-13;
}

}  // namespace

int main(int argc, char* argv[]) {
    argList::addOption("particles", "file", "x y z radius of each particle [m]");
    argList::addBoolOption("compare", "with the fields that an earlier run wrote");
#include "setRootCase.H"
#include "createTime.H"
#include "createMesh.H"
    const particle_list particles = read_particles(args.opt<fileName>("particles"));
    const bool compare = args.found("compare");
    bool same = false;
    try {
        if (Pstream::parRun()) {
            const hearth::openfoam::distributed_mesh cells(mesh);
            same = write_fractions(mesh, cells, hearth::mpi::communicator{}, particles, compare);
        } else {
            same = write_fractions(mesh, mesh, hearth::serial_communicator{}, particles, compare);
        }
    } catch (const std::exception& error) {  // on all ranks alike
        FatalErrorInFunction << error.what() << Foam::exit(FatalError);
    }
    // OpenFOAM's argList ends the program with 0, whatever main returns.
    if (!same) FatalErrorInFunction << "the fields differ" << Foam::exit(FatalError);
    return 0;
}
