// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <hearth/dem/feed.hpp>
#include <hearth/dem/moving_bed.hpp>
#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

/// Diameter with the surface per volume of all stones [m].
double sauter_diameter(const settings& scene);

/// The wall of the shaft as parcels see it; `top`: to which height.
dem::wall shaft_wall(const settings& scene, double top);
dem::material softened(const settings& scene);
dem::contact_settings contact_of(const settings& scene);

/// Parcels of the scene's stones.
dem::size_distribution sizes_of(const settings& scene);
dem::bed_settings bed_settings_of(const settings& scene);
/// What parcels see of one another and of the shaft, by the softened law of their motion.
dem::surroundings surroundings_of(const settings& scene);

/// A bed without DEM: equal parcels on a face-centred lattice, stretched to the scene's void fraction, that sinks as a plug.
/// The lattice leans a little, so that parcels leave one by one and not by layers.
std::unique_ptr<dem::moving_bed> lattice_bed(const settings& scene);

/// The same of parcels at random, of all sizes: see random_packing.hpp.
std::unique_ptr<dem::moving_bed> dense_bed(const settings& scene);

/// Of the bed and of what stands in the hopper: in a bed that sinks as a plug the hopper's stones follow on those of the shaft,
/// as if there were no free space between them [m].
double height_of_stones(const settings& scene);

/// A bed of these spheres that sinks as a plug or is frozen, as the scene says; centres within height_of_stones.
std::unique_ptr<dem::moving_bed> bed_of(const settings& scene, std::vector<dem::sphere> spheres, std::vector<double> masses);

}  // namespace hearth::furnace
