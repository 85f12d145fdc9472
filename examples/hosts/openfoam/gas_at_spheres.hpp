// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <hearth/core/particle_traits.hpp>

namespace host {

using point = std::array<double, 3>;

/// What the OpenFOAM hosts share: the gas as each sphere sees it, and what it receives there.
struct gas_at_spheres {
    std::vector<double> density;
    double viscosity, conductivity, specific_heat;
    std::vector<double> void_fraction, temperature;
    std::vector<point> velocity;           // interstitial
    std::vector<point> pressure_gradient;  // empty where the host's gas pays it with the drag
    std::vector<point> force;
};

}  // namespace host

template <>
struct hearth::particle_traits<host::gas_at_spheres> {
    using index = std::size_t;
    using scalar = double;
    using gas = host::gas_at_spheres;
    static index particle_count(const gas& g) { return g.void_fraction.size(); }
    static double get(quantity::void_fraction, const gas& g, index i) { return g.void_fraction[i]; }
    static double get(quantity::gas_density, const gas& g, index i) { return g.density[i]; }
    static double get(quantity::gas_viscosity, const gas& g, index) { return g.viscosity; }
    static double get(quantity::gas_conductivity, const gas& g, index) { return g.conductivity; }
    static double get(quantity::gas_specific_heat, const gas& g, index) { return g.specific_heat; }
    static double get(quantity::gas_temperature, const gas& g, index i) { return g.temperature[i]; }
    static const host::point& get(quantity::gas_velocity, const gas& g, index i) { return g.velocity[i]; }
    static host::point get(quantity::pressure_gradient, const gas& g, index i) {
        return g.pressure_gradient.empty() ? host::point{} : g.pressure_gradient[i];
    }
    static void add(quantity::gas_force, gas& g, index i, const host::point& newtons) { g.force[i] = newtons; }
};
