// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

#include <hearth/core/lattice.hpp>

namespace hearth::test {

/// Permeability of a lattice along z with Carman and Kozeny's (1 - s)^3 / s^2 in each cell, over that of its mean solid
/// fraction: Darcy's equation with fixed pressures below and above, harmonic means at faces.
inline double relative_permeability(const lattice& mesh, const std::vector<double>& solid) {
    const auto n = static_cast<int>(solid.size());
    const int layer = mesh.cells[0] * mesh.cells[1];
    const auto carman_kozeny = [](double s) { return std::pow(1 - s, 3) / (s * s); };
    double mean = 0;
    std::vector<double> k;
    for (const double s : solid) {
        mean += s / n;
        k.push_back(carman_kozeny(s));
    }
    const auto at = [&](int c) { return k[static_cast<std::size_t>(c)]; };
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd source = Eigen::VectorXd::Zero(n);
    lattice open = mesh;
    open.periodic[2] = false;
    mesh_traits<lattice>::for_each_face(open, [&](int a, int b, double, double conductance) {
        const double g = conductance * 2 * at(a) * at(b) / (at(a) + at(b));
        for (const auto& [i, j, v] : {std::tuple{a, a, g}, {b, b, g}, {a, b, -g}, {b, a, -g}})
            entries.emplace_back(i, j, v);
    });
    const double end = 2 * mesh.spacing[0] * mesh.spacing[1] / mesh.spacing[2];
    for (int c = 0; c < layer; ++c) {
        entries.emplace_back(c, c, end * at(c));
        source[c] += end * at(c);
        entries.emplace_back(n - 1 - c, n - 1 - c, end * at(n - 1 - c));
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
    solver.setTolerance(1e-8);
    const Eigen::VectorXd pressure = solver.solve(source);
    double flow = 0;
    for (int c = 0; c < layer; ++c) flow += end * at(c) * (1 - pressure[c]);
    const double through_mean =
        layer * mesh.spacing[0] * mesh.spacing[1] / (mesh.cells[2] * mesh.spacing[2]) * carman_kozeny(mean);
    return flow / through_mean;
}

}  // namespace hearth::test
