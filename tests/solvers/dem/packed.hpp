// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <hearth/dem/feed.hpp>

namespace hearth_test {

using hearth::dem::bed;
using hearth::dem::bed_settings;
using hearth::dem::vector3;
using hearth::dem::wall;
using hearth::dem::zone;

/// A soft granulate that settles in few steps: 2 % overlap at an impact of 0.5 m/s, a hundredth of it at rest.
inline bed_settings soft_settings(double friction, double damping) {
    bed_settings s;
    s.step = 8e-5;
    s.body.youngs_modulus = 3.77e7;
    s.contact.friction = friction;
    s.contact.damping = damping;
    return s;
}

inline wall wall_of(const bed_settings& s, std::vector<hearth::dem::facet> facets, int patch = 0) {
    wall w;
    w.facets = std::move(facets);
    w.body = s.body;
    w.contact = s.contact;
    w.patch = patch;
    return w;
}

/// An upright tube that stands on a plane; the floor is wall 0.
inline bed tube_on_floor(const bed_settings& s, double radius, double height) {
    bed b(s);
    b.add_wall(wall_of(s, hearth::dem::shape::plane({0, 0, 0}, {0, 0, 1}), 0));
    b.add_wall(wall_of(s, hearth::dem::shape::cylinder({0, 0, -1}, {0, 0, height}, radius), 1));
    return b;
}

inline hearth::dem::feed feed_into(const zone& where, double density, double smallest, double largest, double flow = 0) {
    hearth::dem::feed::settings f;
    f.where = where;
    f.density = density;
    f.mass_flow = flow;
    f.velocity = {0, 0, -1};
    std::vector<hearth::dem::size_distribution::point> sizes{{smallest, 0.0}, {largest, 1.0}};
    if (smallest == largest) sizes = {{largest, 1.0}};
    return hearth::dem::feed(f, hearth::dem::size_distribution(sizes));
}

/// The mean kinetic energy of a particle is below that of a fall by a thousandth of its radius.
inline bool at_rest(const bed& b) {
    double energy = 0, scale = 0;
    for (hearth::dem::index i = 0; i < b.size(); ++i) {
        energy += 0.5 * b.mass(i) * dot(b.motions()[i].velocity, b.motions()[i].velocity);
        scale += b.mass(i) * norm(b.settings().gravity) * b.spheres()[i].radius;
    }
    return energy < 1e-3 * scale;
}

inline void settle(bed& b, int most_steps) {
    for (int k = 0; k < most_steps; k += 500) {
        b.advance(500);
        if (at_rest(b)) return;
    }
}

/// Share of the points of a fine lattice in a zone, between two radii, that lie in spheres.
inline double solid_fraction(const bed& b, const zone& where, double inner_radius = 0) {
    const double spacing = where.radius / 40;
    const auto nx = static_cast<std::ptrdiff_t>(2 * where.radius / spacing);
    const auto nz = static_cast<std::ptrdiff_t>(where.height / spacing);
    std::vector<char> solid(static_cast<std::size_t>(nx * nx * nz), 0);
    const vector3 corner = where.base - vector3{where.radius, where.radius, 0};
    const auto coordinate = [&](std::ptrdiff_t k, int a) { return corner[a] + (static_cast<double>(k) + 0.5) * spacing; };
    for (hearth::dem::index i = 0; i < b.size(); ++i) {
        const auto& s = b.spheres()[i];
        const auto from = [&](int a) {
            return std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(std::floor((s.centre[a] - s.radius - corner[a]) / spacing)));
        };
        const auto to = [&](int a, std::ptrdiff_t n) {
            return std::min<std::ptrdiff_t>(n, static_cast<std::ptrdiff_t>(std::floor((s.centre[a] + s.radius - corner[a]) / spacing)) + 1);
        };
        for (auto z = from(2); z < to(2, nz); ++z)
            for (auto y = from(1); y < to(1, nx); ++y)
                for (auto x = from(0); x < to(0, nx); ++x) {
                    const vector3 d = vector3{coordinate(x, 0), coordinate(y, 1), coordinate(z, 2)} - s.centre;
                    if (dot(d, d) < s.radius * s.radius) solid[static_cast<std::size_t>((z * nx + y) * nx + x)] = 1;
                }
    }
    double inside = 0, filled = 0;
    for (std::ptrdiff_t z = 0; z < nz; ++z)
        for (std::ptrdiff_t y = 0; y < nx; ++y)
            for (std::ptrdiff_t x = 0; x < nx; ++x) {
                const double r = std::hypot(coordinate(x, 0) - where.base.x, coordinate(y, 1) - where.base.y);
                if (r >= where.radius || r < inner_radius) continue;
                inside += 1;
                filled += solid[static_cast<std::size_t>((z * nx + y) * nx + x)];
            }
    return filled / inside;
}

/// Mean number of contacts of the particles whose centres lie in a zone.
inline double coordination(const bed& b, const zone& where) {
    const auto counts = b.contact_counts();
    double sum = 0, number = 0;
    for (hearth::dem::index i = 0; i < b.size(); ++i) {
        const vector3 d = b.spheres()[i].centre - where.base;
        if (std::hypot(d.x, d.y) > where.radius || d.z < 0 || d.z > where.height) continue;
        sum += counts[static_cast<std::size_t>(i)];
        number += 1;
    }
    return sum / number;
}

}  // namespace hearth_test
