// SPDX-License-Identifier: MIT
#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <hearth/furnace/settings.hpp>
#include <hearth/io/hdf5_file.hpp>

#include "command_line.hpp"
#include "run.hpp"

int main(int count, char** arguments) {
    using namespace hearth::furnace::program;
    const command_or_exit given = read_command_line(count, arguments);
    if (!given.command) return given.exit;

    // The files are parallel HDF5's, so MPI is needed.  Without mpirun, Open MPI would start a daemon that outlives a kill.
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    MPI_Init(&count, &arguments);
    int ranks = 1, rank = 0, code = exit_code::failed;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    try {
        if (ranks > 1) throw hearth::furnace::bad_scene(std::to_string(ranks) + " ranks: the furnace runs on one");
        code = run(*given.command);
    } catch (const hearth::furnace::bad_scene& error) {
        if (rank == 0) std::fprintf(stderr, "furnace: %s\n", error.what());
        code = exit_code::bad_input;
    } catch (const hearth::io::file_error& error) {
        std::fprintf(stderr, "furnace: %s\n", error.what());
        code = exit_code::bad_file;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "furnace: %s\n", error.what());
    }
    MPI_Finalize();
    return code;
}
