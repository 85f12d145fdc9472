// SPDX-License-Identifier: MIT
#pragma once

namespace hearth::gas {

/// What the solver asks of the other ranks.  This one is a program on a single rank: every call is free.
/// All ranks make the same calls in the same order.
class parallel {
  public:
    virtual ~parallel() = default;
    virtual int ranks() const { return 1; }
    /// Copies the owners' values to the ghosts; `width` doubles per cell.
    virtual void gather(double* /*field*/, int /*width*/) const {}
    /// Sums each of `count` values over all ranks.
    virtual void sum(double* /*values*/, int /*count*/) const {}
    virtual double max(double mine) const { return mine; }

    double sum(double mine) const {
        sum(&mine, 1);
        return mine;
    }
};

}  // namespace hearth::gas
