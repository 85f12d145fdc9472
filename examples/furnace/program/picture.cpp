// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "picture_script.hpp"

extern char** environ;

namespace hearth::furnace::program {
namespace {

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return std::isfinite(value) ? text : "null";
}

template <class Values>
std::string list(const Values& values) {
    std::string out = "[";
    for (const double value : values) out += (out.size() == 1 ? "" : ",") + short_number(value);
    return out + "]";
}

/// A plane across one axis, and the two axes in it.
struct plane {
    std::size_t axis, first, second;
    double at;
};

/// The polygon in which the plane cuts a hexahedron: its edges' points of passage, in the order of their angle about the
/// middle; empty where it does not.
std::vector<double> cut(const plane& p, const cell_shapes& shapes, const std::array<std::int64_t, 8>& corners) {
    static constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    std::vector<std::array<double, 2>> points;
    for (const auto& edge : edges) {
        const auto& a = shapes.points[static_cast<std::size_t>(corners[static_cast<std::size_t>(edge[0])])];
        const auto& b = shapes.points[static_cast<std::size_t>(corners[static_cast<std::size_t>(edge[1])])];
        const double da = a[p.axis] - p.at, db = b[p.axis] - p.at;
        if ((da < 0) == (db < 0)) continue;
        const double share = da / (da - db);
        points.push_back({a[p.first] + share * (b[p.first] - a[p.first]), a[p.second] + share * (b[p.second] - a[p.second])});
    }
    if (points.size() < 3) return {};
    double middle[2] = {0, 0};
    for (const auto& x : points) {
        middle[0] += x[0] / static_cast<double>(points.size());
        middle[1] += x[1] / static_cast<double>(points.size());
    }
    const auto angle = [&](const auto& x) { return std::atan2(x[1] - middle[1], x[0] - middle[0]); };
    std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
    std::vector<double> polygon;
    for (const auto& x : points) polygon.insert(polygon.end(), x.begin(), x.end());
    return polygon;
}

std::string cut_of(const plane& p, const cell_shapes& shapes, const snapshot& seen) {
    std::string polygons, gas, discs, particles;
    const auto append = [](std::string& to, const std::string& item) { to += (to.empty() ? "" : ",") + item; };
    for (std::size_t c = 0; c < shapes.cells.size(); ++c) {
        const auto polygon = cut(p, shapes, shapes.cells[c]);
        if (polygon.empty()) continue;
        append(polygons, list(polygon));
        append(gas, seen.gas_temperature.empty() ? "null" : short_number(seen.gas_temperature[c]));
    }
    for (std::size_t i = 0; i < seen.particle_position.size() && i < seen.particle_radius.size(); ++i) {
        const auto& x = seen.particle_position[i];
        const double off = x[p.axis] - p.at, radius = seen.particle_radius[i];
        if (!(std::abs(off) < radius)) continue;
        append(discs, list(std::array<double, 3>{x[p.first], x[p.second], std::sqrt(radius * radius - off * off)}));
        append(particles, seen.particle_temperature.empty() ? "null" : short_number(seen.particle_temperature[i]));
    }
    return "{\"cells\": [" + polygons + "], \"gas_temperature_K\": [" + gas + "], \"particles\": [" + discs +
           "], \"particle_temperature_K\": [" + particles + "]}";
}

}  // namespace

std::string picture_data(const furnace& shaft, const snapshot& seen) {
    const cell_shapes shapes = shaft.cells();
    const settings& scene = shaft.scene();
    // A hair off the middle, where the faces of a symmetric mesh lie.
    const plane vertical{1, 0, 2, 1e-6 * scene.shaft.diameter};
    const plane burners{2, 0, 1, scene.burners.height + 1e-6 * scene.shaft.height};
    std::string title;
    for (const char c : scene.title) title += c == '"' || c == '\\' ? '\'' : c;
    return "{\"title\": \"" + title + "\",\n\"diameter_m\": " + short_number(scene.shaft.diameter) +
           ", \"height_m\": " + short_number(scene.shaft.height) + ", \"burner_height_m\": " + short_number(scene.burners.height) +
           ", \"burners\": " + std::to_string(scene.burners.count) +
           ",\n\"vertical\": " + cut_of(vertical, shapes, seen) + ",\n\"burner_plane\": " + cut_of(burners, shapes, seen) + "}\n";
}

std::string picture_script() { return script; }

bool draw(const std::string& folder, std::string& reason) {
    std::string path = (std::filesystem::path(folder) / "picture.py").string();
    posix_spawn_file_actions_t silence;  // what Python says of a missing module is said below, shorter
    posix_spawn_file_actions_init(&silence);
    posix_spawn_file_actions_addopen(&silence, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    bool drawn = false;
    reason = "there is no python3";
    // The system's Python has Debian's matplotlib, whatever else comes first in the path.
    for (std::string python : {"python3", "/usr/bin/python3"}) {
        char* const arguments[] = {python.data(), path.data(), nullptr};
        pid_t child = 0;
        if (posix_spawnp(&child, python.c_str(), &silence, nullptr, arguments, environ) != 0) continue;
        int status = 0;
        waitpid(child, &status, 0);
        drawn = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        if (drawn) break;
        reason = "python3 cannot draw " + path + " (is python3-matplotlib there?)";
    }
    posix_spawn_file_actions_destroy(&silence);
    return drawn;
}

}  // namespace hearth::furnace::program
