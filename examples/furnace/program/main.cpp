// SPDX-License-Identifier: MIT
#include <mpi.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <hearth/furnace/settings.hpp>
#include <hearth/io/hdf5_file.hpp>
#include <hearth/mpi/communicator.hpp>

#include "command_line.hpp"
#include "run.hpp"

namespace hearth::furnace::program {
namespace {

using text_buffer = std::array<char, 4096>;

/// How a rank ended.
struct ending {
    int code = exit_code::failed;
    std::string complaint;
};

ending run_and_catch(const command_line& command, const ranks& among) {
    try {
        return {run(command, among), ""};
    } catch (const bad_scene& error) {
        return {exit_code::bad_input, error.what()};
    } catch (const io::file_error& error) {
        return {exit_code::bad_file, error.what()};
    } catch (const std::exception& error) {
        return {exit_code::failed, error.what()};
    }
}

/// Most errors are met by all ranks: then rank 0 says each complaint once.  One that the others know nothing of ends them all,
/// for they would wait for this rank for ever.
void complain(const ending& end, MPI_Comm apart) {
    int rank = 0, ranks = 1;
    MPI_Comm_rank(apart, &rank);
    MPI_Comm_size(apart, &ranks);
    MPI_Request all_here = MPI_REQUEST_NULL;
    MPI_Ibarrier(apart, &all_here);
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    for (int here = 0; here == 0;) {
        MPI_Test(&all_here, &here, MPI_STATUS_IGNORE);
        if (here != 0) break;
        if (std::chrono::steady_clock::now() > give_up) {
            std::fprintf(stderr, "furnace: rank %d: %s\n", rank, end.complaint.c_str());
            MPI_Abort(MPI_COMM_WORLD, end.code);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    text_buffer mine{};
    std::strncpy(mine.data(), end.complaint.c_str(), mine.size() - 1);
    std::vector<text_buffer> all(static_cast<std::size_t>(ranks));
    MPI_Gather(mine.data(), static_cast<int>(mine.size()), MPI_CHAR, all.data(), static_cast<int>(mine.size()), MPI_CHAR, 0, apart);
    if (rank != 0) return;
    std::set<std::string> said{""};
    for (const auto& text : all) {
        const bool of_others = std::strstr(text.data(), "another rank") != nullptr;  // that one says it itself
        if ((ranks == 1 || !of_others) && said.insert(text.data()).second) std::fprintf(stderr, "furnace: %s\n", text.data());
    }
}

}  // namespace
}  // namespace hearth::furnace::program

int main(int count, char** arguments) {
    using namespace hearth::furnace::program;
    // The files are parallel HDF5's, so MPI is needed.  Without mpirun, Open MPI would start a daemon that outlives a kill.
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    MPI_Init(&count, &arguments);
    const hearth::mpi::communicator world;
    MPI_Comm apart = MPI_COMM_NULL;  // where no message of the run comes between
    MPI_Comm_dup(MPI_COMM_WORLD, &apart);
    const command_or_exit given = read_command_line(count, arguments, world.rank() == 0);
    ending end{given.exit, ""};
    if (given.command) end = run_and_catch(*given.command, world);
    if (!end.complaint.empty() || end.code == exit_code::failed) complain(end, apart);
    MPI_Comm_free(&apart);
    MPI_Finalize();
    return end.code;
}
