// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <hearth/gas/distributed.hpp>
#include <hearth/gas/linear.hpp>
#include <hearth/mpi/communicator.hpp>

namespace hearth::gas {

/// The ranks of an MPI program: what a solver on a share of a mesh takes as its last argument.
///
///     const mesh share(whole, partition(whole, communicator.size()), communicator.rank());
///     const mpi_ranks ranks(share, communicator);
///     solver gas(share, model, settings, ranks);
///
/// The pressure is solved behind the solver's own multigrid, whose last level every rank solves; on more ranks than
/// `own_multigrid_up_to` behind hypre's BoomerAMG, where hypre was found when this was built.
class mpi_ranks final : public distributed<mpi::communicator> {
  public:
    using distributed::distributed;
    static constexpr int own_multigrid_up_to = 8;
    std::unique_ptr<preconditioner> make_preconditioner(const pattern& p) const override;
};

/// Whether hypre was found when this was built.
bool has_hypre();

/// One V-cycle of BoomerAMG (Henson & Yang 2002, doi:10.1016/S0168-9274(01)00115-5) over all ranks, kept until rebuild().
/// Null without hypre.
std::unique_ptr<preconditioner> make_boomer_amg(const pattern& p, const parallel& ranks, MPI_Comm communicator);

}  // namespace hearth::gas
