// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/core/function.hpp>
#include <hearth/core/thermal_link.hpp>

namespace hearth {

/// All that one particle exchanges heat with at given temperatures: gas, walls, surroundings, fused into four numbers.
/// The heat rate into the particle is  conductance (T_c - T) + radiation (T_r^4 - T^4).
template <class Real = double>
struct heat_bath {
    Real conductance = Real(0);          ///< sum of K [W/K]
    Real conductance_times_t = Real(0);  ///< sum of K T [W]
    Real radiation = Real(0);            ///< sum of r [W/K^4]
    Real radiation_times_t4 = Real(0);   ///< sum of r T^4 [W]

    HEARTH_FUNCTION constexpr void add(const conductive_link<Real>& link, Real there) {
        conductance += link.conductance;
        conductance_times_t += link.conductance * there;
    }
    HEARTH_FUNCTION constexpr void add(const radiative_link<Real>& link, Real there) {
        radiation += link.radiation;
        radiation_times_t4 += link.radiation * (there * there) * (there * there);
    }
    HEARTH_FUNCTION constexpr void add(const thermal_link<Real>& link, Real there) {
        add(conductive_link<Real>{link.conductance}, there);
        add(radiative_link<Real>{link.radiation}, there);
    }

    /// Temperature towards which the conductances pull [K]; `otherwise` where there are none.
    HEARTH_FUNCTION Real conductive_temperature(Real otherwise) const {
        return conductance > Real(0) ? conductance_times_t / conductance : otherwise;
    }
    /// The same of the radiation [K].
    HEARTH_FUNCTION Real radiative_temperature(Real otherwise) const {
        return radiation > Real(0) ? std::sqrt(std::sqrt(radiation_times_t4 / radiation)) : otherwise;
    }
};

/// Where a particle is after a step, and what it received on the way.  heat is m (h(T_new) - h(T_old)), the particle's
/// enthalpy change; conducted + radiated = heat.  The partners lose these amounts over Gamma.
template <class Real = double>
struct particle_step {
    Real temperature;  ///< [K]
    Real heat;         ///< [J]
    Real conducted;    ///< of it, from the conductances of the bath [J]
    Real radiated;     ///< of it, from the radiation of the bath [J]
};

/// What one partner of the bath gave in a step [J].  The shares of all partners sum to `conducted` and `radiated`.
template <class Real>
HEARTH_FUNCTION Real share(const heat_bath<Real>& bath, const particle_step<Real>& taken, Real step,
                           const conductive_link<Real>& link, Real there) {
    return link.conductance * step * (there - bath.conductive_temperature(there)) +
           (bath.conductance > Real(0) ? link.conductance / bath.conductance * taken.conducted : Real(0));
}
template <class Real>
HEARTH_FUNCTION Real share(const heat_bath<Real>& bath, const particle_step<Real>& taken, Real step,
                           const radiative_link<Real>& link, Real there) {
    return link.heat(bath.radiative_temperature(there), there) * step +
           (bath.radiation > Real(0) ? link.radiation / bath.radiation * taken.radiated : Real(0));
}
template <class Real>
HEARTH_FUNCTION Real share(const heat_bath<Real>& bath, const particle_step<Real>& taken, Real step,
                           const thermal_link<Real>& link, Real there) {
    return share(bath, taken, step, conductive_link<Real>{link.conductance}, there) +
           share(bath, taken, step, radiative_link<Real>{link.radiation}, there);
}

namespace detail {

/// A bath seen from a temperature: the radiation replaced by its secant, so that all pulls are linear.
template <class Real>
struct linear_bath {
    Real conductance, radiation;  // [W/K]
    Real conductive, radiative;   // temperatures of the partners [K]
    Real total, target;           // sum [W/K], temperature of balance [K]

    HEARTH_FUNCTION linear_bath(const heat_bath<Real>& bath, Real seen_from, Real otherwise)
        : conductance(bath.conductance),
          radiation(0),
          conductive(bath.conductive_temperature(otherwise)),
          radiative(bath.radiative_temperature(otherwise)) {
        if (bath.radiation > Real(0)) radiation = radiative_link<Real>{bath.radiation}.secant(seen_from, radiative);
        total = conductance + radiation;
        // Written as a step from one partner towards the other: stays between them in spite of rounding.
        target = total > Real(0) ? conductive + (radiation / total) * (radiative - conductive) : otherwise;
    }

    /// Splits the heat of a step between the two kinds of partner so that the parts sum to it, at any step size: what
    /// flows through the particle from one to the other, and a share of what stays.
    HEARTH_FUNCTION particle_step<Real> book(Real temperature, Real heat, Real step) const {
        if (!(total > Real(0))) return {temperature, heat, Real(0), Real(0)};
        const Real through = conductance * (radiation / total) * step * (conductive - radiative);
        return {temperature, heat, through + conductance / total * heat, radiation / total * heat - through};
    }
};

}  // namespace detail

/// Integrators of one particle against its bath.  Each is
///
///     advance(temperature [K], mass [kg], caloric, bath, step [s]) -> particle_step
///
/// where step is in the particle's own time: Gamma times the step of the model.  They are total functions for hosts and
/// devices; the loops of the library check their input before.
///
/// explicit_euler: first order; stable below stable_step (limits.hpp) only.
struct explicit_euler {
    template <class Real, class Caloric>
    HEARTH_FUNCTION static particle_step<Real> advance(Real t, Real mass, const Caloric& caloric,
                                                       const heat_bath<Real>& bath, Real step) {
        const detail::linear_bath<Real> pull(bath, t, t);
        const Real heat = step * (pull.conductance * (pull.conductive - t) + pull.radiation * (pull.radiative - t));
        const Real next = caloric.temperature(caloric.enthalpy(t) + heat / mass);
        return pull.book(next, heat, step);
    }
};

/// First order, stays between its own temperature and those of its partners at any step.  The equation is monotone, so
/// a Newton iteration inside a bracket always ends.
struct backward_euler {
    template <class Real, class Caloric>
    HEARTH_FUNCTION static particle_step<Real> advance(Real t, Real mass, const Caloric& caloric,
                                                       const heat_bath<Real>& bath, Real step) {
        const Real conductive = bath.conductive_temperature(t);
        const Real radiative = bath.radiative_temperature(t);
        Real low = t < conductive ? t : conductive;
        Real high = t > conductive ? t : conductive;
        if (radiative < low) low = radiative;
        if (radiative > high) high = radiative;
        const Real start = caloric.enthalpy(t);
        Real next = t;
        for (int pass = 0; pass < 200 && low < high; ++pass) {
            const radiative_link<Real> radiation{bath.radiation};
            const Real rate = bath.conductance * (conductive - next) + radiation.heat(next, radiative);
            const Real excess = mass * (caloric.enthalpy(next) - start) - step * rate;
            const Real slope = mass * caloric.specific_heat(next) +
                               step * (bath.conductance + Real(4) * bath.radiation * next * next * next);
            if (excess > Real(0))
                high = next;
            else
                low = next;
            Real trial = next - excess / slope;
            if (!(trial > low && trial < high)) trial = low + (high - low) / Real(2);
            // A change of a few round-offs is none.
            const bool ended = next + (trial - next) / Real(4) == next || trial == low || trial == high;
            next = trial;
            if (ended) break;
        }
        return detail::linear_bath<Real>(bath, next, t).book(next, mass * (caloric.enthalpy(next) - start), step);
    }
};

/// Exponential integrator on the secant of the radiation, frozen at the middle of the step: second order, exact for a
/// linear bath and constant specific heat, and a convex combination of the particle's and its partners' temperatures at
/// any step.  The default.
struct etd2_secant {
    template <class Real, class Caloric>
    HEARTH_FUNCTION static particle_step<Real> advance(Real t, Real mass, const Caloric& caloric,
                                                       const heat_bath<Real>& bath, Real step) {
        const detail::linear_bath<Real> at_start(bath, t, t);
        const Real middle = relaxed(t, at_start, step / Real(2), mass * caloric.specific_heat(t));
        const detail::linear_bath<Real> at_middle(bath, middle, t);
        const Real next = relaxed(t, at_middle, step, mass * caloric.specific_heat(middle));
        return at_middle.book(next, mass * (caloric.enthalpy(next) - caloric.enthalpy(t)), step);
    }

  private:
    template <class Real>
    HEARTH_FUNCTION static Real relaxed(Real t, const detail::linear_bath<Real>& pull, Real step, Real capacity) {
        return t - std::expm1(-pull.total * step / capacity) * (pull.target - t);
    }
};

}  // namespace hearth
