// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace hearth::gas {

/// What the solver needs to know about the gas.  A host or a combustion library implements it; mass fractions come as
/// `species_count` doubles that add up to 1.  Every function is called in loops over cells: no allocation.
class gas_model {
  public:
    virtual ~gas_model() = default;
    virtual int species_count() const = 0;
    virtual double density(double pressure, double temperature, const double* mass_fraction) const = 0;  ///< [kg/m^3]
    virtual double enthalpy(double temperature, const double* mass_fraction) const = 0;        ///< absolute [J/kg]
    virtual double specific_heat(double temperature, const double* mass_fraction) const = 0;   ///< c_p [J/(kg K)]
    virtual double viscosity(double temperature, const double* mass_fraction) const = 0;       ///< [Pa s]
    virtual double conductivity(double temperature, const double* mass_fraction) const = 0;    ///< [W/(m K)]

    /// d(density)/d(pressure) at constant temperature [kg/(m^3 Pa)]; that of an ideal gas.
    virtual double compressibility(double pressure, double density) const { return density / pressure; }

    virtual double lowest_temperature() const { return 200; }    ///< validity [K]
    virtual double highest_temperature() const { return 3500; }  ///< [K]

    /// Temperature of an enthalpy by Newton's method, kept inside the validity range [K].
    double temperature(double enthalpy_, const double* mass_fraction, double guess) const {
        double low = lowest_temperature(), high = highest_temperature();
        double t = guess > low && guess < high ? guess : 0.5 * (low + high);
        for (int i = 0; i < 100; ++i) {
            const double rest = enthalpy(t, mass_fraction) - enthalpy_;
            (rest > 0 ? high : low) = t;
            double next = t - rest / specific_heat(t, mass_fraction);
            // A step of round-off is not taken: an unchanged enthalpy gives an unchanged temperature.
            if (std::abs(next - t) < 1e-14 * t) return t;
            if (!(next > low && next < high)) next = 0.5 * (low + high);
            t = next;
        }
        return t;
    }
};

/// One ideal gas of constant specific heat; viscosity after Sutherland, constant Prandtl number.
/// Sutherland constants of air: NACA TR-1135 (1953), 100 to 1900 K.
class simple_gas final : public gas_model {
  public:
    double molar_mass = 0.0289652;        ///< [kg/mol]
    double heat_capacity = 1005.0;        ///< c_p [J/(kg K)]
    double prandtl = 0.71;                ///< [-]
    double viscosity_reference = 1.716e-5;  ///< at 273.15 K [Pa s]
    double sutherland = 110.4;            ///< [K]; 0 makes the viscosity constant
    double constant_density = 0;          ///< where > 0: the density of an incompressible fluid [kg/m^3]
    double coldest = 1, hottest = 1e5;    ///< [K]

    int species_count() const override { return 1; }
    double density(double pressure, double temperature, const double*) const override {
        return constant_density > 0 ? constant_density : pressure * molar_mass / (8.31446261815324 * temperature);
    }
    double enthalpy(double temperature, const double*) const override { return heat_capacity * temperature; }
    double specific_heat(double, const double*) const override { return heat_capacity; }
    double viscosity(double temperature, const double*) const override {
        if (!(sutherland > 0)) return viscosity_reference;
        const double ratio = temperature / 273.15;
        return viscosity_reference * ratio * std::sqrt(ratio) * (273.15 + sutherland) / (temperature + sutherland);
    }
    double conductivity(double temperature, const double* mass_fraction) const override {
        return viscosity(temperature, mass_fraction) * heat_capacity / prandtl;
    }
    double compressibility(double pressure, double density_) const override {
        return constant_density > 0 ? 0 : density_ / pressure;
    }
    double lowest_temperature() const override { return coldest; }
    double highest_temperature() const override { return hottest; }
};

}  // namespace hearth::gas
