// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/shaft_profile.hpp>

namespace hearth::furnace {

/// Gamma in a furnace whose gas is at rest with the bed at every instant.  Every exchange spans a piece of the
/// process's time, so Gamma cancels from heat: steady and transient temperatures are those of Gamma 1, bit for bit
/// where the bed moves as a plug.  It counts where stones move in the model's time, as DEM records or drives their
/// motion: there they are Gamma times too fast.

/// Speed of the stones at a Gamma over that at which a layer refills by gravity, sqrt(g d) with the diameter of a
/// parcel [-].
double motion_ratio(const settings& scene, double acceleration_factor);
/// Above this ratio the bed's motion is no longer quasi-static: a fifth is Gamma 120 of the paper's furnace, a third
/// 200.
constexpr double quasi_static_ratio = 0.2, acceptable_ratio = 1.0 / 3;

/// The scene's Gamma; of "auto" the largest whole one that keeps the motion quasi-static and the error of the heat, by
/// hearth::gamma_for with the bed of the profile, below time.acceleration_tolerance.
double acceleration_of(const settings& scene, const shaft_profile& profile);

/// What is to be said of a Gamma that the motion does not allow; empty: nothing.
std::string acceleration_warning(const settings& scene, double acceleration_factor);

}  // namespace hearth::furnace
