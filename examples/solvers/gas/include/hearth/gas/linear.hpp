// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include <hearth/gas/array.hpp>
#include <hearth/gas/mesh.hpp>
#include <hearth/gas/parallel.hpp>

namespace hearth::gas {

/// Which cells a row couples with: built once per mesh.  Rows are the owned cells, columns may be ghosts.
struct pattern {
    explicit pattern(const mesh& m);

    int rows = 0, columns = 0;
    array<int> first;            ///< size rows + 1: where a row's entries begin
    array<int> column;           ///< rising within a row; the diagonal is kept apart
    array<int> owner_entry;      ///< per internal face: entry of the owner's row
    array<int> neighbour_entry;  ///< per internal face: entry of the neighbour's row, -1 where that is a ghost
};

/// Sparse matrix with one row per owned cell.
struct matrix {
    explicit matrix(const pattern& p) : shape(&p), diagonal(p.rows, 0.0), entry(p.column.count(), 0.0) {}

    void clear();
    /// y = A x.  x holds its ghosts.
    void apply(const double* x, double* y) const;

    const pattern* shape;
    array<double> diagonal, entry;
};

/// Arrays that the equations lend one another: they are solved one after the other, and none keeps anything here.
struct workspace {
    explicit workspace(const pattern& p)
        : a(p), right(p.rows), scalar(p.columns), first(p.columns), second(p.columns), third(p.columns),
          gradient(3 * p.columns), diffusivity(p.columns) {}

    /// A third of one of the arrays of vectors: a scalar per column.
    static double* part(array<vector3>& vectors, int i) {
        return &vectors[0].x + static_cast<std::ptrdiff_t>(i) * vectors.count();
    }

    matrix a;                             ///< of the momentum, then of the pressure, then of each scalar
    array<double> right;                  ///< its right-hand side
    array<double> scalar;                 ///< the linear solvers use this one and first, the general one second too
    array<vector3> first, second, third;
    array<vector3> gradient;              ///< three per column: of the velocity until the first scalar is solved
    array<double> diffusivity;            ///< of the momentum (its viscosity), then of each scalar
};

struct solve_settings {
    double relative = 1e-2;   ///< residual over the first one, at which to stop [-]
    double absolute = 0;      ///< residual at which to stop, in the unit of the right-hand side
    int max_iterations = 200;
};

/// How a linear solve ended.  Residuals are 2-norms in the unit of the right-hand side.
struct solve_report {
    int iterations = 0;
    double first = 0, last = 0;
    bool converged = false;  ///< false: out of iterations, broken down or not finite; x holds the best finite iterate
    solve_report& operator+=(const solve_report& other);
};

/// Approximates the inverse of a symmetric positive matrix.
class preconditioner {
  public:
    virtual ~preconditioner() = default;
    /// Takes the matrix; may keep what it built for an earlier one of the same pattern until rebuild() is called.
    virtual void update(const matrix& a) = 0;
    virtual void rebuild() = 0;
    virtual void apply(const double* residual, double* correction) = 0;
};

/// Algebraic multigrid by smoothed aggregation, one W-cycle with symmetric Gauss-Seidel.  Keeps its coarse levels.
/// Vanek, Mandel, Brezina, Computing 56 (1996) 179, doi:10.1007/BF02238511.  On several ranks the groups of cells stay within their rank, and the levels are those of all
/// ranks; the last is solved by every rank.
std::unique_ptr<preconditioner> make_multigrid(const pattern& p, const parallel& ranks);

/// Conjugate gradients.  x holds a start and, on return, the best finite iterate with its ghosts gathered.
/// Rebuilds the preconditioner when it needs half as many iterations again as just after the last rebuild.
class symmetric_solver {
  public:
    symmetric_solver(std::unique_ptr<preconditioner> m, const parallel& ranks, workspace& work);
    solve_report solve(const matrix& a, const double* b, double* x, const solve_settings& settings);
    /// Builds the preconditioner anew at the next solve.
    void forget() { fresh_rate_ = 0; }

  private:
    solve_report iterate(const matrix& a, const double* b, double* x, const solve_settings& settings);

    std::unique_ptr<preconditioner> preconditioner_;
    const parallel* ranks_;
    workspace* work_;
    double fresh_rate_ = 0;  // ln(residual reduction) per iteration just after the last rebuild
};

/// BiCGSTAB (van der Vorst 1992, doi:10.1137/0913035) behind symmetric Gauss-Seidel, for matrices of any symmetry.
/// Restarts on breakdown; the best finite iterate is kept.
class general_solver {
  public:
    general_solver(const parallel& ranks, workspace& work);
    solve_report solve(const matrix& a, const double* b, double* x, const solve_settings& settings);

  private:
    const parallel* ranks_;
    workspace* work_;
};

/// One Gauss-Seidel sweep over `Width` right-hand sides that share the matrix (cell-major); backward where asked.
template <int Width>
void gauss_seidel(const matrix& a, const double* b, double* x, bool backward);

}  // namespace hearth::gas
