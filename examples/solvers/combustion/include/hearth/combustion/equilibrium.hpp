// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/combustion/species.hpp>

namespace hearth::combustion {

/// A mixture and its temperature.
struct mixture_state {
    per_species amount;  ///< [mol/kg]
    double temperature;  ///< [K]
};

/// Mixed is burnt: fuel, CO and H2 burn to CO2 and H2O at once, each to the same share where oxygen is short.
/// Enthalpy [J/kg] and elements stay.  Throws bad_value where an amount is negative or not finite, or no temperature
/// has the enthalpy; so do the functions below.
mixture_state burn(const per_species& amount, double enthalpy);

/// Chemical equilibrium of the seven species, at an enthalpy [J/kg] and a pressure [Pa], with the elements of `amount`.
/// It is where the reversible mechanism ends, but for methane, which the mechanism consumes for good.  No radicals: at
/// the stoichiometric flame temperature it is 20 K hotter than the full equilibrium.
///
/// Three nested scalar equations, each monotone, each solved by Newton within a bracket: the temperature at the given
/// enthalpy; the partial pressure of oxygen at the given temperature, which fixes CO2/CO and H2O/H2; the methane at the
/// given partial pressure.  So it needs no good start and converges for every mixture, absent elements included.
/// Elements are kept to round-off.
mixture_state equilibrium(const per_species& amount, double enthalpy, double pressure,
                          double temperature_guess = 2000.0);

/// The same at a given temperature [K].
per_species equilibrium_at(const per_species& amount, double temperature, double pressure);

}  // namespace hearth::combustion
