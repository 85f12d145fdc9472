// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <hearth/dem/bed.hpp>

#include "support/random.hpp"

/// A settled bed of spheres of 16 to 19.5 mm in a cylinder of 0.85 m, Hertz with history, skin of a tenth of a diameter.
namespace bench {

inline hearth::dem::bed empty_cylinder(const hearth::dem::decomposition& spread = {}) {
    using namespace hearth::dem;
    bed_settings s;
    s.step = 2.7e-5;
    s.contact.damping = 0.3;
    bed b(s, spread);
    wall w;
    w.contact = s.contact;
    w.facets = shape::plane({0, 0, 0}, {0, 0, 1});
    b.add_wall(w);
    w.facets = shape::cylinder({0, 0, -1}, {0, 0, 20}, 0.425);
    b.add_wall(w);
    return b;
}

/// 20 000 spheres, settled from a loose lattice.
inline hearth::dem::bed settled_layer() {
    using namespace hearth::dem;
    hearth_test::seeded random(1);
    std::vector<particle> balls;
    const double a = 0.0198;
    for (int k = 0; balls.size() < 20000; ++k) {
        for (int j = -30; j <= 30; ++j) {
            for (int i = -30; i <= 30 && balls.size() < 20000; ++i) {
                particle p;
                p.position = {(i + 0.5 * (k & 1)) * a, (j + 0.5 * (k & 1)) * a, 0.0105 + 0.72 * k * a};
                if (std::hypot(p.position.x, p.position.y) > 0.414) continue;
                p.velocity = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0};
                p.radius = 0.5 * random.uniform(0.016, 0.0195);
                p.density = 3580;
                balls.push_back(p);
            }
        }
    }
    bed b = empty_cylinder();
    b.insert(balls);
    b.advance(9000);
    return b;
}

/// Some of these layers on top of one another, that fall until they meet.
inline hearth::dem::bed stacked_layers(const hearth::dem::bed& one, int layers) {
    using namespace hearth::dem;
    const std::vector<sphere> spheres(one.spheres(), one.spheres() + one.size());
    std::vector<double> heights;
    for (const sphere& s : spheres) heights.push_back(s.centre.z);
    const auto top = heights.end() - static_cast<std::ptrdiff_t>(heights.size() / 200);  // what sticks out on top of a layer stays away
    std::nth_element(heights.begin(), top, heights.end());
    std::vector<particle> balls;
    for (int k = 0; k < layers; ++k) {
        for (const sphere& s : spheres) {
            if (s.centre.z > *top) continue;
            particle p;
            p.position = s.centre + vector3{0, 0, k * (*top + 0.012)};
            p.radius = s.radius;
            p.density = 3580;
            balls.push_back(p);
        }
    }
    bed b = empty_cylinder();
    b.insert(balls);
    return b;
}

/// The same after they have settled where they meet.
inline hearth::dem::bed settled_layers(const hearth::dem::bed& one, int layers) {
    hearth::dem::bed b = stacked_layers(one, layers);
    b.advance(9000);
    return b;
}

/// Root mean square speed [m/s].
inline double speed_of(const hearth::dem::bed& b) {
    double sum = 0;
    for (hearth::dem::index i = 0; i < b.size(); ++i) sum += dot(b.motions()[i].velocity, b.motions()[i].velocity);
    return std::sqrt(sum / b.size());
}

/// Share of the weight that floor and cylinder do not carry [-]: what is still falling, or braking.
inline double weight_not_carried(const hearth::dem::bed& b) {
    double weight = 0, carried = 0;
    for (hearth::dem::index i = 0; i < b.size(); ++i) weight -= b.mass(i) * b.settings().gravity.z;
    for (int w = 0; w < b.wall_count(); ++w) carried -= b.force_on_wall(w).z;
    return std::fabs(1 - carried / weight);
}

}  // namespace bench
