// SPDX-License-Identifier: MIT
#include <hearth/gas/mpi_ranks.hpp>

namespace hearth::gas {

bool has_hypre() { return false; }

std::unique_ptr<preconditioner> make_boomer_amg(const pattern&, const parallel&, MPI_Comm) { return nullptr; }

}  // namespace hearth::gas
