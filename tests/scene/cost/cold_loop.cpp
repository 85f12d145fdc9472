// SPDX-License-Identifier: MIT
// The cold bed by a scene and by hand, for the test that counts instructions and reads the object's symbols: absent
// physics must leave no trace.  Both keep the same ledger.
#include "scene/cost/cold_loop.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <hearth/closure/ergun.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/drag.hpp>

using namespace hearth;

template <>
struct hearth::particle_traits<cost::bed> {
    using index = std::ptrdiff_t;
    using scalar = double;
    static index particle_count(const cost::bed& b) { return b.count; }
    static double get(quantity::radius, const cost::bed& b, index i) { return b.radius[i]; }
    static const std::array<double, 3>& get(quantity::velocity, const cost::bed& b, index i) { return b.velocity[i]; }
    static void add(quantity::force, cost::bed& b, index i, const std::array<double, 3>& f) {
        for (std::size_t a = 0; a < 3; ++a) b.force[i][a] += f[a];
    }
};
template <>
struct hearth::particle_traits<cost::gas> {
    using index = std::ptrdiff_t;
    using scalar = double;
    static double get(quantity::void_fraction, const cost::gas& g, index i) { return g.void_fraction[i]; }
    static double get(quantity::gas_density, const cost::gas& g, index i) { return g.density[i]; }
    static double get(quantity::gas_viscosity, const cost::gas& g, index i) { return g.viscosity[i]; }
    static const std::array<double, 3>& get(quantity::gas_velocity, const cost::gas& g, index i) {
        return g.velocity[i];
    }
    static const std::array<double, 3>& get(quantity::pressure_gradient, const cost::gas& g, index i) {
        return g.pressure_gradient[i];
    }
    static void add(quantity::gas_force, cost::gas& g, index i, const std::array<double, 3>& f) {
        for (std::size_t a = 0; a < 3; ++a) g.force[i][a] += f[a];
    }
};

namespace cost {

void by_scene(bed& b, gas& g, std::array<double, 6>& ledger) {
    const auto books = scene{drag{closure::ergun{}}}.accumulate(b, g);
    for (std::size_t a = 0; a < 3; ++a) {
        ledger[a] = books[0].force_from_gas[a];
        ledger[3 + a] = books[0].force_from_pressure[a];
    }
}

void by_hand(bed& b, gas& g, std::array<double, 6>& ledger) {
    std::array<double, 6> sum{};
    for (std::ptrdiff_t i = 0; i < b.count; ++i) {
        std::array<double, 3> slip;
        for (std::size_t a = 0; a < 3; ++a) slip[a] = g.velocity[i][a] - b.velocity[i][a];
        const double speed = std::sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2]);
        const double d = 2.0 * b.radius[i], e = g.void_fraction[i], mu = g.viscosity[i];
        const double reynolds = g.density[i] * speed * d / mu;
        const double exchange = 150.0 * (1.0 - e) / e + 1.75 * reynolds;
        const double coefficient = 3.14159265358979323846 / 6.0 * exchange * mu * d;
        const double volume = 3.14159265358979323846 / 6.0 * d * d * d;
        const auto push = [&](std::size_t a) {
            const double f = coefficient * slip[a];
            const double pressure = -volume * g.pressure_gradient[i][a];
            b.force[i][a] += f + pressure;
            g.force[i][a] += -f;
            sum[a] += f;
            sum[3 + a] += pressure;
        };
        push(0);
        push(1);
        push(2);
    }
    ledger = sum;
}

}  // namespace cost
