// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>

#include <hearth/gas/array.hpp>

namespace hearth::gas {

using sparse = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// The matrix with couplings below `threshold` added to the diagonal, and with the diagonal's share in couplings to other
/// ranks, `across`, taken off it: what is smooth ends at no rank's border.  A coupling is measured by both diagonals, or by
/// that of its row: where the coefficient jumps, one side hangs on the other and not the other on it.
sparse strong_part(const sparse& a, double threshold, const array<double>& across, bool by_row);

/// Groups of strongly coupled cells.  Returns the group of each cell and their number.
array<int> aggregate(const sparse& strong, int& groups);

/// Piecewise constant prolongation smoothed by one damped Jacobi step.
sparse prolongation(const sparse& strong, const array<int>& group, int groups);

}  // namespace hearth::gas
