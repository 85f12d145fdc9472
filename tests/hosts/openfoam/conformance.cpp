// SPDX-License-Identifier: MIT
// OpenFOAM's mesh under hearth's conformance suite, in the case where it is started; serial or -parallel.
#include "fvCFD.H"

#include <hearth/adapt/openfoam.hpp>
#include <hearth/core/conformance.hpp>
#include <hearth/mpi/communicator.hpp>

int main(int argc, char* argv[]) {
    #include "setRootCase.H"
    #include "createTime.H"
    #include "createMesh.H"
    hearth::conformance_report report;
    if (Pstream::parRun()) {
        report = hearth::conformance(hearth::openfoam::distributed_mesh(mesh), hearth::mpi::communicator{});
    } else {
        report = hearth::conformance(mesh);
    }
    for (const std::string& failure : report.failures) Pout << failure.c_str() << endl;
    Pout << Foam::label(report.checks) << " checks, " << 1e9 * report.seconds_per_access << " ns an access" << endl;
    return returnReduce(report.passed() && report.checks > mesh.nCells(), andOp<bool>()) ? 0 : 1;
}
