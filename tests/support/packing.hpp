// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/core/mesh_traits.hpp>
#include <hearth/core/particle_traits.hpp>

#include "support/random.hpp"

namespace hearth::test {

/// Spheres in a box from the origin to `size` [m], whose sides are walls or repeat themselves.
struct packing {
    std::vector<point> positions;
    std::vector<double> radii;
    point size{1, 1, 1};
    std::array<bool, 3> periodic{false, false, false};

    /// Of all spheres [m^3].
    double volume() const {
        double sum = 0;
        for (const double r : radii) sum += 4.0 / 3.0 * 3.14159265358979323846 * r * r * r;
        return sum;
    }
    double solid_fraction() const { return volume() / (size[0] * size[1] * size[2]); }
};

struct packing_settings {
    double solid_fraction;  ///< of the whole box [-]
    point size{6, 6, 6};    ///< in mean diameters, which are 1 [m]
    double spread = 0;      ///< radii are uniform in (1 -+ spread) / 2 [m]
    std::array<bool, 3> periodic{false, false, false};
    std::uint64_t seed = 1;
};

namespace detail {

/// Visits each pair of spheres that may touch, by bins of the largest diameter; visit(i, j, x_j - x_i).
class sphere_bins {
  public:
    sphere_bins(const packing& bed, double diameter) : bed_(bed) {
        for (std::size_t a = 0; a < 3; ++a) {
            bins_[a] = std::max(1, static_cast<int>(bed.size[a] / diameter));
        }
        first_.assign(static_cast<std::size_t>(bins_[0] * bins_[1] * bins_[2]), -1);
        next_.assign(bed.positions.size(), -1);
        for (std::size_t i = bed.positions.size(); i-- > 0;) {
            const std::size_t b = bin(at(i, 0), at(i, 1), at(i, 2));
            next_[i] = first_[b];
            first_[b] = static_cast<int>(i);
        }
    }

    template <class Visit>
    void for_each_near(std::size_t i, Visit&& visit) const {
        std::array<std::vector<int>, 3> range;
        for (std::size_t a = 0; a < 3; ++a) {
            for (int step = -1; step <= 1; ++step) {
                int b = at(i, a) + step;
                if (bed_.periodic[a]) b = (b + bins_[a]) % bins_[a];
                if (b < 0 || b >= bins_[a]) continue;
                if (std::find(range[a].begin(), range[a].end(), b) == range[a].end()) range[a].push_back(b);
            }
        }
        for (const int bz : range[2]) {
            for (const int by : range[1]) {
                for (const int bx : range[0]) {
                    for (int j = first_[bin(bx, by, bz)]; j >= 0; j = next_[static_cast<std::size_t>(j)]) {
                        const auto other = static_cast<std::size_t>(j);
                        if (other == i) continue;
                        point apart{};
                        for (std::size_t a = 0; a < 3; ++a) {
                            apart[a] = bed_.positions[other][a] - bed_.positions[i][a];
                            if (bed_.periodic[a]) apart[a] -= bed_.size[a] * std::round(apart[a] / bed_.size[a]);
                        }
                        visit(other, apart);
                    }
                }
            }
        }
    }

  private:
    int at(std::size_t i, std::size_t a) const {
        const double b = std::floor(bed_.positions[i][a] / bed_.size[a] * bins_[a]);
        return static_cast<int>(std::clamp(b, 0.0, bins_[a] - 1.0));
    }
    std::size_t bin(int x, int y, int z) const { return static_cast<std::size_t>(x + bins_[0] * (y + bins_[1] * z)); }

    const packing& bed_;
    std::array<int, 3> bins_{};
    std::vector<int> first_, next_;
};

}  // namespace detail

/// Largest overlap of two spheres, or of a sphere and a wall, over the mean diameter [-].
inline double largest_overlap(const packing& bed) {
    const double diameter = 2 * *std::max_element(bed.radii.begin(), bed.radii.end());
    const detail::sphere_bins bins(bed, diameter);
    double largest = 0;
    for (std::size_t i = 0; i < bed.positions.size(); ++i) {
        bins.for_each_near(i, [&](std::size_t j, const point& apart) {
            largest = std::max(largest, bed.radii[i] + bed.radii[j] - std::hypot(apart[0], apart[1], apart[2]));
        });
        for (std::size_t a = 0; a < 3; ++a) {
            if (bed.periodic[a]) continue;
            largest =
                std::max(largest, bed.radii[i] - std::min(bed.positions[i][a], bed.size[a] - bed.positions[i][a]));
        }
    }
    return largest;
}

/// A random packing: spheres thrown at random, then pushed apart pair by pair until overlaps are below a thousandth of
/// the diameter or 3000 rounds are over.  Loose up to a solid fraction of about 0.45, dense to about 0.62 (periodic) or
/// 0.58 (walls, which order the spheres beside them and leave gaps).  The same bits for the same settings.
inline packing make_packing(const packing_settings& settings) {
    hearth_test::seeded random(settings.seed);
    packing bed;
    bed.size = settings.size;
    bed.periodic = settings.periodic;
    const double box_volume = bed.size[0] * bed.size[1] * bed.size[2];
    double volume = 0;
    while (volume < settings.solid_fraction * box_volume) {
        const double r = 0.5 * (1 + random.uniform(-settings.spread, settings.spread));
        volume += 4.0 / 3.0 * 3.14159265358979323846 * r * r * r;
        bed.radii.push_back(r);
        point x{};
        for (std::size_t a = 0; a < 3; ++a) x[a] = random.uniform(0, bed.size[a]);
        bed.positions.push_back(x);
    }
    const double diameter = 1 + settings.spread;
    for (int round = 0; round < 3000; ++round) {
        const detail::sphere_bins bins(bed, diameter);
        double largest = 0;
        for (std::size_t i = 0; i < bed.positions.size(); ++i) {
            bins.for_each_near(i, [&](std::size_t j, const point&) {
                if (j < i) return;
                point apart{};  // anew: spheres move during the round
                for (std::size_t a = 0; a < 3; ++a) {
                    apart[a] = bed.positions[j][a] - bed.positions[i][a];
                    if (bed.periodic[a]) apart[a] -= bed.size[a] * std::round(apart[a] / bed.size[a]);
                }
                const double distance = std::hypot(apart[0], apart[1], apart[2]);
                const double overlap = bed.radii[i] + bed.radii[j] - distance;
                if (overlap <= 0 || distance == 0) return;
                largest = std::max(largest, overlap);
                for (std::size_t a = 0; a < 3; ++a) {
                    const double push = 0.5 * (overlap + 1e-4) * apart[a] / distance;
                    bed.positions[i][a] -= push;
                    bed.positions[j][a] += push;
                }
            });
            for (std::size_t a = 0; a < 3; ++a) {
                double& x = bed.positions[i][a];
                if (bed.periodic[a]) {
                    x -= bed.size[a] * std::floor(x / bed.size[a]);
                    if (x >= bed.size[a]) x = 0;  // a tiny negative x rounds up to the far side
                } else {
                    x = std::clamp(x, bed.radii[i], bed.size[a] - bed.radii[i]);
                }
            }
        }
        if (largest < 1e-3) break;
    }
    return bed;
}

/// Some spheres of a packing as one rank holds them, with their numbers in the whole as ids.
struct packing_share {
    packing_share(const packing& whole_, int rank, int ranks, std::uint64_t seed) : whole(&whole_) {
        hearth_test::seeded random(seed);
        for (std::size_t i = 0; i < whole_.radii.size(); ++i) {
            // The owner of a particle need not own the cells that it is in.
            if (static_cast<int>((i * 7919 + 13) % static_cast<std::size_t>(ranks)) == rank)
                ids.push_back(static_cast<std::int64_t>(i));
        }
        for (std::size_t k = ids.size(); k > 1; --k) std::swap(ids[k - 1], ids[random.index(k)]);
    }
    const packing* whole;
    std::vector<std::int64_t> ids;
};

}  // namespace hearth::test

template <>
struct hearth::particle_traits<hearth::test::packing_share> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = hearth::test::packing_share;

    static index particle_count(const cloud& c) { return static_cast<index>(c.ids.size()); }
    static std::int64_t global_index(const cloud& c, index i) { return c.ids[static_cast<std::size_t>(i)]; }
    static const point& get(quantity::position, const cloud& c, index i) {
        return c.whole->positions[static_cast<std::size_t>(global_index(c, i))];
    }
    static double get(quantity::radius, const cloud& c, index i) {
        return c.whole->radii[static_cast<std::size_t>(global_index(c, i))];
    }
};

template <>
struct hearth::particle_traits<hearth::test::packing> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = hearth::test::packing;

    static index particle_count(const cloud& bed) { return static_cast<index>(bed.positions.size()); }
    static const point& get(quantity::position, const cloud& bed, index i) {
        return bed.positions[static_cast<std::size_t>(i)];
    }
    static double get(quantity::radius, const cloud& bed, index i) { return bed.radii[static_cast<std::size_t>(i)]; }
};
