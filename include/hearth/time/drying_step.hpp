// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/core/function.hpp>
#include <hearth/time/particle_energy.hpp>

namespace hearth {

/// Where a wet particle is after a step.
template <class Real = double>
struct drying_result {
    Real temperature;      ///< [K]
    Real moisture;         ///< [kg]
    Real evaporated;       ///< < 0 for condensation [kg]
    Real vapour_enthalpy;  ///< that left with it [J]
    Real conducted;        ///< from the conductances of the bath [J]
    Real radiated;         ///< from the radiation of the bath [J]
};

/// One step of a wet particle, implicit in temperature and evaporation together:
///
///     m (h(T) - h(T0)) + w (l(T) - l(T0)) + e L(T) = step * (heat rate of the bath at T),   e = min(w, step * rate(T))
///
/// m: dry mass, w: water before; h, l: enthalpies of the dry material and of liquid water; L: latent heat.  All terms
/// rise with T, so the root is single and a bracket always finds it, at any step and through the boiling point, where
/// rate(T) climbs steeply and the heat supply decides.  The energy balance closes to round-off: booked from the
/// enthalpies.
///
/// Water: liquid_enthalpy(T) and vapour_enthalpy(T) [J/kg], e.g. the drying term.  rate(T) [kg/s] does not fall with T.
/// step is in the particle's own time [s].
template <class Real, class Caloric, class Water, class Rate>
HEARTH_FUNCTION drying_result<Real> drying_step(Real t, Real dry_mass, Real moisture, const Caloric& caloric,
                                                const Water& water, const heat_bath<Real>& bath, const Rate& rate,
                                                Real step) {
    const Real start = caloric.enthalpy(t), liquid_start = water.liquid_enthalpy(t);
    const auto evaporated = [&](Real at) {
        const Real all = step * rate(at);
        return all < moisture ? all : moisture;
    };
    /// Heat that the particle needs to be at this temperature after the step [J].
    const auto need = [&](Real at) {
        const Real latent = water.vapour_enthalpy(at) - water.liquid_enthalpy(at);
        return dry_mass * (caloric.enthalpy(at) - start) + moisture * (water.liquid_enthalpy(at) - liquid_start) +
               evaporated(at) * latent;
    };
    const auto excess = [&](Real at) {
        const detail::linear_bath<Real> pull(bath, at, at);
        return need(at) - step * (pull.conductance * (pull.conductive - at) + pull.radiation * (pull.radiative - at));
    };

    // A bracket: from where the particle is, geometrically to both sides.
    Real low = t, high = t;
    Real low_excess = excess(low), high_excess = low_excess;
    for (int k = 0; k < 60 && low_excess > Real(0); ++k) {
        high = low, high_excess = low_excess;
        low *= Real(0.97), low_excess = excess(low);
    }
    for (int k = 0; k < 200 && high_excess < Real(0); ++k) {
        low = high, low_excess = high_excess;
        high *= Real(1.03), high_excess = excess(high);
    }
    // Regula falsi with the Illinois rule, which halves the excess of an end that stays; bisection where that stalls.
    Real root = low_excess == Real(0) ? low : high;
    int kept = 0;
    for (int k = 0; k < 200 && low_excess < Real(0) && high_excess > Real(0); ++k) {
        Real trial =
            k % 8 == 7 ? (low + high) / Real(2) : low + (high - low) * (low_excess / (low_excess - high_excess));
        if (!(trial > low && trial < high)) trial = low + (high - low) / Real(2);
        root = trial;
        if (trial == low || trial == high) break;
        const Real found = excess(trial);
        if (found < Real(0)) {
            low = trial, low_excess = found;
            if (kept == -1) high_excess /= Real(2);
            kept = -1;
        } else if (found > Real(0)) {
            high = trial, high_excess = found;
            if (kept == 1) low_excess /= Real(2);
            kept = 1;
        } else {
            break;
        }
    }
    const Real lost = evaporated(root);
    const auto booked = detail::linear_bath<Real>(bath, root, root).book(root, need(root), step);
    return {root, moisture - lost, lost, lost * water.vapour_enthalpy(root), booked.conducted, booked.radiated};
}

}  // namespace hearth
