// SPDX-License-Identifier: MIT
#include <hearth/furnace/settings.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <type_traits>

#include <toml++/toml.h>

#include "describe.hpp"
#include "scene_reader.hpp"

namespace hearth::furnace {
namespace {

const std::vector<std::pair<std::string, std::pair<double wall_zone::*, range>>> zone_members{
    {"z_min_m", {&wall_zone::from, {-10, 100}}},
    {"z_max_m", {&wall_zone::to, {-10, 100}}},
    {"transmittance_W_per_m2K", {&wall_zone::transmittance, {0, 1000}}},
    {"ambient_temperature_K", {&wall_zone::ambient_temperature, {200, 2000}}}};
const std::vector<std::pair<std::string, std::pair<double size_class::*, range>>> size_members{
    {"diameter_mm", {&size_class::diameter, {0.1, 500, 1e-3}}}, {"mass_share", {&size_class::mass_share, {0, 1}}}};

void read_into(settings& scene, const toml::table& root, const origin& where) {
    scene_reader read(root, where);
    describe(scene, [&](auto table, auto name, auto& value, const range& allowed, const char*) {
        read.read(table, name, value, allowed);
    });
    read.read_list("wall.zone", scene.shaft.zones, zone_members);
    read.read_list("particles.size", scene.particles.sizes, size_members);
    read.refuse_unknown();
}

toml::table parse(const std::string& text, const origin& where) {
    try {
        return toml::parse(text, where);
    } catch (const toml::parse_error& error) {
        std::ostringstream out;
        out << where;
        if (where != "--set") out << ':' << error.source().begin.line;
        out << ": " << error.description();
        throw bad_scene(out.str());
    }
}

template <class Value>
std::string written(const Value& value, const range& allowed) {
    if constexpr (std::is_same_v<Value, bool>) {
        return value ? "true" : "false";
    } else if constexpr (std::is_same_v<Value, std::string>) {
        return '"' + value + '"';
    } else if constexpr (std::is_enum_v<Value>) {
        return '"' + std::string(names(Value{})[static_cast<std::size_t>(value)]) + '"';
    } else if constexpr (std::is_integral_v<Value>) {
        return std::to_string(value);
    } else {
        return format(static_cast<double>(value) / allowed.to_si);
    }
}

}  // namespace

settings parse_scene(const std::string& text, const origin& where) {
    settings scene;
    read_into(scene, parse(text, where), where);
    check(scene);
    return scene;
}

settings read_scene(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw bad_scene(path + ": cannot be opened: " + std::strerror(errno));
    std::ostringstream text;
    text << file.rdbuf();
    return parse_scene(text.str(), path);
}

namespace {

/// A word without quotes, as a shell leaves it, gets them.
std::string with_quotes(const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos) throw bad_scene("--set: " + assignment + " is not KEY=VALUE");
    const std::string value = assignment.substr(equals + 1);
    const bool is_word = std::all_of(value.begin(), value.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }) &&
                         !value.empty() && std::isalpha(static_cast<unsigned char>(value[0])) != 0;
    if (!is_word || value == "true" || value == "false" || value == "inf" || value == "nan") return assignment;
    return assignment.substr(0, equals + 1) + '"' + value + '"';
}

}  // namespace

void set_key(settings& scene, const std::string& assignment) {
    settings changed = scene;
    read_into(changed, parse(with_quotes(assignment), "--set"), "--set");
    check(changed);
    scene = changed;
}

void check(const settings& scene) {
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
    if (scene.bed.softened_modulus > scene.bed.modulus) {
        throw bad_scene("bed.softened_modulus_Pa is " + format(scene.bed.softened_modulus) + ", allowed: at most bed.modulus_Pa, " +
                        format(scene.bed.modulus));
    }
    if (scene.burners.equivalence_ratio > 1 && scene.physics.combustion != burning::equilibrium) {
        throw bad_scene("burners.equivalence_ratio is " + format(scene.burners.equivalence_ratio) +
                        ", allowed: at most 1, or physics.combustion = \"equilibrium\"");
    }
    if (!(scene.time.acceleration_factor > 0)) {
        throw bad_scene("time.acceleration_factor is " + format(scene.time.acceleration_factor) + ", allowed: above 0");
    }
}

std::string document(const settings& scene) {
    std::ostringstream out;
    std::string open;
    describe(scene, [&](std::string_view table, std::string_view name, const auto& value, const range& allowed, const char* meaning) {
        using value_type = std::decay_t<decltype(value)>;
        if (table != open) {
            open = table;
            out << "\n[" << open << "]\n";
        }
        out << name << " = " << written(value, allowed) << "  # " << meaning;
        if constexpr (std::is_enum_v<value_type>) {
            out << ':';
            for (const std::string_view word : names(value_type{})) out << ' ' << word;
        } else if constexpr (std::is_arithmetic_v<value_type> && !std::is_same_v<value_type, bool>) {
            out << ", " << format(allowed.from) << " to " << format(allowed.to);
        }
        out << '\n';
    });
    const auto list = [&](const char* path, const auto& items, const auto& members) {
        for (const auto& item : items) {
            out << "\n[[" << path << "]]\n";
            for (const auto& [name, member] : members) out << name << " = " << format(item.*member.first / member.second.to_si) << '\n';
        }
    };
    list("particles.size", scene.particles.sizes, size_members);
    list("wall.zone", scene.shaft.zones, zone_members);
    return out.str();
}

std::uint64_t hash(const settings& scene) {
    std::uint64_t value = 14695981039346656037U;
    for (const char c : document(scene)) value = (value ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return value;
}

}  // namespace hearth::furnace
