// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <hearth/core/particle_traits.hpp>
#include <hearth/gas/solver.hpp>

namespace hearth::furnace {

/// The gas as each particle sees it: what the transfer operator gathers from the cells.
struct gas_at_particles {
    std::vector<double> temperature, void_fraction, density, viscosity, conductivity, specific_heat;
    std::vector<std::array<double, 3>> velocity;  ///< interstitial [m/s]

    template <class Transfer>
    void gather(const gas::solver& gas, Transfer& transfer, std::size_t particles) {
        for (auto* field : {&temperature, &void_fraction, &density, &viscosity, &conductivity, &specific_heat}) field->resize(particles);
        velocity.resize(particles);
        std::vector<std::array<double, 3>> interstitial(gas.gas.density.size());
        for (std::size_t c = 0; c < interstitial.size(); ++c) {
            const auto& u = gas.gas.flow.velocity[c];
            const double e = gas.bed.void_fraction[c];
            interstitial[c] = {u.x / e, u.y / e, u.z / e};
        }
        transfer.gather(std::tie(gas.gas.temperature, gas.bed.void_fraction, gas.gas.density, gas.gas.viscosity, gas.gas.conductivity,
                                 gas.gas.specific_heat, interstitial),
                        std::tie(temperature, void_fraction, density, viscosity, conductivity, specific_heat, velocity));
    }
};

}  // namespace hearth::furnace

template <>
struct hearth::particle_traits<hearth::furnace::gas_at_particles> {
    using index = std::int32_t;
    using scalar = double;
    using host = furnace::gas_at_particles;
    static index particle_count(const host& g) { return static_cast<index>(g.temperature.size()); }
    static scalar get(quantity::gas_temperature, const host& g, index i) { return g.temperature[static_cast<std::size_t>(i)]; }
    static scalar get(quantity::void_fraction, const host& g, index i) { return g.void_fraction[static_cast<std::size_t>(i)]; }
    static scalar get(quantity::gas_density, const host& g, index i) { return g.density[static_cast<std::size_t>(i)]; }
    static scalar get(quantity::gas_viscosity, const host& g, index i) { return g.viscosity[static_cast<std::size_t>(i)]; }
    static scalar get(quantity::gas_conductivity, const host& g, index i) { return g.conductivity[static_cast<std::size_t>(i)]; }
    static scalar get(quantity::gas_specific_heat, const host& g, index i) { return g.specific_heat[static_cast<std::size_t>(i)]; }
    static const std::array<double, 3>& get(quantity::gas_velocity, const host& g, index i) {
        return g.velocity[static_cast<std::size_t>(i)];
    }
};
