// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>

#include <hearth/dem/bed.hpp>

namespace hearth_test {

using namespace hearth::dem;
constexpr double pi = hearth::constants<double>::pi();

inline bed_settings settings_of(double step, double damping, double friction, vector3 gravity = {}) {
    bed_settings s;
    s.step = step;
    s.gravity = gravity;
    s.contact.damping = damping;
    s.contact.friction = friction;
    return s;
}

inline wall floor_of(const bed_settings& s) {
    wall w;
    w.facets = shape::plane({0, 0, 0}, {0, 0, 1});
    w.body = s.body;
    w.contact = s.contact;
    return w;
}

inline particle ball(vector3 position, vector3 velocity, vector3 spin = {}, double radius = 0.01) {
    particle p;
    p.position = position;
    p.velocity = velocity;
    p.spin = spin;
    p.radius = radius;
    p.density = 3580;
    return p;
}

}  // namespace hearth_test
