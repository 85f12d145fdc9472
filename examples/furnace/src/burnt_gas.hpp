// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <hearth/closure/air.hpp>
#include <hearth/combustion/thermo.hpp>
#include <hearth/gas/model.hpp>

namespace hearth::furnace {

/// A mixture of two streams, burnt where it is mixed: all fuel that finds oxygen is CO2 and H2O (complete combustion).
/// The two mass fractions are those of the streams, so elements are kept whatever burns, and no source term is needed: the
/// heat of combustion is in the enthalpy of the burnt mixture.  Transport properties are those of air (+-10 %).
class burnt_gas final : public gas::gas_model {
  public:
    /// Streams by amounts of their species [mol/kg], before they burn.
    burnt_gas(const combustion::per_species& first, const combustion::per_species& second) : streams_{first, second} {}

    /// Amounts of the burnt mixture [mol/kg].
    combustion::per_species burnt(const double* mass_fraction) const {
        combustion::per_species n{};
        for (std::size_t k = 0; k < combustion::species_count; ++k) {
            n[k] = mass_fraction[0] * streams_[0][k] + mass_fraction[1] * streams_[1][k];
        }
        const double fuel = std::max(0.0, std::min(n[combustion::CH4], 0.5 * n[combustion::O2]));
        n[combustion::CH4] -= fuel;
        n[combustion::O2] -= 2 * fuel;
        n[combustion::CO2] += fuel;
        n[combustion::H2O] += 2 * fuel;
        return n;
    }

    int species_count() const override { return 2; }
    double density(double pressure, double temperature, const double* y) const override {
        return pressure / (combustion::gas_constant * temperature * combustion::sum(burnt(y)));
    }
    double enthalpy(double temperature, const double* y) const override {
        return combustion::combine(burnt(y)).enthalpy(temperature);
    }
    double specific_heat(double temperature, const double* y) const override {
        return combustion::combine(burnt(y)).heat_capacity(temperature);
    }
    double viscosity(double t, const double*) const override {
        return closure::air::viscosity(t);
    }
    double conductivity(double t, const double* y) const override { return viscosity(t, y) * specific_heat(t, y) / 0.71; }

  private:
    combustion::per_species streams_[2];
};

}  // namespace hearth::furnace
