// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include <hearth/combustion/species.hpp>
#include <hearth/combustion/thermo.hpp>

namespace hearth::combustion {

/// Thermal NO from the extended Zeldovich mechanism, O + N2 <-> NO + N, N + O2 <-> NO + O, N + OH <-> NO + H, with
/// nitrogen atoms steady and oxygen atoms and OH in equilibrium with O2 and H2O.  For post-processing: NO is a trace
/// that takes nothing from the flow.  Rate constants of Hanson & Salimian (in Gardiner, Combustion Chemistry, 1984),
/// 1600 to 2500 K; below, the rate is negligible.
struct thermal_nitric_oxide {
    /// Oxygen atoms in equilibrium with molecules at [O2], Westenberg, Combustion Science
    /// and Technology 4 (1971) 59; 6 to 1 % below the tables from 1800 to 2500 K.  [mol/m^3]
    static double oxygen_atoms(double temperature, double o2) {
        return 3.97e5 / std::sqrt(temperature) * std::sqrt(o2) * std::exp(-31090 / temperature);
    }
    /// OH in equilibrium with [O] and [H2O]: our fit to the tables of GRI-Mech 3.0, within 0.5 % from 1500 to 2600 K.
    /// [mol/m^3]
    static double hydroxyl(double temperature, double o, double h2o) {
        return 3.047 * std::exp(-4224 / temperature) * std::sqrt(o * h2o);
    }

    /// d[NO]/dt at a temperature [K], a pressure [Pa], mole fractions [-] and the mole fraction of NO [-].  Negative
    /// where there is more NO than the equilibrium allows.  Without oxygen it is zero.  [mol/(m^3 s)]
    static double rate(double temperature, double pressure, const per_species& x, double x_no = 0.0) {
        const double c = pressure / (gas_constant * temperature);
        const double o2 = std::max(x[O2], 0.0) * c, n2 = x[N2] * c, no = x_no * c;
        if (!(o2 > 0)) return 0;
        const auto k = [&](double a, double activation) { return a * std::exp(-activation / temperature); };
        const double k1 = k(1.8e8, 38370), k1_back = k(3.8e7, 425);
        const double k2 = k(1.8e4, 4680) * temperature, k2_back = k(3.81e3, 20820) * temperature;
        const double k3 = k(7.1e7, 450);
        const double o = oxygen_atoms(temperature, o2);
        const double oh = hydroxyl(temperature, o, std::max(x[H2O], 0.0) * c);
        const double sink = k2 * o2 + k3 * oh;  // of nitrogen atoms
        return 2 * o * (k1 * n2 - k1_back * k2_back * no * no / (k2 * o2)) / (1 + k1_back * no / sink);
    }
};

}  // namespace hearth::combustion
