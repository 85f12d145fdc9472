// SPDX-License-Identifier: MIT
#include <hearth/furnace/settings.hpp>

#include <algorithm>
#include <cmath>

#include "describe.hpp"
#include "scene_text.hpp"

namespace hearth::furnace {

settings parse_scene(const std::string& text, const origin& where) {
    settings scene;
    read_into(scene, parse_toml(text, where), where);
    check(scene);
    return scene;
}

settings read_scene(const std::string& path) { return parse_scene(read_text(path), path); }

void set_keys(settings& scene, const std::vector<std::string>& assignments) { assign(scene, assignments); }

void check(const settings& scene) {
    describe(scene, overloaded{[](std::string_view table, std::string_view name, const auto& value, const range& allowed, const char*) {
                                   using value_type = std::decay_t<decltype(value)>;
                                   if constexpr (std::is_convertible_v<value_type, double> && !std::is_same_v<value_type, bool>) {
                                       const double given = static_cast<double>(value) / allowed.to_si;
                                       const double slack = 1e-12 * std::abs(given);  // of units
                                       if (given >= allowed.from - slack && given <= allowed.to + slack) return;
                                       throw bad_scene(path_of(table, name) + " is " + format(given) + ", allowed: " + format(allowed.from) +
                                                       " to " + format(allowed.to));
                                   }
                               },
                               [](const char*, const auto&, const auto&) {}});
    if (!(scene.air.volume_flow > 0)) throw bad_scene("air.volume_flow_Nm3_per_h is 0, allowed: above 0, so that gas passes the whole bed");
    double share = 0;
    for (const size_class& size : scene.particles.sizes) share += size.mass_share;
    if (std::abs(share - 1) > 1e-6) throw bad_scene("particles.size: the mass shares sum to " + format(share) + ", allowed: 1");
    for (const size_class& size : scene.particles.sizes) {
        if (size.diameter > scene.shaft.diameter / 4) {
            throw bad_scene("particles.size.diameter_mm is " + format(size.diameter * 1e3) + ", allowed: at most a quarter of the shaft, " +
                            format(scene.shaft.diameter * 250));
        }
    }
    std::vector<wall_zone> zones = scene.shaft.zones;
    std::sort(zones.begin(), zones.end(), [](const wall_zone& a, const wall_zone& b) { return a.from < b.from; });
    for (std::size_t k = 0; k < zones.size(); ++k) {
        if (!(zones[k].to > zones[k].from)) {
            throw bad_scene("wall.zone.z_max_m is " + format(zones[k].to) + ", allowed: above z_min_m, " + format(zones[k].from));
        }
        if (k > 0 && zones[k].from < zones[k - 1].to) {
            throw bad_scene("wall.zone: zones from " + format(zones[k - 1].from) + " m and from " + format(zones[k].from) + " m overlap");
        }
    }
    if (scene.burners.count > 0 && scene.burners.height + scene.burners.diameter / 2 > scene.shaft.height) {
        throw bad_scene("burners.height_m is " + format(scene.burners.height) + ", allowed: below the top of the shaft, " +
                        format(scene.shaft.height));
    }
    const bool recorded = scene.bed.motion == bed_motion::recorded, by_dem = recorded || scene.bed.motion == bed_motion::dem;
    const std::string motion = std::string("bed.motion is \"") + (recorded ? "recorded" : "dem") + "\"";
    if (by_dem && scene.bed.packing != bed_packing::dem) {
        throw bad_scene(motion + ", allowed with bed.packing = \"dem\": " +
                        (recorded ? "there is nothing to record of what DEM has not packed" : "DEM moves what it has packed"));
    }
    if (by_dem && !(scene.particles.mass_flow > 0)) {
        throw bad_scene(motion + ", allowed where particles.mass_flow_kg_per_h is above 0");
    }
    if (scene.shaft.hopper_fill > 0 && (scene.shaft.hopper_height <= 0 || scene.bed.motion != bed_motion::plug)) {
        throw bad_scene("shaft.hopper_fill_m is " + format(scene.shaft.hopper_fill) +
                        ", allowed with bed.motion = \"plug\" and shaft.hopper_height_m above 0: what sinks in the hopper sinks as one with the shaft's bed");
    }
    if (scene.bed.softened_modulus > scene.bed.modulus) {
        throw bad_scene("bed.softened_modulus_Pa is " + format(scene.bed.softened_modulus) + ", allowed: at most bed.modulus_Pa, " +
                        format(scene.bed.modulus));
    }
    if (scene.burners.equivalence_ratio > 1 && scene.physics.combustion == burning::mixed_is_burnt) {
        throw bad_scene("burners.equivalence_ratio is " + format(scene.burners.equivalence_ratio) +
                        ", allowed: at most 1, or physics.combustion = \"equilibrium\" or \"jones_lindstedt\"");
    }
}

std::string document(const settings& scene) { return document_of(scene); }

std::uint64_t hash(const settings& scene) { return hash_of(document(scene)); }

}  // namespace hearth::furnace
