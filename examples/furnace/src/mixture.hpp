// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <hearth/combustion/thermo.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/gas/model.hpp>

namespace hearth::furnace {

/// Amounts [mol/kg] of dry air, 21 % oxygen and 79 % nitrogen.
combustion::per_species air();
/// Amounts [mol/kg] of methane in air before they burn; equivalence ratio [-].
combustion::per_species premix(double equivalence_ratio);

/// A mixture of two streams, air and what the burners bring, burnt where it is mixed: to CO2 and H2O, or to the equilibrium of
/// the seven species.  The mass fractions are those of the streams, so elements are kept whatever burns, and no source term is
/// needed: the heat of combustion is in the enthalpy of the burnt mixture.
///
/// Enthalpy and moles come from a table over mixture and temperature, straight lines between nodes 10 K and 1/64 apart: the
/// enthalpy is within 5 J/kg of what it is made of where only cp bends, 0.004 K.  Equilibrium is that of one pressure; an
/// eighth more, as at the burners of the paper's furnace, changes the flame by 2 K.  Viscosity is that of air, which burnt gas
/// is within 10 % of; Prandtl number 0.71.
class mixture final : public gas::gas_model {
  public:
    mixture(const combustion::per_species& first, const combustion::per_species& second, burning how, double pressure);

    int species_count() const override { return 2; }
    double density(double pressure, double temperature, const double* y) const override;
    double enthalpy(double temperature, const double* y) const override;
    double specific_heat(double temperature, const double* y) const override;
    double viscosity(double temperature, const double* y) const override;
    double conductivity(double temperature, const double* y) const override;

    /// Amounts of the burnt mixture [mol/kg]; share: of the second stream [-].
    combustion::per_species burnt(double share, double temperature) const;
    /// Enthalpy of a stream as it enters, not burnt [J/kg].
    double cold_enthalpy(int stream, double temperature) const;
    /// Heat set free by burning the second stream completely, at 298.15 K, water as vapour [J/kg].
    double heating_value() const;

  private:
    static constexpr int shares = 65, temperatures = 331;
    static constexpr double coldest = 200, spacing = 10;

    struct place {
        std::size_t at;      ///< node below in both
        double share, part;  ///< of the way to the next node
    };
    static place find(double temperature, const double* y);
    static double mix(const std::vector<double>& table, const place& p);

    combustion::per_species streams_[2];
    burning how_;
    double pressure_;
    std::vector<double> enthalpy_, moles_;  // [J/kg], [mol/kg]
};

}  // namespace hearth::furnace
