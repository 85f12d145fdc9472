// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/gas/linear.hpp>

#include "aggregation.hpp"

namespace hearth::gas {

/// What couples a rank with the others on each level of a multigrid whose groups stay within their rank: the couplings of
/// the finest level, looked at through the prolongations to its cells at the border.  So each level is the Galerkin
/// operator of all ranks, and ghosts are gathered on the finest level only.  Empty on one rank.
class border {
  public:
    border(const pattern& p, const parallel& ranks);
    bool empty() const { return halo_.empty(); }

    /// Begins a hierarchy with the couplings of the finest level.
    void begin(const matrix& a);
    /// Adds a level to it, by the prolongation to the last one.
    void add_level(const sparse& to_fine);

    /// Per row of the last level: what its couplings to other ranks add to the sum of its row, and, for `inner`, to the
    /// sum of the row that holds this rank's part alone.
    array<double> row_sum(bool inner) const;
    /// The last level's matrix of all ranks, on every rank; first_row becomes the place of this rank's rows.
    sparse gathered(const sparse& own, int& first_row) const;

    /// Ghosts of a field on the finest level.
    void gather(float* x) const;
    /// What x on the other ranks adds to the right-hand side of a level; with `difference`, what x there minus x here does.
    void bring(std::size_t level, const float* x, float* out, bool difference) const;

  private:
    struct rows {
        array<int> first{0}, column;
        array<double> value;
    };
    /// Per border cell: its coupling times what a level makes of a field there, given at the ghosts in halo_.
    double sum(int i) const;
    void fill(const rows& to_fine, const float* x) const;

    const parallel* ranks_;
    const pattern* shape_;
    array<int> cells_, first_{0}, ghost_;  // cells at the border and their ghosts
    array<double> strength_;               // minus the coupling
    array<rows> levels_;                   // per level and border cell: a row of the prolongation to the finest level
    array<array<double>> ones_;            // per level and border cell: sum of strength times a field of ones
    mutable array<double> halo_;           // per cell of the finest level with ghosts
};

}  // namespace hearth::gas
