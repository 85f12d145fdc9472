// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <hearth/dem/vector3.hpp>

namespace hearth::dem {

using index = std::int32_t;

/// What the search for contacts reads: half a cache line.
struct alignas(32) sphere {
    vector3 centre;
    double radius = 0;
};

/// What the contact force and the motion read: one cache line.
struct alignas(64) motion {
    vector3 velocity;           ///< [m/s]
    double inverse_mass = 0;    ///< [1/kg]; negative: the particle keeps its velocity whatever pushes it
    vector3 spin;               ///< [rad/s]
    double inverse_inertia = 0; ///< [1/(kg m^2)]
};

/// What pushes a particle: one cache line.
struct alignas(64) load {
    vector3 force;   ///< [N]
    double unused_1 = 0;
    vector3 torque;  ///< [N m]
    double unused_2 = 0;
};

/// What the last known acceleration adds to velocity and spin in half a step.  Motion is half a step behind positions when
/// forces are computed; dashpots make up for it with this, and are of second order.
struct lead {
    float velocity[3] = {0, 0, 0};  ///< [m/s]
    float spin[3] = {0, 0, 0};      ///< [rad/s]
};

/// A particle as a user gives it.
struct particle {
    vector3 position;
    vector3 velocity{};
    double radius = 0;
    double density = 0;      ///< [kg/m^3]
    vector3 spin{};
    double temperature = 300;  ///< [K]
};

}  // namespace hearth::dem
