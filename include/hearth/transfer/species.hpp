// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <hearth/closure/evaporation.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth {

/// Drying: liquid water on a particle evaporates into the gas around, or condenses from it, at the rate of the gas film
/// (closure::evaporation) with the surface at the particle's temperature.  It is constant-rate drying: the surface
/// stays wet until the water is gone; the falling rate of porous grains is not modelled.
///
/// Sherwood: a closure with sherwood(void_fraction, reynolds, schmidt).  Paper: Eqs. 12 and 15.
///
/// The particle pays the latent heat, and the vapour takes its enthalpy at the particle's temperature to the gas.  Near
/// the boiling point the film gives way and heat sets the rate: step with drying_step (time/drying_step.hpp), which
/// finds it.
template <class Sherwood>
struct drying : Sherwood {
    constexpr explicit drying(Sherwood closure) : Sherwood(std::move(closure)) {}

    /// Molar mass of the gas without vapour [kg/mol]; air.
    double dry_gas_molar_mass = 0.028965;
    /// Of liquid water [J/(kg K)].
    double liquid_specific_heat = 4190.0;

    using reads = quantities<quantity::radius, quantity::velocity, quantity::temperature, quantity::moisture>;
    using writes = quantities<quantity::heat_rate, quantity::mass_rate>;
    using gas_reads = quantities<quantity::void_fraction, quantity::gas_density, quantity::gas_viscosity,
                                 quantity::gas_velocity, quantity::gas_temperature, quantity::gas_pressure,
                                 quantity::vapour_fraction, quantity::vapour_diffusivity>;
    using gas_writes = quantities<quantity::vapour_rate, quantity::vapour_enthalpy_rate>;
    static constexpr act acts = act::gas_mass;

    /// Enthalpy of liquid water above 273.15 K [J/kg].
    double liquid_enthalpy(double temperature) const {
        return liquid_specific_heat * (temperature - constants<double>::zero_celsius());
    }
    /// Enthalpy of vapour above liquid water at 273.15 K [J/kg].
    double vapour_enthalpy(double temperature) const {
        return liquid_enthalpy(temperature) + closure::water::latent_heat(temperature);
    }

    /// What the film does at a particle's place, with the temperature of the particle left open.
    struct film {
        closure::wet_sphere<double> sphere;
        double gas_temperature;
        /// Mass that leaves a wet particle of this temperature [kg/s]; < 0 for condensation.
        double rate(double temperature) const {
            closure::wet_sphere<double> at = sphere;
            at.film_temperature = 0.5 * (temperature + gas_temperature);
            at.surface_pressure = closure::water::saturation_pressure(temperature);
            return closure::evaporation::mass_rate(at);
        }
    };

    template <class Particle, class Gas, class Clock>
    film gas_film(const Particle& p, const Gas& g, const Clock& clock) const {
        const double diameter = 2.0 * static_cast<double>(p[quantity::radius{}]);
        const double void_fraction = static_cast<double>(g[quantity::void_fraction{}]);
        const double viscosity = static_cast<double>(g[quantity::gas_viscosity{}]);
        const double density = static_cast<double>(g[quantity::gas_density{}]);
        const double diffusivity = static_cast<double>(g[quantity::vapour_diffusivity{}]);
        const double pressure = static_cast<double>(g[quantity::gas_pressure{}]);
        const double superficial = void_fraction * detail::length(detail::slip_velocity(p, g, clock));
        const double sherwood = this->sherwood(void_fraction, density * superficial * diameter / viscosity,
                                               viscosity / (density * diffusivity));
        const double vapour = static_cast<double>(g[quantity::vapour_fraction{}]) / closure::water::molar_mass();
        const double dry = (1.0 - static_cast<double>(g[quantity::vapour_fraction{}])) / dry_gas_molar_mass;
        const double gas_temperature = static_cast<double>(g[quantity::gas_temperature{}]);
        return {{diameter, sherwood, diffusivity, gas_temperature, pressure, 0.0, pressure * vapour / (vapour + dry)},
                gas_temperature};
    }

    template <class Particle, class Gas, class Clock>
    vapour_exchange gas_mass(const Particle& p, const Gas& g, const Clock& clock) const {
        const double temperature = static_cast<double>(p[quantity::temperature{}]);
        const bool wet = static_cast<double>(p[quantity::moisture{}]) > 0.0;
        const double film_rate = gas_film(p, g, clock).rate(temperature);
        return {wet || film_rate < 0.0 ? film_rate : 0.0, closure::water::latent_heat(temperature),
                vapour_enthalpy(temperature)};
    }
};
template <class Sherwood>
drying(Sherwood) -> drying<Sherwood>;

}  // namespace hearth
