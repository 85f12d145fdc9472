// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <hearth/core/lattice.hpp>

#include "support/exact.hpp"
#include "support/packing.hpp"

namespace hearth::test {

/// A bed with a name, for tables of errors.
struct named_bed {
    std::string name;
    packing bed;
};

/// Loose and dense, of one size and of several, between walls and periodic; mean diameter 1 [m].  The width of the ramp
/// deposit was chosen on seeds 1 to 6: tests take others.
inline std::vector<named_bed> several_beds(double side, std::uint64_t seed) {
    const point size{side, side, side};
    const std::array<bool, 3> walls{false, false, false}, free{true, true, true};
    return {{"dense, walls", make_packing({0.55, size, 0, walls, seed})},
            {"dense, periodic", make_packing({0.60, size, 0, free, seed + 1})},
            {"loose, walls", make_packing({0.35, size, 0, walls, seed + 2})},
            {"loose, periodic", make_packing({0.35, size, 0, free, seed + 3})},
            {"dense, sizes 0.6 to 1.4, walls", make_packing({0.53, size, 0.4, walls, seed + 4})},
            {"dense, sizes 0.6 to 1.4, periodic", make_packing({0.60, size, 0.4, free, seed + 5})}};
}

/// A lattice over a bed's box with `per_diameter` cells along 1 [m], rounded to a whole number of cells.
inline lattice lattice_over(const packing& bed, double per_diameter) {
    lattice mesh;
    for (std::size_t a = 0; a < 3; ++a) {
        mesh.cells[a] = std::max(1, static_cast<std::int32_t>(std::lround(bed.size[a] * per_diameter)));
        mesh.spacing[a] = bed.size[a] / mesh.cells[a];
        mesh.periodic[a] = bed.periodic[a];
    }
    return mesh;
}

/// Volume-weighted mean diameter [m].
inline double mean_diameter(const packing& bed) {
    double weight = 0, weighted = 0;
    for (const double r : bed.radii) {
        weight += r * r * r;
        weighted += 2 * r * r * r * r;
    }
    return weighted / weight;
}

/// The exact indicator of a bed's spheres under a filter, averaged over boxes: sums of closed forms over the spheres
/// and their images (periodic ones, and mirror images in walls: the filter is reflected there), integrated over the box
/// with Gauss points.  Sphere(r, R): the filtered indicator of one sphere; zero beyond `range` from its surface.
template <class Sphere>
class filtered_truth {
  public:
    filtered_truth(const packing& bed, double range, Sphere sphere) : bed_(bed), range_(range), sphere_(sphere) {
        const double largest = *std::max_element(bed.radii.begin(), bed.radii.end());
        reach_ = range + largest;
        for (std::size_t a = 0; a < 3; ++a) {
            bins_[a] = static_cast<int>(std::ceil((bed.size[a] + 2 * reach_) / reach_)) + 1;
        }
        images_.resize(static_cast<std::size_t>(bins_[0] * bins_[1] * bins_[2]));
        for (std::size_t i = 0; i < bed.radii.size(); ++i) {
            std::array<std::vector<double>, 3> along;
            for (std::size_t a = 0; a < 3; ++a) {
                const double x = bed.positions[i][a], L = bed.size[a];
                const auto turns = static_cast<int>(std::ceil(reach_ / L)) + 1;
                for (int n = -turns; n <= turns; ++n) {
                    if (bed.periodic[a]) {
                        along[a].push_back(x + n * L);
                    } else {
                        along[a].push_back(2 * n * L + x);
                        along[a].push_back(2 * n * L - x);
                    }
                }
            }
            for (const double x : along[0]) {
                for (const double y : along[1]) {
                    for (const double z : along[2]) {
                        const point image{x, y, z};
                        bool near = true;
                        for (std::size_t a = 0; a < 3; ++a)
                            near = near && image[a] > -reach_ && image[a] < bed.size[a] + reach_;
                        if (near) images_[bin(bin(x), bin(y), bin(z))].push_back({image, bed.radii[i]});
                    }
                }
            }
        }
    }

    double at(const point& x) const {
        double sum = 0;
        for (int k = bin(x[2]) - 1; k <= bin(x[2]) + 1; ++k) {
            for (int j = bin(x[1]) - 1; j <= bin(x[1]) + 1; ++j) {
                for (int i = bin(x[0]) - 1; i <= bin(x[0]) + 1; ++i) {
                    for (const auto& [centre, radius] : images_[bin(i, j, k)]) {
                        const double r = std::hypot(centre[0] - x[0], centre[1] - x[1], centre[2] - x[2]);
                        if (r < radius + range_) sum += sphere_(r, radius);
                    }
                }
            }
        }
        return sum;
    }

    /// Mean over a box; `points` Gauss points along each axis.
    double mean(const point& centre, const point& extent, int points) const {
        const gauss_legendre rule(points);
        double sum = 0;
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
                for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                    sum += rule.weights[i] * rule.weights[j] * rule.weights[k] / 8 *
                           at({centre[0] + 0.5 * extent[0] * rule.nodes[i], centre[1] + 0.5 * extent[1] * rule.nodes[j],
                               centre[2] + 0.5 * extent[2] * rule.nodes[k]});
                }
            }
        }
        return sum;
    }

  private:
    struct image {
        point centre;
        double radius;
    };
    int bin(double x) const { return static_cast<int>((x + reach_) / reach_); }
    std::size_t bin(int i, int j, int k) const { return static_cast<std::size_t>(i + bins_[0] * (j + bins_[1] * k)); }

    const packing& bed_;
    double range_, reach_ = 0;
    Sphere sphere_;
    std::array<int, 3> bins_{};
    std::vector<std::vector<image>> images_;
};

/// The truth of the recommended solid fraction: the indicator under a Gaussian of standard deviation half the mean
/// diameter, reflected at walls.  Left out beyond 4.5 standard deviations: 1.5e-4 of each sphere.
inline auto gauss_truth(const packing& bed) {
    const double sigma = 0.5 * mean_diameter(bed);
    const auto sphere = [sigma](double r, double R) { return gauss_filtered_sphere(r, R, sigma); };
    return filtered_truth<decltype(sphere)>(bed, 4.5 * sigma, sphere);
}

/// The same with a ball of equal variance (radius sqrt(5) sigma), which no smoother here approximates on purpose.
inline auto ball_truth(const packing& bed) {
    const double radius = std::sqrt(5.0) * 0.5 * mean_diameter(bed);
    const auto sphere = [radius](double r, double R) { return ball_filtered_sphere(r, R, radius); };
    return filtered_truth<decltype(sphere)>(bed, radius, sphere);
}

/// Gauss points along an axis with which the mean over a box of this width [m] is good to a few 1e-4.
inline int points_for(double widest) { return widest > 1.5 ? 5 : widest > 0.6 ? 3 : 2; }

/// Mean of a truth over each `stride`-th cell of a lattice.
template <class Truth>
std::vector<double> means_over(const lattice& mesh, const Truth& truth, int stride = 1) {
    const int points = points_for(*std::max_element(mesh.spacing.begin(), mesh.spacing.end()));
    std::vector<double> means;
    for (std::int32_t c = 0; c < mesh_traits<lattice>::cell_count(mesh); c += stride) {
        means.push_back(truth.mean(mesh_traits<lattice>::centre(mesh, c), mesh.spacing, points));
    }
    return means;
}

/// Every `stride`-th value of a field.
inline std::vector<double> every(const std::vector<double>& field, int stride) {
    std::vector<double> some;
    for (std::size_t c = 0; c < field.size(); c += static_cast<std::size_t>(stride)) some.push_back(field[c]);
    return some;
}

/// Root mean square difference of two fields in every `stride`-th cell of a lattice, of those whose centres are at
/// least `margin` [m] from the walls.
inline double rms_difference(const lattice& mesh, const packing& bed, const std::vector<double>& a,
                             const std::vector<double>& b, int stride, double margin = 0) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const point x = mesh_traits<lattice>::centre(mesh, static_cast<std::int32_t>(k) * stride);
        bool inside = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            inside = inside && (bed.periodic[axis] || (x[axis] >= margin && x[axis] <= bed.size[axis] - margin));
        }
        if (!inside) continue;
        sum += (a[k] - b[k]) * (a[k] - b[k]);
        ++count;
    }
    return std::sqrt(sum / count);
}

}  // namespace hearth::test
