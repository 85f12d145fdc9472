// SPDX-License-Identifier: MIT
// OpenFOAM's mesh under hearth's conformance suite, in the case where it is started; serial or -parallel.  Then the
// mesh is moved: graphs of it are refused.
#include "fvCFD.H"

#include <hearth/adapt/openfoam.hpp>
#include <hearth/core/conformance.hpp>
#include <hearth/mpi/communicator.hpp>

namespace {

template <class Mesh, class Communicator>
bool conforms(const Mesh& cells, const Communicator& ranks, Foam::Time& time, fvMesh& mesh) {
    const hearth::conformance_report report = hearth::conformance(cells, ranks);
    for (const std::string& failure : report.failures) Pout << failure.c_str() << endl;
    Pout << Foam::label(report.checks) << " checks, " << 1e9 * report.seconds_per_access << " ns an access" << endl;

    const hearth::cell_graph<Communicator> graph(cells, ranks);
    const auto refused = [&] {
        try {
            graph.require_current();
        } catch (const hearth::stale_graph&) {
            return true;
        }
        return false;
    };
    const bool before = refused();
    ++time;
    mesh.movePoints(pointField(1.001 * mesh.points()));
    const bool moved = refused();
    ++time;  // at rest again: the graph is no better for it
    mesh.moving(false);
    const bool after = refused();
    Pout << "a graph of the mesh before it moved is " << (moved && after ? "" : "NOT ") << "refused" << endl;
    return report.passed() && report.checks > mesh.nCells() && !before && moved && after;
}

}  // namespace

int main(int argc, char* argv[]) {
#include "setRootCase.H"
#include "createTime.H"
#include "createMesh.H"
    const bool passed = Pstream::parRun() ? conforms(hearth::openfoam::distributed_mesh(mesh),
                                                     hearth::mpi::communicator{}, runTime, mesh)
                                          : conforms(mesh, hearth::serial_communicator{}, runTime, mesh);
    // OpenFOAM's argList ends the program with 0, whatever main returns.
    if (!returnReduce(passed, andOp<bool>())) FatalErrorInFunction << "does not conform" << Foam::exit(FatalError);
    return 0;
}
