// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <hearth/gas/generate.hpp>

namespace hearth::gas {

namespace {

const double pi = std::acos(-1.0);

double radius(const shaft& s, double z) {
    for (std::size_t i = 1; i < s.profile.size(); ++i)
        if (z <= s.profile[i].z || i + 1 == s.profile.size()) {
            const auto &a = s.profile[i - 1], &b = s.profile[i];
            return a.radius + (b.radius - a.radius) * (z - a.z) / (b.z - a.z);
        }
    return s.profile.back().radius;
}

double axial_size(const shaft& s, double z) {
    if (z <= s.axial_size.front().z) return s.axial_size.front().size;
    for (std::size_t i = 1; i < s.axial_size.size(); ++i)
        if (z <= s.axial_size[i].z) {
            const auto &a = s.axial_size[i - 1], &b = s.axial_size[i];
            return a.size + (b.size - a.size) * (z - a.z) / (b.z - a.z);
        }
    return s.axial_size.back().size;
}

/// Adds levels after `from` up to `to`, so that each cell holds the same share of the integral of dz / size.
void fill_levels(array<double>& level, const shaft& s, double from, double to) {
    const int samples = 512;
    array<double> sum{0.0};
    for (int i = 0; i < samples; ++i)
        sum.push_back(sum.back() + (to - from) / samples / axial_size(s, from + (to - from) * (i + 0.5) / samples));
    const int cells = std::max(1, static_cast<int>(std::lround(sum.back())));
    int at = 0;
    for (int i = 1; i < cells; ++i) {
        const double target = sum.back() * i / cells;
        while (sum[at + 1] < target) ++at;
        level.push_back(from + (to - from) * (at + (target - sum[at]) / (sum[at + 1] - sum[at])) / samples);
    }
    level.push_back(to);
}

/// Angles of the mesh lines around the shaft, beginning at -45 degrees; a multiple of 4 in number.
array<double> angles(const shaft& s, double wall_radius) {
    array<double> angle;
    const double cell = s.cross_size / wall_radius;
    const int sectors = s.burners ? s.burner.count : 4;
    const double sector = 2 * pi / sectors;
    const double nozzle = s.burners ? std::sqrt(pi) / 2 * s.burner.diameter / wall_radius : 0;
    if (nozzle >= sector) throw std::invalid_argument("hearth::gas: shaft: the burners overlap");
    // Between two burners lines widen away from the edges; an even number keeps a line half way.
    const int between = s.burners ? std::max(2, 2 * static_cast<int>(std::lround((sector - nozzle) / cell / 2)))
                                  : std::max(2, static_cast<int>(std::lround(sector / cell)));
    const int across = s.burners ? std::max(1, static_cast<int>(std::lround(nozzle / cell))) : 0;
    const double free_angle = sector - nozzle;
    for (int k = 0; k < sectors; ++k) {
        const double middle = -pi / 4 + (k + 0.5) * sector;
        for (int i = 0; i < across; ++i) angle.push_back(middle - nozzle / 2 + nozzle * i / across);
        for (int i = 0; i < between; ++i) angle.push_back(middle + nozzle / 2 + free_angle * i / between);
    }
    // Rotate the list so that it begins with the line at -45 degrees (half way between two burners).
    array<double> out;
    const int shift = s.burners ? between / 2 : 0, n = static_cast<int>(angle.size());
    for (int i = 0; i < n; ++i) out.push_back(angle[(i + n - shift) % n] - (i < shift ? 2 * pi : 0));
    return out;
}

struct section {  // the cross section for radius 1
    array<vector3> points;
    array<std::array<int, 4>> quads;
    array<int> sector_of_quad;  // line number on the wall for the outermost ring, else -1
    array<double> angle;
    double swell = 1;  // corners of the wall polygon over the radius
};

section cross_section(const shaft& s, double wall_radius) {
    section out;
    out.angle = angles(s, wall_radius);
    const int around = static_cast<int>(out.angle.size()), side = around / 4;
    const double core = 0.55;  // half width of the core over the radius
    const int rings = std::max(2, static_cast<int>(std::lround((1 - core) * wall_radius / s.cross_size)));

    array<vector3> rim, wall;
    double polygon = 0;
    for (int i = 0; i < around; ++i) {
        const double a = out.angle[i], next = i + 1 < around ? out.angle[i + 1] : out.angle[0] + 2 * pi;
        polygon += 0.5 * std::sin(next - a);
        const vector3 direction{std::cos(a), std::sin(a), 0};
        // between a square and a circle, so that core cells stay close to squares and the corners open
        const double square = 1 / std::max(std::abs(direction.x), std::abs(direction.y));
        rim.push_back(core * (0.45 * square + 0.55) * direction);
        wall.push_back(direction);
    }
    out.swell = std::sqrt(pi / polygon);  // the polygon gets the area of the circle
    for (vector3& p : wall) p *= out.swell;

    // core: transfinite interpolation of the four quarters of the rim
    const auto core_point = [&](int i, int j) { return i + (side + 1) * j; };
    const auto at = [&](int i) { return rim[i % around]; };
    // quarter 0 (right side, angle -45..45): (side, j = 0..side); 1 top: (side..0, side); 2 left; 3 bottom
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i) {
            const double x = static_cast<double>(i) / side, y = static_cast<double>(j) / side;
            const vector3 right = at(j), top = at(2 * side - i), left = at(3 * side - j), bottom = at(3 * side + i);
            const vector3 corners = (1 - x) * (1 - y) * at(3 * side) + x * (1 - y) * at(0) + x * y * at(side) +
                                    (1 - x) * y * at(2 * side);
            out.points.push_back((1 - x) * left + x * right + (1 - y) * bottom + y * top - corners);
        }
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            out.quads.push_back({core_point(i, j), core_point(i + 1, j), core_point(i + 1, j + 1), core_point(i, j + 1)});
            out.sector_of_quad.push_back(-1);
        }
    const auto rim_point = [&](int i) {
        i %= around;
        if (i < side) return core_point(side, i);
        if (i < 2 * side) return core_point(2 * side - i, side);
        if (i < 3 * side) return core_point(0, 3 * side - i);
        return core_point(i - 3 * side, 0);
    };
    const array<double> step = graded(1.0, rings, s.wall_growth);
    const int ring_start = static_cast<int>(out.points.size());
    for (int r = 1; r <= rings; ++r)
        for (int i = 0; i < around; ++i) out.points.push_back((1 - step[r]) * rim[i] + step[r] * wall[i]);
    const auto ring_point = [&](int r, int i) {
        return r == 0 ? rim_point(i) : ring_start + (r - 1) * around + i % around;
    };
    for (int r = 0; r < rings; ++r)
        for (int i = 0; i < around; ++i) {
            // x side of the quad looks outward, so that side 1 (x+) is the wall
            out.quads.push_back({ring_point(r, i), ring_point(r + 1, i), ring_point(r + 1, i + 1), ring_point(r, i + 1)});
            out.sector_of_quad.push_back(r + 1 == rings ? i : -1);
        }
    return out;
}

void check(const shaft& s) {
    const auto require = [](bool good, const char* text) {
        if (!good) throw std::invalid_argument(std::string("hearth::gas: shaft: ") + text);
    };
    require(s.profile.size() >= 2 && !s.axial_size.empty(), "profile needs two heights, axial_size one");
    for (std::size_t i = 0; i < s.profile.size(); ++i) {
        require(s.profile[i].radius > 0, "every radius must be > 0");
        require(i == 0 || s.profile[i].z > s.profile[i - 1].z, "the heights of the profile must rise");
    }
    for (const auto& a : s.axial_size) require(a.size > 0, "every axial_size must be > 0");
    require(s.cross_size > 0 && s.wall_growth > 0, "cross_size and wall_growth must be > 0");
    require(!s.burners || (s.burner.count > 0 && s.burner.count % 4 == 0), "the number of burners must be a multiple of 4");
}

}  // namespace

polyhedra make(const shaft& s) {
    check(s);
    const double bottom = s.profile.front().z, top = s.profile.back().z;
    const double wall_radius = radius(s, s.burners ? s.burner.height : bottom);
    const section plane = cross_section(s, wall_radius);
    const int around = static_cast<int>(plane.angle.size());
    const auto width = [&](int i) { return (i + 1 < around ? plane.angle[i + 1] : plane.angle[0] + 2 * pi) - plane.angle[i]; };
    const auto middle = [&](int i) { return plane.angle[i] + width(i) / 2; };
    array<double> breaks;
    for (const auto& p : s.profile) breaks.push_back(p.z);
    // Half the height that gives columns of wall faces of this total chord the area of a round nozzle.
    const auto half_height = [&](double diameter, double chord, double z) {
        const double half = pi / 8 * diameter * diameter / (chord * plane.swell * radius(s, z));
        breaks.push_back(z - half);
        breaks.push_back(z + half);
        return half;
    };
    const auto burner_of = [&](int i) {  // number of the burner whose columns hold wall column i, or -1
        const double sector = 2 * pi / s.burner.count, from_first = middle(i) + pi / 4;
        const int n = static_cast<int>(std::floor(from_first / sector));
        const double nozzle = std::sqrt(pi) / 2 * s.burner.diameter / wall_radius;
        return std::abs(from_first - (n + 0.5) * sector) < nozzle / 2 ? n : -1;
    };
    double burner_half = 0, pipe_half = 0;
    if (s.burners) {
        double chord = 0;
        for (int i = 0; i < around; ++i)
            if (burner_of(i) == 0) chord += 2 * std::sin(width(i) / 2);
        burner_half = half_height(s.burner.diameter, chord, s.burner.height);
    }
    // The pipe: whole columns of wall faces around the x axis, about as wide as high.
    array<char> in_pipe(around, 0);
    if (s.outlet) {
        double chord = 0;
        for (int i = 0; i < around; ++i) {
            if (std::abs(std::remainder(middle(i), 2 * pi)) * radius(s, s.pipe.height) > std::sqrt(pi) / 4 * s.pipe.diameter) continue;
            in_pipe[i] = 1;
            chord += 2 * std::sin(width(i) / 2);
        }
        if (!(chord > 0)) throw std::invalid_argument("hearth::gas: shaft: no wall face is as narrow as the pipe");
        pipe_half = half_height(s.pipe.diameter, chord, s.pipe.height);
    }
    std::sort(breaks.begin(), breaks.end());
    array<double> level{bottom};
    for (const double b : breaks) {
        if (b < bottom || b > top) throw std::invalid_argument("hearth::gas: shaft: burners or pipe lie outside");
        if (b > level.back() + 1e-9 * (top - bottom)) fill_levels(level, s, level.back(), b);
    }

    array<vector3> points;
    for (const double z : level)
        for (const vector3& p : plane.points) points.push_back({radius(s, z) * p.x, radius(s, z) * p.y, z});
    const int layer_points = static_cast<int>(plane.points.size());
    const int layer_cells = static_cast<int>(plane.quads.size());
    const int layers = level.count() - 1;
    array<std::array<int, 8>> cells;
    for (int k = 0; k < layers; ++k)
        for (const auto& q : plane.quads) {
            const int low = k * layer_points, high = low + layer_points;
            cells.push_back({q[0] + low, q[1] + low, q[2] + low, q[3] + low, q[0] + high, q[1] + high, q[2] + high,
                             q[3] + high});
        }
    return from_hexahedra(std::move(points), cells, [&](int cell, int side) -> std::string {
        const int k = cell / layer_cells, i = plane.sector_of_quad[cell % layer_cells];
        if (side == 4) return "bottom";
        if (side == 5) return "top";
        const double z = 0.5 * (level[k] + level[k + 1]);
        if (s.burners && std::abs(z - s.burner.height) < burner_half && burner_of(i) >= 0)
            return "burner_" + std::to_string(burner_of(i));
        if (s.outlet && in_pipe[i] && std::abs(z - s.pipe.height) < pipe_half) return "outlet";
        return "wall";
    });
}

}  // namespace hearth::gas
