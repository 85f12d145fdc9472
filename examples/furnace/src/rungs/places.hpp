// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <hearth/core/particle_traits.hpp>

#include "grains.hpp"

namespace hearth::furnace::rungs {

/// Where equal spheres lie: all that a gas wants to know of a bed that rests.
struct places {
    std::vector<dem::vector3> centre;  ///< [m]
    double radius;                     ///< [m]
};

}  // namespace hearth::furnace::rungs

template <>
struct hearth::particle_traits<hearth::furnace::rungs::places> {
    using index = std::size_t;
    using scalar = double;
    using cloud = hearth::furnace::rungs::places;
    static index particle_count(const cloud& c) { return c.centre.size(); }
    static dem::vector3 get(quantity::position, const cloud& c, index i) { return c.centre[i]; }
    static scalar get(quantity::radius, const cloud& c, index) { return c.radius; }
};
