// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/core/cell_graph.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/voidage/deposit.hpp>

#include "support/exact.hpp"

/// What a coupling code would do for its solid fraction without hearth.  Each returns the fraction of every cell [-].
/// They search cells with hearth's locator, so that the search costs all the same.
namespace rivals {

/// The volume of each particle goes to the cells of a deposit policy, and what is above the threshold is cut off: the
/// usual centre and divided methods of CFD-DEM codes.  Loses solid.
template <class Locator, class Cloud, class Policy>
std::vector<double> clamped(const Locator& locator, const Cloud& cloud, const Policy& policy, double threshold) {
    std::vector<double> field(static_cast<std::size_t>(locator.graph().cell_count()));
    hearth::deposit_solid_fraction(locator, cloud, field, policy);
    for (double& fraction : field) fraction = std::min(fraction, threshold);
    return field;
}

/// The volume of each particle goes to the cells within three standard deviations in proportion to a Gaussian at their
/// centres, normalised to the volume.
template <class Locator, class Cloud>
std::vector<double> gauss(const Locator& locator, const Cloud& cloud, double sigma) {
    const auto& graph = locator.graph();
    std::vector<double> field(static_cast<std::size_t>(graph.cell_count()), 0.0);
    std::vector<std::pair<std::size_t, double>> row;
    for (const hearth::visitor& v : hearth::visitors<>(locator, cloud)) {
        row.clear();
        double sum = 0;
        // 0.87 extents: a cell of the particle's own size or larger is found at least where it holds the centre.
        locator.for_each_near(v.position, 3 * sigma, 0.87,
                              [&](std::int32_t c, const hearth::point& away, const hearth::point&) {
                                  const double r2 = away[0] * away[0] + away[1] * away[1] + away[2] * away[2];
                                  const double weight = std::exp(-0.5 * r2 / (sigma * sigma)) * graph.volume(c);
                                  row.emplace_back(static_cast<std::size_t>(c), weight);
                                  sum += weight;
                              });
        for (const auto& [c, weight] : row)
            field[c] += v.volume() * weight / sum / graph.volume(static_cast<std::int32_t>(c));
    }
    return field;
}

/// The exact volume of the overlap of sphere and cell, which must be a box: resolves the particles.
template <class Locator, class Cloud>
std::vector<double> exact_overlap(const Locator& locator, const Cloud& cloud) {
    const auto& graph = locator.graph();
    std::vector<double> field(static_cast<std::size_t>(graph.cell_count()), 0.0);
    for (const hearth::visitor& v : hearth::visitors<>(locator, cloud)) {
        locator.for_each_near(v.position, v.radius, 0.5,
                              [&](std::int32_t c, const hearth::point& away, const hearth::point& extent) {
                                  hearth::point low = away, high = away;
                                  for (std::size_t a = 0; a < 3; ++a) {
                                      low[a] -= 0.5 * extent[a];
                                      high[a] += 0.5 * extent[a];
                                  }
                                  field[static_cast<std::size_t>(c)] +=
                                      hearth::test::sphere_box_overlap(v.radius, low, high) / graph.volume(c);
                              });
    }
    return field;
}

/// Centre deposit, then diffusion over sigma^2 / 2 in three implicit steps by conjugate gradients with the diagonal as
/// preconditioner, to 1e-6: after Sun and Xiao, Int. J. Multiphase Flow 77 (2015) 142,
/// doi:10.1016/j.ijmultiphaseflow.2015.08.014.
template <class Locator, class Cloud>
std::vector<double> implicit_diffusion(const Locator& locator, const Cloud& cloud, double sigma) {
    const auto& graph = locator.graph();
    const auto n = static_cast<std::size_t>(graph.cell_count());
    std::vector<double> x(n), b(n), r(n), p(n), q(n), diagonal(n);
    hearth::deposit_solid_fraction(locator, cloud, x, hearth::deposit::centre{});
    const double step = 0.5 * sigma * sigma / 3;
    const auto apply = [&](const std::vector<double>& in, std::vector<double>& out) {
        for (std::size_t i = 0; i < n; ++i) {
            const auto c = static_cast<std::int32_t>(i);
            double sum = 0;
            for (std::uint32_t k = graph.row_begin(c); k < graph.row_end(c); ++k) {
                sum += static_cast<double>(graph.conductances()[k]) *
                       (in[i] - in[static_cast<std::size_t>(graph.neighbours()[k])]);
            }
            out[i] = graph.volume(c) * in[i] + step * sum;
        }
    };
    for (std::size_t i = 0; i < n; ++i) {
        const auto c = static_cast<std::int32_t>(i);
        diagonal[i] = graph.volume(c);
        for (std::uint32_t k = graph.row_begin(c); k < graph.row_end(c); ++k) {
            diagonal[i] += step * static_cast<double>(graph.conductances()[k]);
        }
    }
    const auto dot = [&](const std::vector<double>& u, const std::vector<double>& v) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += u[i] * v[i] / diagonal[i];
        return sum;
    };
    for (int implicit = 0; implicit < 3; ++implicit) {
        for (std::size_t i = 0; i < n; ++i) b[i] = graph.volume(static_cast<std::int32_t>(i)) * x[i];
        apply(x, q);
        for (std::size_t i = 0; i < n; ++i) {
            r[i] = b[i] - q[i];
            p[i] = r[i] / diagonal[i];
        }
        double rr = dot(r, r);
        const double enough = 1e-12 * dot(b, b);
        while (rr > enough) {
            apply(p, q);
            double pq = 0;
            for (std::size_t i = 0; i < n; ++i) pq += p[i] * q[i];
            const double alpha = rr / pq;
            for (std::size_t i = 0; i < n; ++i) {
                x[i] += alpha * p[i];
                r[i] -= alpha * q[i];
            }
            const double before = rr;
            rr = dot(r, r);
            for (std::size_t i = 0; i < n; ++i) p[i] = r[i] / diagonal[i] + rr / before * p[i];
        }
    }
    return x;
}

}  // namespace rivals
