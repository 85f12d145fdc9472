// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/linear.hpp>

using namespace hearth::gas;

namespace {

/// Diffusion with the mesh's conductances, times a coefficient per cell (harmonic at faces); one cell held fixed by `pin`.
matrix diffusion(const mesh& m, const pattern& p, const array<double>& coefficient, double pin) {
    matrix a(p);
    for (int f = 0; f < m.internal_faces(); ++f) {
        const int o = m.owner[f], n = m.neighbour[f];
        const double g = m.conductance[f] * 2 / (1 / coefficient[o] + 1 / coefficient[n]);
        a.entry[p.owner_entry[f]] = a.entry[p.neighbour_entry[f]] = -g;
        a.diagonal[o] += g;
        a.diagonal[n] += g;
    }
    a.diagonal[0] += pin;
    return a;
}

array<double> random_field(int n, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    array<double> x(n);
    for (double& v : x) v = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
    return x;
}

/// Backward error: |b - A x| over |b| + ||A| |x||.  Round-off alone leaves about 1e-16 of the second part.
double residual(const matrix& a, const array<double>& x, const array<double>& b) {
    double sum = 0, right = 0, scale = 0;
    const pattern& p = *a.shape;
    for (int c = 0; c < p.rows; ++c) {
        double r = b[c] - a.diagonal[c] * x[c], size = std::abs(a.diagonal[c] * x[c]);
        for (int i = p.first[c]; i < p.first[c + 1]; ++i) {
            r -= a.entry[i] * x[p.column[i]];
            size += std::abs(a.entry[i] * x[p.column[i]]);
        }
        sum += r * r;
        right += b[c] * b[c];
        scale += size * size;
    }
    return std::sqrt(sum) / (std::sqrt(right) + std::sqrt(scale));
}

int iterations(const mesh& m, double jump, double reduction) {
    const pattern p(m);
    const parallel one;
    array<double> coefficient(m.cells());
    for (int c = 0; c < m.cells(); ++c) coefficient[c] = m.centre[c].z > 0.5 ? 1 : jump;
    const matrix a = diffusion(m, p, coefficient, 1.0);
    workspace work(p);
    symmetric_solver solver(make_multigrid(p, one), one, work);
    const auto b = random_field(m.cells(), 3);
    array<double> x(m.cells(), 0.0);
    const solve_report report = solver.solve(a, b.data(), x.data(), {reduction, 0, 200});
    CHECK(report.converged);
    CHECK(residual(a, x, b) < 2 * reduction);  // the recursive residual may drift by less than itself
    return report.iterations;
}

}  // namespace

TEST_CASE("multigrid: iterations do not grow with the number of cells") {
    const int small = iterations(mesh(box(graded(1, 12), graded(1, 12), graded(1, 12))), 1, 1e-9);
    const int large = iterations(mesh(box(graded(1, 40), graded(1, 40), graded(1, 40))), 1, 1e-9);
    MESSAGE("1.7e3 cells: " << small << ", 6.4e4 cells: " << large << " iterations to 1e-9");
    CHECK(large <= small + 2);  // 37 times the cells
    CHECK(large <= 15);
    // nor where the coefficient jumps by 1000
    const int small_jump = iterations(mesh(box(graded(1, 12), graded(1, 12), graded(1, 12))), 1e-3, 1e-9);
    const int large_jump = iterations(mesh(box(graded(1, 40), graded(1, 40), graded(1, 40))), 1e-3, 1e-9);
    MESSAGE("with a jump: " << small_jump << ", " << large_jump);
    CHECK(large_jump <= small_jump + 2);
}

TEST_CASE("multigrid: copes with jumps of 1e6 and with flat cells") {
    CHECK(iterations(mesh(box(graded(1, 24), graded(1, 24), graded(1, 24))), 1e-6, 1e-9) <= 40);
    CHECK(iterations(mesh(box(graded(1, 24), graded(1, 24, 50.0), graded(0.02, 24))), 1, 1e-9) <= 40);
}

TEST_CASE("symmetric solver: keeps a hierarchy that fits and drops one that does not") {
    const mesh m(box(graded(1, 16), graded(1, 16), graded(1, 16)));
    const pattern p(m);
    const parallel one;
    workspace work(p);
    symmetric_solver solver(make_multigrid(p, one), one, work);
    const auto b = random_field(m.cells(), 5);
    for (const double scale : {1.0, 1.1, 1e4, 1e-4}) {
        CAPTURE(scale);
        array<double> coefficient(m.cells(), scale), x(m.cells(), 0.0);
        for (int c = 0; c < m.cells(); c += 2) coefficient[c] *= scale;
        const matrix a = diffusion(m, p, coefficient, scale);
        const solve_report report = solver.solve(a, b.data(), x.data(), {1e-8, 0, 300});
        CHECK(report.converged);
        CHECK(residual(a, x, b) < 2e-8);
    }
}

TEST_CASE("general solver: convection with diffusion, Peclet 1e-3 to 1e6") {
    const mesh m(box(graded(1, 20), graded(1, 20), graded(1, 3)));
    const pattern p(m);
    const parallel one;
    const array<double> unit(m.cells(), 1.0);
    for (const double peclet : {1e-3, 1.0, 1e3, 1e6}) {
        CAPTURE(peclet);
        matrix a = diffusion(m, p, unit, 0.0);
        for (int f = 0; f < m.internal_faces(); ++f) {  // upwind, flow along (1, 2, 0)
            const double flux = peclet * (m.area[f].x + 2 * m.area[f].y);
            a.entry[p.neighbour_entry[f]] -= flux;
            a.diagonal[m.neighbour[f]] += flux;
        }
        for (int c = 0; c < m.cells(); ++c) a.diagonal[c] += 1e-3 * m.volume[c];
        const auto b = random_field(m.cells(), 11);
        array<double> x(m.cells(), 0.0);
        workspace work(p);
        general_solver solver(one, work);
        const solve_report report = solver.solve(a, b.data(), x.data(), {1e-10, 0, 2000});
        CHECK(report.converged);
        CHECK(residual(a, x, b) < 1e-9);
    }
}

TEST_CASE("solvers: a right-hand side that is not finite is reported, and x stays finite") {
    const mesh m(box(graded(1, 4), graded(1, 4), graded(1, 4)));
    const pattern p(m);
    const parallel one;
    const matrix a = diffusion(m, p, array<double>(m.cells(), 1.0), 1.0);
    array<double> b(m.cells(), 1.0), x(m.cells(), 0.0);
    b[7] = std::nan("");
    workspace work(p);
    symmetric_solver symmetric(make_multigrid(p, one), one, work);
    general_solver general(one, work);
    CHECK_FALSE(symmetric.solve(a, b.data(), x.data(), {}).converged);
    CHECK_FALSE(general.solve(a, b.data(), x.data(), {}).converged);
    for (const double v : x) CHECK(std::isfinite(v));
}
