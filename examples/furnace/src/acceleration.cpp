// SPDX-License-Identifier: MIT
#include "acceleration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include <hearth/furnace/spinel.hpp>
#include <hearth/time/tssm_error.hpp>

#include "mixture.hpp"
#include "packing.hpp"

namespace hearth::furnace {

namespace {

constexpr double pi = 3.14159265358979323846;

/// The bed as far as the error of splitting depends on it: its hottest stretch has the least gas, its whole height all
/// units.
tssm_bed bed_of(const settings& scene, const shaft_profile& profile) {
    const double e = scene.bed.void_fraction, section = pi / 4 * scene.shaft.diameter * scene.shaft.diameter;
    const double film = std::accumulate(profile.gas_temperature.begin(), profile.gas_temperature.end(), 0.0) /
                        static_cast<double>(profile.gas_temperature.size());
    const double h =
        std::accumulate(profile.heat_transfer_coefficient.begin(), profile.heat_transfer_coefficient.end(), 0.0) /
        static_cast<double>(profile.heat_transfer_coefficient.size());
    const auto gas = air();
    const double moles = combustion::sum(gas), density = scene.gas.pressure / (combustion::gas_constant * film * moles);
    const double heat_capacity = combustion::combine(gas).heat_capacity(film);
    const double flow = scene.air.volume_flow * 101325 / (combustion::gas_constant * 273.15 * moles) +
                        (scene.burners.count > 0 ? scene.burners.mass_flow : 0.0);  // [kg/s]
    const double surface = 6 * (1 - e) / sauter_diameter(scene);
    return {e * density * heat_capacity / ((1 - e) * scene.particles.density * spinel::specific_heat(film)),
            h * surface * scene.shaft.height * section / std::max(flow * heat_capacity, 1e-9)};
}

}  // namespace

double motion_ratio(const settings& scene, double acceleration_factor) {
    const double section = pi / 4 * scene.shaft.diameter * scene.shaft.diameter;
    const double speed =
        scene.particles.mass_flow / (scene.particles.density * (1 - scene.bed.void_fraction) * section);
    return acceleration_factor * speed / std::sqrt(9.81 * scene.bed.coarse_graining * sauter_diameter(scene));
}

double acceleration_of(const settings& scene, const shaft_profile& profile) {
    if (!scene.time.acceleration_factor.automatic) return scene.time.acceleration_factor;
    const double per_unit = motion_ratio(scene, 1);
    const double by_motion = per_unit > 0 ? std::floor(quasi_static_ratio / per_unit) : 1e4;
    const double by_heat =
        gamma_for(scene.time.acceleration_tolerance, gas_storage::quasi_steady, bed_of(scene, profile));
    return std::clamp(std::min(by_motion, by_heat), 1.0, 1e4);
}

std::string acceleration_warning(const settings& scene, double acceleration_factor) {
    const double ratio = motion_ratio(scene, acceleration_factor);
    if (!(ratio > acceptable_ratio)) return {};
    std::ostringstream text;
    text.precision(3);
    text << "time.acceleration_factor " << acceleration_factor << " moves the bed at " << ratio
         << " times the speed at which a layer refills by gravity; it is quasi-static up to Gamma "
         << std::max(1.0, std::floor(quasi_static_ratio / motion_ratio(scene, 1)));
    if (scene.bed.motion == bed_motion::plug) text << "; a bed that sinks as a plug does not feel it";
    if (scene.bed.motion == bed_motion::recorded)
        text << "; a bed that moves by a recording feels bed.recording_acceleration_factor instead";
    return text.str();
}

}  // namespace hearth::furnace
