// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hearth/combustion/species.hpp>
#include <hearth/combustion/thermo.hpp>

namespace hearth::combustion {

/// The steps of the mechanism, as the index of what follows.
enum reaction_step : std::size_t { partial_oxidation, reforming, hydrogen_oxidation, water_gas_shift };
inline constexpr std::size_t step_count = 4;
using per_step = std::array<double, step_count>;

// clang-format off
/// Moles of each species that one mole of a step makes.
inline constexpr std::array<per_species, step_count> stoichiometry{{
    // CH4  O2   N2 CO CO2 H2 H2O
    {{-1, -0.5, 0, 1, 0, 2, 0}},    // CH4 + 1/2 O2 -> CO + 2 H2
    {{-1, 0, 0, 1, 0, 3, -1}},      // CH4 + H2O -> CO + 3 H2
    {{0, -0.5, 0, 0, 0, -1, 1}},    // H2 + 1/2 O2 <-> H2O
    {{0, 0, 0, -1, 1, 1, -1}}}};    // CO + H2O <-> CO2 + H2
// clang-format on

/// Enthalpy, entropy and heat capacity of the steps [per mol].
inline constexpr std::array<nasa7, step_count> step_thermo{combine(stoichiometry[0]), combine(stoichiometry[1]),
                                                           combine(stoichiometry[2]), combine(stoichiometry[3])};

/// Four-step combustion of methane, with reversible steps of hydrogen and carbon monoxide.
/// Jones & Lindstedt, Combustion and Flame 73 (1988) 233, doi:10.1016/0010-2180(88)90021-1, for 1200 to 2300 K, around
/// one atmosphere.  In kmol, m^3, s, K and cal/mol:
///     partial oxidation   0.44e12 exp(-30000/RT) [CH4]^1/2 [O2]^5/4
///     reforming           0.30e9  exp(-30000/RT) [CH4] [H2O]
///     hydrogen oxidation  0.68e16/T exp(-40000/RT) [H2]^1/4 [O2]^3/2            (3B, the default)
///                         0.25e17/T exp(-40000/RT) [H2]^1/2 [O2]^9/4 [H2O]^-1   (3A)
///     water-gas shift     0.275e10 exp(-20000/RT) [CO] [H2O]
/// The reverse rates follow from the equilibrium constants.  Their orders are those of the forward rate plus the
/// stoichiometry, so each keeps a power of what may be absent:
///     3B: [H2]^-3/4 [O2] [H2O],   3A: [H2]^-1/2 [O2]^7/4,   shift: [CO2] [H2].
/// Powers below one are regularised, c^n -> c (c + d)^(n-1) and c^-n -> (c + d)^-n, the same on both sides of a step,
/// so that the equilibrium stays where it is.  With d at the absolute tolerance of an integration nothing nonlinear
/// happens below what it resolves: states change by about d, and a steady trace of H2 no longer costs a thousand steps.
/// Without any O2 the reverse of the third step would stand still for ever, an unstable state that a limited
/// integration may well reach: there [O2] + seed stands for [O2].  Negative mole fractions count as zero.
struct jones_lindstedt {
    enum class hydrogen_step { a, b };

    hydrogen_step variant = hydrogen_step::b;
    double regularisation = 1e-6;  ///< d, as a mole fraction; > 0 [-]
    double water_seed = 1e-5;      ///< d of the water in 3A, which is singular in a dry mixture; > 0 [-]
    double oxygen_seed = 1e-12;    ///< as a mole fraction; > 0 [-]
};

/// What the rates owe to temperature and pressure.  With mole fractions x, per mole of mixture,
///     rate of a step = forward * g(x) - back * forward * g'(x).
struct rate_constants {
    per_step forward;                              ///< k (p/RT)^(order - 1) [1/s]
    per_step forward_slope;                        ///< d ln(forward)/dT [1/K]
    double hydrogen_back, shift_back;              ///< reciprocal equilibrium constants in mole fractions [-]
    double hydrogen_back_slope, shift_back_slope;  ///< d ln/dT of these [1/K]
};

inline rate_constants rate_constants_at(const jones_lindstedt& mechanism, double temperature, double pressure) {
    // All activation energies are multiples of 10 000 cal/mol: one exponential serves four rates.
    constexpr double activation = 10000 / 1.98720425864;  // [K]
    const double reciprocal = 1 / temperature;
    const double a = activation * reciprocal;
    const double e1 = std::exp(-a), e2 = e1 * e1, e3 = e2 * e1, e4 = e2 * e2;
    const double c = pressure * reciprocal * (1e-3 / gas_constant);  // [kmol/m^3]
    const double c_half = std::sqrt(c), c_3_4 = c_half * std::sqrt(c_half);
    const bool b = mechanism.variant == jones_lindstedt::hydrogen_step::b;

    rate_constants k;
    k.forward = {0.44e12 * e3 * c_3_4, 0.30e9 * e3 * c, (b ? 0.68e16 : 0.25e17) * reciprocal * e4 * c_3_4,
                 0.275e10 * e2 * c};
    k.forward_slope = {reciprocal * (3 * a - 0.75), reciprocal * (3 * a - 1), reciprocal * (4 * a - 1.75),
                       reciprocal * (2 * a - 1)};

    // 1/K = exp(G/RT), d(G/RT)/dT = -H/(R T^2).
    const double per_rt = reciprocal / gas_constant, log_t = std::log(temperature);
    const auto back = [&](reaction_step s, double& slope) {
        const double h = step_thermo[s].enthalpy(temperature);
        slope = -h * per_rt * reciprocal;
        return std::exp(h * per_rt - step_thermo[s].entropy(temperature, log_t) * (1 / gas_constant));
    };
    k.hydrogen_back = back(hydrogen_oxidation, k.hydrogen_back_slope) * std::sqrt(standard_pressure / pressure);
    k.shift_back = back(water_gas_shift, k.shift_back_slope);
    return k;
}

/// Rates per mole of mixture, and the derivatives of the net rates.
struct rate_terms {
    per_step forward, backward;                       ///< [1/s]
    per_step by_temperature;                          ///< at constant mole fractions [1/(s K)]
    std::array<per_species, step_count> by_fraction;  ///< at constant other mole fractions [1/s]
};

/// Fills the rates, and the derivatives where asked for.
template <bool Derivatives>
inline void evaluate(const jones_lindstedt& mechanism, const rate_constants& k, const per_species& x, rate_terms& r) {
    const double ch4 = std::max(x[CH4], 0.0), o2 = std::max(x[O2], 0.0), co = std::max(x[CO], 0.0);
    const double co2 = std::max(x[CO2], 0.0), h2 = std::max(x[H2], 0.0), h2o = std::max(x[H2O], 0.0);
    const bool b = mechanism.variant == jones_lindstedt::hydrogen_step::b;
    const double o2_d = o2 + mechanism.oxygen_seed, o2_half = std::sqrt(o2_d), o2_quarter = std::sqrt(o2_half);
    const double ch4_d = ch4 + mechanism.regularisation, h2_d = h2 + mechanism.regularisation;
    const double h2_half = std::sqrt(h2_d), h2o_d = h2o + mechanism.water_seed;

    const double first = k.forward[0] / std::sqrt(ch4_d) * o2_quarter;  // but for [O2] and [CH4]
    // Common to both directions: 3B [O2] [H2]^-3/4, 3A [O2]^7/4 [H2]^-1/2 [H2O]^-1.
    const double third =
        k.forward[2] * o2_d * (b ? std::sqrt(h2_half) / h2_d : o2_half * o2_quarter / (h2_half * h2o_d));
    const double o2_root = o2 / o2_half;
    const double shift = k.forward[3] * k.shift_back;

    r.forward = {first * o2 * ch4, k.forward[1] * ch4 * h2o, third * h2 * o2_root, k.forward[3] * co * h2o};
    r.backward = {0, 0, third * h2o * k.hydrogen_back, shift * co2 * h2};
    if constexpr (Derivatives) {
        const double net = r.forward[2] - r.backward[2];
        r.by_fraction = {};
        r.by_fraction[0][CH4] = first * o2 * (1 - 0.5 * ch4 / ch4_d);
        r.by_fraction[0][O2] = first * ch4 * (1 + 0.25 * o2 / o2_d);
        r.by_fraction[1][CH4] = k.forward[1] * h2o;
        r.by_fraction[1][H2O] = k.forward[1] * ch4;
        r.by_fraction[2][H2] = third * o2_root - (b ? 0.75 : 0.5) / h2_d * net;
        r.by_fraction[2][O2] = (b ? 1.0 : 1.75) / o2_d * net + third * h2 * (1 - 0.5 * o2 / o2_d) / o2_half;
        r.by_fraction[2][H2O] = -third * k.hydrogen_back - (b ? 0.0 : net / h2o_d);
        r.by_fraction[3][CO] = k.forward[3] * h2o;
        r.by_fraction[3][H2O] = k.forward[3] * co;
        r.by_fraction[3][CO2] = -shift * h2;
        r.by_fraction[3][H2] = -shift * co2;
        for (std::size_t s = 0; s < step_count; ++s)
            r.by_temperature[s] = k.forward_slope[s] * (r.forward[s] - r.backward[s]);
        r.by_temperature[2] -= k.hydrogen_back_slope * r.backward[2];
        r.by_temperature[3] -= k.shift_back_slope * r.backward[3];
    }
}

/// Rates of the steps [mol/(m^3 s)].
struct step_rates {
    per_step forward, net;
};

/// Rates at a temperature [K], a pressure [Pa] and mole fractions [-]; all positive, not checked.
inline step_rates rates(const jones_lindstedt& mechanism, double temperature, double pressure, const per_species& x) {
    rate_terms r;
    evaluate<false>(mechanism, rate_constants_at(mechanism, temperature, pressure), x, r);
    const double concentration = pressure / (gas_constant * temperature);
    step_rates out;
    for (std::size_t s = 0; s < step_count; ++s) {
        out.forward[s] = concentration * r.forward[s];
        out.net[s] = concentration * (r.forward[s] - r.backward[s]);
    }
    return out;
}

}  // namespace hearth::combustion
