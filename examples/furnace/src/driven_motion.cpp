// SPDX-License-Identifier: MIT
#include "driven_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <hearth/furnace/shaft_profile.hpp>

#include "flat.hpp"
#include "packing.hpp"
#include "shaft_bed.hpp"
#include "shaft_gas.hpp"

namespace hearth::furnace {

namespace {

/// A plain value as the bytes that it is.
template <class Value>
std::vector<double> bits_of(const Value& value) {
    std::vector<char> bytes(sizeof(Value));
    std::memcpy(bytes.data(), &value, sizeof(Value));
    return to_numbers(bytes);
}
template <class Value>
Value value_of(const saved_state& from, const std::string& name) {
    const auto found = from.find(name);
    if (found == from.end()) throw bad_scene("the state lacks " + name);
    const std::vector<char> bytes = to_bytes(found->second);
    if (bytes.size() != sizeof(Value)) throw bad_scene("the state of " + name + " is damaged");
    Value value;
    std::memcpy(&value, bytes.data(), sizeof(Value));
    return value;
}

dem::feed feed_of(const settings& scene, double flow) {
    const double largest = sizes_of(scene).largest();
    dem::feed::settings f;
    f.where = {{0, 0, scene.shaft.height + 2.5 * largest}, 0.5 * scene.shaft.diameter, 6 * largest};
    f.mass_flow = flow;
    f.density = scene.particles.density;
    f.temperature = scene.particles.feed_temperature;
    f.velocity = {0, 0, -std::sqrt(2 * gravity_of_earth * weight_of(scene) * largest)};
    f.seed = scene.output.seed + 1;
    return {f, sizes_of(scene)};
}

dem::outflow outflow_of(const settings& scene, double flow) {
    dem::outflow::settings o;
    o.floor = floor_of_shaft;
    o.height = -0.5 * sizes_of(scene).largest();
    o.mass_flow = flow;
    return dem::outflow(o);
}

}  // namespace

double motion_acceleration(const settings& scene) {
    return scene.bed.motion == bed_motion::dem ? scene.time.acceleration_factor.value
                                               : scene.bed.recording_acceleration_factor;
}

driven_motion::driven_motion(const settings& scene, double void_fraction)
    : height_(scene.shaft.height),
      pace_(motion_acceleration(scene) * std::sqrt(weight_of(scene))),
      bed_over_solid_(weight_of(scene) / (1 - void_fraction)),
      feed_(feed_of(scene, scene.particles.mass_flow * pace_)),
      outflow_(outflow_of(scene, scene.particles.mass_flow * pace_)) {
    // The gas carries a part of the bed's weight, above the burners the most.
    settings measured = scene;
    measured.bed.void_fraction = void_fraction;
    const std::vector<double> pressure = solve_shaft_profile(measured).pressure;
    const double dz = height_ / static_cast<double>(pressure.size());
    lift_.assign(pressure.size(), 0.0);
    for (std::size_t k = 0; k < pressure.size(); ++k) {
        const std::size_t low = k > 0 ? k - 1 : 0, high = std::min(k + 1, pressure.size() - 1);
        lift_[k] = high > low ? (pressure[low] - pressure[high]) / (dz * static_cast<double>(high - low)) : 0.0;
    }
}

void driven_motion::set_mass_flow(double kg_per_s) {
    feed_.set_mass_flow(kg_per_s * pace_);
    outflow_.set_mass_flow(kg_per_s * pace_);
}

void driven_motion::push_by_gas(dem::bed& bed) const {
    constexpr double pi = 3.14159265358979323846;
    for (dem::index i = 0; i < bed.size(); ++i) {
        const dem::sphere& s = bed.spheres()[i];
        const double volume = 4.0 / 3.0 * pi * s.radius * s.radius * s.radius;
        const bool inside = s.centre.z < height_;
        bed.set_outer_force(i, {0, 0, inside ? bed_over_solid_ * volume * at_height(lift_, s.centre.z, height_) : 0.0});
    }
}

void driven_motion::advance(dem::bed& bed, int steps) {
    const double seconds = steps * bed.settings().step;
    push_by_gas(bed);
    bed.advance(steps);
    feed_.update(bed, seconds);
    outflow_.update(bed, seconds);
}

void driven_motion::save(saved_state& into, const std::string& folder) const {
    into[folder + "/feed"] = bits_of(feed_.now());
    into[folder + "/outflow"] = bits_of(outflow_.now());
}

void driven_motion::restore(const saved_state& from, const std::string& folder) {
    const auto fed = value_of<dem::feed::state>(from, folder + "/feed");
    outflow_.restore(value_of<dem::outflow::state>(from, folder + "/outflow"));
    feed_.restore(fed);
}

}  // namespace hearth::furnace
