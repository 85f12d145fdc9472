// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hearth/combustion/species.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/interval.hpp>

namespace hearth::combustion {

inline constexpr double gas_constant = constants<double>::gas_constant();              ///< [J/(mol K)]
inline constexpr double standard_pressure = constants<double>::standard_atmosphere();  ///< of the entropies [Pa]

/// One range of NASA's seven coefficients (Gordon & McBride, NASA SP-273, 1971):
///     cp/R = a0 + a1 T + a2 T^2 + a3 T^3 + a4 T^4,   h/R = T (a0 + a1 T/2 + ...) + a5,   s/R = a0 ln T + a1 T + ... +
///     a6.
struct nasa_range {
    std::array<double, 7> a{};

    /// [J/(mol K)]
    constexpr double heat_capacity(double t) const {
        return gas_constant * (a[0] + t * (a[1] + t * (a[2] + t * (a[3] + t * a[4]))));
    }
    /// [J/mol]
    constexpr double enthalpy(double t) const {
        return gas_constant * (a[5] + t * (a[0] + t * (a[1] * (1.0 / 2) +
                                                       t * (a[2] * (1.0 / 3) + t * (a[3] * 0.25 + t * (a[4] * 0.2))))));
    }
    /// From the temperature and its logarithm.  [J/(mol K)]
    constexpr double entropy(double t, double log_t) const {
        return gas_constant *
               (a[0] * log_t + a[6] + t * (a[1] + t * (a[2] * (1.0 / 2) + t * (a[3] * (1.0 / 3) + t * (a[4] * 0.25)))));
    }
    /// Adds a multiple of another: all properties are linear in the coefficients.
    constexpr void add(double factor, const nasa_range& other) {
        for (std::size_t j = 0; j < 7; ++j) a[j] += factor * other.a[j];
    }
};

/// Thermodynamics of a gas in two ranges of temperature.  The same struct holds a species [per mol], a mixture [per kg,
/// from amounts in mol/kg] and a reaction [per mol of extent]; the unit of what the functions return follows.
///
/// Valid from 200 to 3500 K.  Outside, cp keeps its value at the limit, so that every function is total and the
/// enthalpy rises with the temperature; callers that must not extrapolate compare with `limits()`.
struct nasa7 {
    nasa_range low, high;

    static constexpr interval limits() { return {200.0, 3500.0}; }  ///< [K]
    static constexpr double split() { return 1000.0; }              ///< `low` up to here [K]

    constexpr const nasa_range& range(double t) const { return t <= split() ? low : high; }

    /// Heat capacity at constant pressure [J/(mol K)] or [J/(kg K)].
    double heat_capacity(double temperature) const {
        const double t = limits().clamp(temperature);
        return range(t).heat_capacity(t);
    }
    /// Enthalpy with the heat of formation [J/mol] or [J/kg].
    double enthalpy(double temperature) const {
        const double t = limits().clamp(temperature);
        return range(t).enthalpy(t) + range(t).heat_capacity(t) * (temperature - t);
    }
    /// Entropy at the standard pressure, without mixing [J/(mol K)] or [J/(kg K)].
    double entropy(double temperature) const { return entropy(temperature, std::log(temperature)); }
    /// The same, for callers that have the logarithm of the temperature.
    double entropy(double temperature, double log_temperature) const {
        const double t = limits().clamp(temperature);
        if (t == temperature) return range(t).entropy(t, log_temperature);
        const double log_t = std::log(t);
        return range(t).entropy(t, log_t) + range(t).heat_capacity(t) * (log_temperature - log_t);
    }
    /// Gibbs energy at the standard pressure, without mixing [J/mol] or [J/kg].
    double gibbs(double temperature) const { return enthalpy(temperature) - temperature * entropy(temperature); }

    /// The temperature at which a mixture has this enthalpy, to round-off, for any enthalpy.  [K]
    /// Newton, kept in the range: the mean heat capacity between two temperatures of a range is below twice that at
    /// either, for each species, so the error falls with every step.  The tabulated enthalpies step at 1000 K, by up to
    /// -0.005 J/mol; there the lower range is taken, so that the answer exists and is unique.
    /// Newton ends with a step below `last_step` [-], which leaves its square as relative error, or round-off.
    /// Needs a positive heat capacity: not for reactions.
    double temperature(double enthalpy, double guess = 1500.0, double last_step = 1e-8) const {
        const bool below = enthalpy <= low.enthalpy(split());
        const nasa_range& gas = below ? low : high;
        const interval inside = below ? interval{limits().lo, split()} : interval{split(), limits().hi};
        double t = inside.clamp(guess);
        for (int i = 0; i < 100; ++i) {
            const double next = t - (gas.enthalpy(t) - enthalpy) / gas.heat_capacity(t);
            // The error left is below cp'/(2 cp) < 1e-3/K times the square of this step.
            if (std::fabs(next - t) < last_step * t) return next;
            const double kept = inside.clamp(next);
            if (kept == t) return next;  // at a limit, beyond which the enthalpy is linear
            t = kept;
        }
        return t;
    }

    /// Adds a multiple of another.
    constexpr void add(double factor, const nasa7& other) {
        low.add(factor, other.low);
        high.add(factor, other.high);
    }
};

// clang-format off
/// The coefficients of GRI-Mech 3.0 (Smith et al., http://combustion.berkeley.edu/gri-mech/version30); reference state
/// 298.15 K and one atmosphere.
inline constexpr std::array<nasa7, species_count> thermo_table{{
    {{{5.14987613e+00, -1.36709788e-02, 4.91800599e-05, -4.84743026e-08,
       1.66693956e-11, -1.02466476e+04, -4.64130376e+00}},
     {{7.48514950e-02, 1.33909467e-02, -5.73285809e-06, 1.22292535e-09,
       -1.01815230e-13, -9.46834459e+03, 1.84373180e+01}}},  // CH4
    {{{3.78245636e+00, -2.99673416e-03, 9.84730201e-06, -9.68129509e-09,
       3.24372837e-12, -1.06394356e+03, 3.65767573e+00}},
     {{3.28253784e+00, 1.48308754e-03, -7.57966669e-07, 2.09470555e-10,
       -2.16717794e-14, -1.08845772e+03, 5.45323129e+00}}},  // O2
    {{{3.29867700e+00, 1.40824040e-03, -3.96322200e-06, 5.64151500e-09,
       -2.44485400e-12, -1.02089990e+03, 3.95037200e+00}},
     {{2.92664000e+00, 1.48797680e-03, -5.68476000e-07, 1.00970380e-10,
       -6.75335100e-15, -9.22797700e+02, 5.98052800e+00}}},  // N2
    {{{3.57953347e+00, -6.10353680e-04, 1.01681433e-06, 9.07005884e-10,
       -9.04424499e-13, -1.43440860e+04, 3.50840928e+00}},
     {{2.71518561e+00, 2.06252743e-03, -9.98825771e-07, 2.30053008e-10,
       -2.03647716e-14, -1.41518724e+04, 7.81868772e+00}}},  // CO
    {{{2.35677352e+00, 8.98459677e-03, -7.12356269e-06, 2.45919022e-09,
       -1.43699548e-13, -4.83719697e+04, 9.90105222e+00}},
     {{3.85746029e+00, 4.41437026e-03, -2.21481404e-06, 5.23490188e-10,
       -4.72084164e-14, -4.87591660e+04, 2.27163806e+00}}},  // CO2
    {{{2.34433112e+00, 7.98052075e-03, -1.94781510e-05, 2.01572094e-08,
       -7.37611761e-12, -9.17935173e+02, 6.83010238e-01}},
     {{3.33727920e+00, -4.94024731e-05, 4.99456778e-07, -1.79566394e-10,
       2.00255376e-14, -9.50158922e+02, -3.20502331e+00}}},  // H2
    {{{4.19864056e+00, -2.03643410e-03, 6.52040211e-06, -5.48797062e-09,
       1.77197817e-12, -3.02937267e+04, -8.49032208e-01}},
     {{3.03399249e+00, 2.17691804e-03, -1.64072518e-07, -9.70419870e-11,
       1.68200992e-14, -3.00042971e+04, 4.96677010e+00}}},  // H2O
}};
// clang-format on

/// The weighted sum of the species: a mixture, from amounts [mol/kg], or a reaction, from its stoichiometry [-].
constexpr nasa7 combine(const per_species& weight) {
    nasa7 all;
    for (std::size_t k = 0; k < species_count; ++k) all.add(weight[k], thermo_table[k]);
    return all;
}

}  // namespace hearth::combustion
