// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <hearth/combustion/thermo.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/gas/array.hpp>
#include <hearth/gas/model.hpp>

namespace hearth::furnace {

/// Amounts [mol/kg] of dry air, 21 % oxygen and 79 % nitrogen.
combustion::per_species air();
/// Amounts [mol/kg] of methane in air before they burn; equivalence ratio [-].
combustion::per_species premix(double equivalence_ratio);
/// Fuel over stoichiometric fuel of what the burners bring; without combustion it is air.
double fuel_ratio(const settings& scene);

/// A mixture of two streams, air and what the burners bring, and what burning makes of it.  The gas solver carries the
/// streams, so elements are kept whatever burns; the heat of combustion is in the enthalpy, which holds that of
/// formation. Viscosity is that of air, which burnt gas is within 10 % of; Prandtl number 0.71.
class mixture : public gas::gas_model {
  public:
    mixture(const combustion::per_species& first, const combustion::per_species& second) : streams_{first, second} {}

    /// Share of the second stream [-], from the numbers that the gas solver carries.
    virtual double burner_share(const double* y) const = 0;
    /// Amounts of the seven species [mol/kg], none negative.
    virtual combustion::per_species composition(double temperature, const double* y) const = 0;
    /// The numbers that the gas solver carries, of a mixture that has burnt or not.
    virtual gas::array<double> carried(double burner_share, double temperature, bool burnt) const = 0;

    double viscosity(double temperature, const double* y) const override;
    double conductivity(double temperature, const double* y) const override;

    /// Amounts of the streams' mixture before it burns [mol/kg].
    combustion::per_species unburnt(double burner_share) const;
    /// Enthalpy of a stream as it enters, not burnt [J/kg].
    double cold_enthalpy(int stream, double temperature) const;
    /// Heat set free by burning the second stream completely, at 298.15 K, water as vapour [J/kg].
    double heating_value() const;

  private:
    combustion::per_species streams_[2];
};

/// Burnt where it is mixed: to CO2 and H2O, or to the equilibrium of the seven species.  The solver carries the shares
/// of the two streams; of one alone without combustion.
///
/// Enthalpy and moles come from a table over mixture and temperature, straight lines between nodes 10 K and 1/64 apart:
/// the enthalpy is within 5 J/kg of what it is made of where only cp bends, 0.004 K.  Equilibrium is that of one
/// pressure; an eighth more, as at the burners of the paper's furnace, changes the flame by 2 K.
class burnt_mixture final : public mixture {
  public:
    burnt_mixture(const combustion::per_species& first, const combustion::per_species& second, burning how,
                  double pressure);

    int species_count() const override { return how_ == burning::none ? 1 : 2; }
    double density(double pressure, double temperature, const double* y) const override;
    double enthalpy(double temperature, const double* y) const override;
    double specific_heat(double temperature, const double* y) const override;

    double burner_share(const double* y) const override;
    combustion::per_species composition(double temperature, const double* y) const override;
    gas::array<double> carried(double burner_share, double temperature, bool burnt) const override;

    /// Amounts of the burnt mixture [mol/kg].
    combustion::per_species burnt(double burner_share, double temperature) const;

  private:
    static constexpr int temperatures = 331;
    static constexpr double coldest = 200, spacing = 10;

    struct place {
        std::size_t at;      ///< node below in both
        double share, part;  ///< of the way to the next node
    };
    place find(double temperature, const double* y) const;
    double mix(const std::vector<double>& table, const place& p) const;

    burning how_;
    double pressure_;
    int shares_;
    std::vector<double> enthalpy_, moles_;  // [J/kg], [mol/kg]
};

/// Seven species that react at finite rates.  The solver carries the share of air and the mass fractions of CO, CO2 and
/// H2O; CH4, O2, H2 and N2 follow from the elements, which the streams have.  So four equations serve seven species,
/// which diffuse alike, and elements are kept in every cell to round-off.  The last number only fills up to one.
class reacting_mixture final : public mixture {
  public:
    using mixture::mixture;
    enum carried_number : std::size_t { first_share, carbon_monoxide, carbon_dioxide, water, rest };
    static constexpr int carried_count = 5;

    int species_count() const override { return carried_count; }
    double density(double pressure, double temperature, const double* y) const override;
    double enthalpy(double temperature, const double* y) const override;
    double specific_heat(double temperature, const double* y) const override;

    double burner_share(const double* y) const override;
    /// Numbers that no mixture of these elements has, as limited schemes make them where a front is steep, stand for
    /// the nearest that one has: products beyond the carbon or oxygen that is there are scaled down.
    combustion::per_species composition(double temperature, const double* y) const override;
    gas::array<double> carried(double burner_share, double temperature, bool burnt) const override;
};

/// The mixture of a scene.
std::shared_ptr<const mixture> make_mixture(const settings& scene);

}  // namespace hearth::furnace
