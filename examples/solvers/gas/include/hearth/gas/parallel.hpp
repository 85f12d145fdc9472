// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace hearth::gas {

struct pattern;
class preconditioner;

/// What the solver asks of the other ranks.  This one is a program on a single rank: every call is free.
/// All ranks make the same calls in the same order.  For several see distributed.hpp and mpi_ranks.hpp.
class parallel {
  public:
    virtual ~parallel() = default;
    virtual int ranks() const { return 1; }
    virtual int rank() const { return 0; }
    /// Copies the owners' values to the ghosts; `width` doubles per cell.
    virtual void gather(double* /*field*/, int /*width*/) const {}
    /// Sums each of `count` values over all ranks.
    virtual void sum(double* /*values*/, int /*count*/) const {}
    /// The greatest; on several ranks what is not a number counts as infinite.
    virtual double max(double mine) const { return mine; }
    /// What stands before the conjugate gradients of the pressure: the solver's own multigrid, on each rank its own.
    virtual std::unique_ptr<preconditioner> make_preconditioner(const pattern& p) const;

    double sum(double mine) const {
        sum(&mine, 1);
        return mine;
    }
};

}  // namespace hearth::gas
