// SPDX-License-Identifier: MIT
#include <hearth/hearth.hpp>

#ifdef CONSUMER_USES_MPI
#include <hearth/mpi/communicator.hpp>
#endif

int main() {
    hearth::lattice mesh;
    mesh.cells = {4, 4, 4};
    const hearth::cell_graph graph(mesh);
    return graph.cell_count() == 64 ? 0 : 1;
}
