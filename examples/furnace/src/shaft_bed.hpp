// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <hearth/core/reproducible_sum.hpp>
#include <hearth/dem/bed.hpp>
#include <hearth/furnace/ranks.hpp>
#include <hearth/furnace/settings.hpp>

/// The parcels of a shaft as DEM has them.  Centres lie between the ends of the shaft: the floor is a largest radius
/// below it, so that the bed is cut through there as it is at the top, and not laid flat.  Ranks share them in slabs,
/// and have the bits of one rank.
namespace hearth::furnace {

constexpr int floor_of_shaft = 0;  ///< number of that wall

/// Floor and wall, and no parcels yet.
dem::bed empty_shaft(const settings& scene, const ranks& among);

/// Gravity over that of the earth [-].  A bed that is softer than the paper's falls and moves as the stiff one does
/// under its full weight, by the same numbers of Froude, v^2 / (g d), and of stiffness, E / (rho g H): gravity is less,
/// and speed by its root.
double weight_of(const settings& scene);
constexpr double gravity_of_earth = 9.81;  ///< [m/s^2]
void set_weight(dem::bed& bed, double weight);

struct parcel_of_shaft {
    std::int64_t id;
    dem::sphere where;
    double mass;
};
/// Those of all ranks, by their ids, on every rank.
std::vector<parcel_of_shaft> all_parcels(const dem::bed& bed, const ranks& among);

/// Into a bed with walls and gravity as they were.  `parts`: those of the ranks that saved it, as to_numbers makes
/// them, one behind the other; dealt out to the ranks that there are.  Throws bad_scene or dem::state_error.
void restore_parts(dem::bed& bed, const std::vector<double>& parts, const ranks& among);

/// Sum over the parcels of all ranks, the same bits on any number of them.
template <class Term>
double sum_over(const dem::bed& bed, Term&& term) {
    double largest = 0;
    for (dem::index i = 0; i < bed.size(); ++i) largest = std::fmax(largest, std::fabs(term(i)));
    reproducible_sum total(bed.among().max(largest), std::int64_t{1} << 36);
    for (dem::index i = 0; i < bed.size(); ++i) total.add(term(i));
    bed.among().sum(total.limbs(), reproducible_sum::limb_count());
    return total.value();
}

}  // namespace hearth::furnace
