// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <hearth/dem/bed.hpp>
#include <hearth/dem/feed.hpp>

#include "rung_of.hpp"

/// What rungs do with beds of spheres.
namespace hearth::furnace::rungs {

/// A wall of the same stuff as the particles.
inline dem::wall wall_of(const dem::bed_settings& s, std::vector<dem::facet> facets, int patch, double friction) {
    dem::wall w;
    w.facets = std::move(facets);
    w.body = s.body;
    w.contact = s.contact;
    w.contact.friction = friction;
    w.patch = patch;
    return w;
}

/// Runs until particles move no faster than by a fall of a thousandth of their radius, or most_steps are over; tell(share)
/// now and then.  Returns whether they rest.
template <class Tell>
bool settle(dem::bed& b, int most_steps, Tell&& tell) {
    for (int k = 0; k < most_steps; k += 500) {
        b.advance(500);
        tell(static_cast<double>(k) / most_steps);
        double energy = 0, scale = 0;
        for (dem::index i = 0; i < b.size(); ++i) {
            energy += 0.5 * b.mass(i) * dot(b.motions()[i].velocity, b.motions()[i].velocity);
            scale += b.mass(i) * norm(b.settings().gravity) * b.spheres()[i].radius;
        }
        if (energy < 1e-3 * scale) return true;
    }
    return false;
}

/// Share of an upright cylinder that spheres fill, overlaps counted twice: each sphere by 512 points spread evenly in it.
inline double solid_fraction(const dem::bed& b, const dem::zone& where) {
    constexpr int points = 512;
    const auto inside = [&](const dem::vector3& x) {
        const double z = x.z - where.base.z;
        return z >= 0 && z < where.height && std::hypot(x.x - where.base.x, x.y - where.base.y) < where.radius;
    };
    double volume = 0;
    for (dem::index i = 0; i < b.size(); ++i) {
        const dem::sphere& s = b.spheres()[i];
        int count = 0;
        for (int k = 0; k < points; ++k) {  // Fibonacci's spiral on shells of equal volume
            const double share = (k + 0.5) / points, r = s.radius * std::cbrt(std::fmod(share * 89, 1.0));
            const double up = 1 - 2 * share, around = k * 2.39996322972865332, out = std::sqrt(1 - up * up);
            count += inside(s.centre + r * dem::vector3{out * std::cos(around), out * std::sin(around), up}) ? 1 : 0;
        }
        volume += 4.0 / 3.0 * pi * std::pow(s.radius, 3) * count / points;
    }
    return volume / (pi * where.radius * where.radius * where.height);
}

}  // namespace hearth::furnace::rungs
