// SPDX-License-Identifier: MIT
#pragma once

/// Tags by which hearth asks a host for particle data.  A tag is the one place where symbol and unit are written down.
namespace hearth::quantity {

#define HEARTH_QUANTITY_TAG(tag, symbol_text, unit_text)          \
    struct tag {                                                  \
        static constexpr const char* name = #tag;                 \
        static constexpr const char* symbol = symbol_text;        \
        static constexpr const char* unit = unit_text;            \
    }

// State that a host holds.
HEARTH_QUANTITY_TAG(position, "x", "m");                     ///< three components
HEARTH_QUANTITY_TAG(velocity, "v", "m/s");                   ///< three components, of the accelerated motion
HEARTH_QUANTITY_TAG(radius, "R", "m");
HEARTH_QUANTITY_TAG(mass, "m", "kg");
HEARTH_QUANTITY_TAG(temperature, "T", "K");
HEARTH_QUANTITY_TAG(specific_heat, "c_p", "J/(kg K)");       ///< at the particle's temperature
HEARTH_QUANTITY_TAG(conductivity, "k", "W/(m K)");
HEARTH_QUANTITY_TAG(emissivity, "e", "-");
HEARTH_QUANTITY_TAG(moisture, "m_w", "kg");                  ///< liquid water that a particle holds
HEARTH_QUANTITY_TAG(acceleration_factor, "Gamma", "-");      ///< Gamma of one particle, 1 in free flight

// Rates that terms add to.  Positive into the particle.
HEARTH_QUANTITY_TAG(heat_rate, "Q", "W");
HEARTH_QUANTITY_TAG(force, "F", "N");                        ///< three components
HEARTH_QUANTITY_TAG(mass_rate, "dm/dt", "kg/s");

// The gas as the particles see it, a value per particle: the transfer operator's gather makes it.
HEARTH_QUANTITY_TAG(void_fraction, "e", "-");
HEARTH_QUANTITY_TAG(gas_density, "rho", "kg/m^3");
HEARTH_QUANTITY_TAG(gas_viscosity, "mu", "Pa s");
HEARTH_QUANTITY_TAG(gas_conductivity, "k_g", "W/(m K)");
HEARTH_QUANTITY_TAG(gas_specific_heat, "c_g", "J/(kg K)");
HEARTH_QUANTITY_TAG(gas_temperature, "T_g", "K");
HEARTH_QUANTITY_TAG(gas_velocity, "u", "m/s");               ///< three components, interstitial
HEARTH_QUANTITY_TAG(gas_pressure, "p", "Pa");                ///< absolute
HEARTH_QUANTITY_TAG(pressure_gradient, "grad p", "Pa/m");    ///< three components
HEARTH_QUANTITY_TAG(vapour_fraction, "Y", "-");              ///< mass fraction of water vapour
HEARTH_QUANTITY_TAG(vapour_diffusivity, "D", "m^2/s");       ///< of water vapour in the gas

// Rates that the gas receives at a particle.  Positive into the gas; the transfer operator's scatter spreads them.
HEARTH_QUANTITY_TAG(gas_heat_rate, "Q_g", "W");
HEARTH_QUANTITY_TAG(gas_force, "F_g", "N");                  ///< three components
HEARTH_QUANTITY_TAG(vapour_rate, "dm_v/dt", "kg/s");
HEARTH_QUANTITY_TAG(vapour_enthalpy_rate, "dH_v/dt", "W");   ///< what the vapour carries, above liquid water at 273.15 K

#undef HEARTH_QUANTITY_TAG

}  // namespace hearth::quantity

namespace hearth {

/// A set of quantity tags: what a term reads or writes.
template <class... Tags>
struct quantities {};

}  // namespace hearth
