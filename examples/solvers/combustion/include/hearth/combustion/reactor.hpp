// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <hearth/combustion/jones_lindstedt.hpp>
#include <hearth/combustion/species.hpp>
#include <hearth/combustion/thermo.hpp>

namespace hearth::combustion {

/// How far the independent reactions have run: reforming, hydrogen oxidation, water-gas shift.  [mol/kg]
/// Partial oxidation is the sum of the first two: seven species of four elements leave three degrees of freedom.
using extents = std::array<double, 3>;
inline constexpr std::size_t extent_count = 3;

/// Moles of each species that one mole of extent makes, and of the mixture.
inline constexpr std::array<per_species, extent_count> extent_stoichiometry{
    stoichiometry[reforming], stoichiometry[hydrogen_oxidation], stoichiometry[water_gas_shift]};
inline constexpr std::array<nasa7, extent_count> extent_thermo{step_thermo[reforming], step_thermo[hydrogen_oxidation],
                                                               step_thermo[water_gas_shift]};
inline constexpr extents extent_moles{2, -0.5, 0};

/// An adiabatic reactor at constant pressure, closed or perfectly stirred, as an ordinary differential equation of
/// three extents.  The elements are kept because only extents change; the enthalpy, because the temperature is not
/// integrated but found from it.  With an exchange rate (the reciprocal of a residence time) the reactor is fed by its
/// initial mixture at its initial enthalpy.
class reactor {
  public:
    /// From the amounts [mol/kg], temperature [K] and pressure [Pa] at extents of zero; exchange rate [1/s].
    /// Throws bad_value where one of them is negative or not finite, or a setting of the mechanism out of range.
    reactor(const jones_lindstedt& mechanism, const per_species& amount, double temperature, double pressure,
            double exchange_rate = 0.0);

    /// Amounts of the species [mol/kg].
    per_species amount(const extents& e) const {
        const per_species& n = amount_;
        return {n[CH4] - e[0],
                n[O2] - 0.5 * e[1],
                n[N2],
                n[CO] + e[0] - e[2],
                n[CO2] + e[2],
                n[H2] + 3 * e[0] - e[1] + e[2],
                n[H2O] - e[0] + e[1] - e[2]};
    }
    const jones_lindstedt& mechanism() const { return mechanism_; }
    /// Specific enthalpy, the same at all times [J/kg].
    double enthalpy() const { return enthalpy_; }
    /// Temperature of the last evaluation [K].
    double temperature() const { return temperature_; }

    /// Rates of the extents [mol/(kg s)], and where asked for their derivatives, by rows [1/s].
    /// After a call with derivatives, temperatures nearby are found faster.
    template <bool Derivatives>
    void evaluate(const extents& e, extents& rate, std::array<extents, extent_count>* jacobian = nullptr);

  private:
    jones_lindstedt mechanism_;
    per_species amount_;
    nasa7 mixture_;
    double enthalpy_, pressure_, exchange_rate_, total_;

    double temperature_;                    // of the last evaluation
    extents base_{}, temperature_slope_{};  // where it was taken with derivatives, and dT/d(extent) there
    double base_temperature_;
};

template <bool Derivatives>
void reactor::evaluate(const extents& e, extents& rate, std::array<extents, extent_count>* jacobian) {
    nasa7 mixture = mixture_;
    double total = total_;
    double guess = base_temperature_;
    for (std::size_t i = 0; i < extent_count; ++i) {
        mixture.add(e[i], extent_thermo[i]);
        total += extent_moles[i] * e[i];
        guess += temperature_slope_[i] * (e[i] - base_[i]);
    }
    temperature_ = mixture.temperature(enthalpy_, guess, 1e-6);

    per_species x = amount(e);
    const double share = 1 / total;
    for (double& n : x) n *= share;
    rate_terms r;
    combustion::evaluate<Derivatives>(mechanism_, rate_constants_at(mechanism_, temperature_, pressure_), x, r);

    per_step net;
    for (std::size_t s = 0; s < step_count; ++s) net[s] = r.forward[s] - r.backward[s];
    const auto rows = [](const per_step& v) { return extents{v[0] + v[1], v[0] + v[2], v[3]}; };
    rate = rows(net);
    for (std::size_t i = 0; i < extent_count; ++i) rate[i] = total * rate[i] - exchange_rate_ * e[i];

    if constexpr (Derivatives) {
        // With n = total x: d(n r)/de = r dn/de + dr/dx (dn_k/de - x dn/de) + n dr/dT dT/de.
        const double heat_capacity = mixture.heat_capacity(temperature_);
        for (std::size_t j = 0; j < extent_count; ++j) {
            temperature_slope_[j] = -extent_thermo[j].enthalpy(temperature_) / heat_capacity;
            per_step d;
            for (std::size_t s = 0; s < step_count; ++s) {
                d[s] = net[s] * extent_moles[j] + total * r.by_temperature[s] * temperature_slope_[j];
                for (std::size_t k = 0; k < species_count; ++k)
                    d[s] += r.by_fraction[s][k] * (extent_stoichiometry[j][k] - x[k] * extent_moles[j]);
            }
            const extents column = rows(d);
            for (std::size_t i = 0; i < extent_count; ++i) (*jacobian)[i][j] = column[i];
            (*jacobian)[j][j] -= exchange_rate_;
        }
        base_ = e;
        base_temperature_ = temperature_;
    }
}

/// How closely a reactor is integrated: the error of a step may be relative * amount + absolute * (amount of mixture)
/// for each species; the second at most a hundredth of the most that the elements allow.
struct tolerance {
    double relative = 1e-4;  ///< [-]
    double absolute = 1e-6;  ///< as a mole fraction [-]
};

/// What an integration did.
struct integration {
    long steps = 0;        ///< accepted
    long rejected = 0;     ///< repeated with a smaller step
    long limited = 0;      ///< accepted after the extents were moved, within the tolerance, to keep an amount positive
    double error = 0;      ///< sum of the estimated errors of the steps, in units of the tolerance [-]
    bool finished = true;  ///< false where max_steps did not suffice; the state is then that of the time reached
};

/// Integrates a reactor from extents e over a duration [s]; e becomes the extents then, and no amount is negative
/// there. Rodas4 (Hairer & Wanner, Solving Ordinary Differential Equations II, 1996, sec. IV.7 and VI.4): linearly
/// implicit, order 4 with an embedded order 3, L-stable, stiffly accurate.  A step that leaves a negative amount is
/// repeated, unless the amount is within the tolerance; then an exchange between species takes it to zero, which keeps
/// the elements.
[[nodiscard]] integration integrate(reactor& gas, extents& e, double duration, const tolerance& tol,
                                    long max_steps = 100000);

}  // namespace hearth::combustion
