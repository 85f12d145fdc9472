// SPDX-License-Identifier: MIT
#include <hearth/gas/mpi_ranks.hpp>

namespace hearth::gas {

std::unique_ptr<preconditioner> mpi_ranks::make_preconditioner(const pattern& p) const {
    return ranks() > own_multigrid_up_to && has_hypre() ? make_boomer_amg(p, *this, communicator().native()) : make_multigrid(p, *this);
}

}  // namespace hearth::gas
