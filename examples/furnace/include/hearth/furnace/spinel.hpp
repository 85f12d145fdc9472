// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace hearth::furnace {

/// Spinel MgAl2O4, the stone of the paper's furnace.  Serves as a caloric of hearth/time.
struct spinel {
    /// Specific heat [J/(kg K)]: Berman, J. Petrology 29 (1988) 445, doi:10.1093/petrology/29.2.445; 250 to 2000 K, used
    /// to 2400 K.  815 at 298 K, 1254 at 1000 K, 1377 at 2000 K.
    static double specific_heat(double t) {
        return (235.90 - 1766.6 / std::sqrt(t) - 17.104e5 / (t * t) + 4.062e7 / (t * t * t)) / molar_mass;
    }
    /// Its integral, 0 at 298.15 K [J/kg].
    static double enthalpy(double t) { return primitive(t) - primitive(298.15); }
    /// The inverse [K], to round-off; Newton from above, where the enthalpy is concave in its inverse.
    static double temperature(double enthalpy_wanted) {
        double t = 1000;
        for (int pass = 0; pass < 60; ++pass) {
            const double next = t - (enthalpy(t) - enthalpy_wanted) / specific_heat(t);
            const double kept = next < 0.5 * t ? 0.5 * t : next;
            if (std::fabs(kept - t) <= 4e-16 * t) return kept;
            t = kept;
        }
        return t;
    }
    /// Conductivity of dense spinel [W/(m K)]: a fit to 15.0 at 373 K, 9.9 at 673 K, 5.9 at 1273 K (handbook values,
    /// +-20 %; a porous stone has less).
    static double conductivity(double t) { return 1 / (0.0240 + 1.143e-4 * t); }

  private:
    static constexpr double molar_mass = 0.1422656;  // [kg/mol]
    static double primitive(double t) {
        return (235.90 * t - 2 * 1766.6 * std::sqrt(t) + 17.104e5 / t - 4.062e7 / (2 * t * t)) / molar_mass;
    }
};

}  // namespace hearth::furnace
