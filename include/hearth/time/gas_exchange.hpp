// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/time/advance.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/time/tssm.hpp>

namespace hearth {

/// Implicit exchange of heat between particles and the gas through a transfer operator W: bounded and conservative at
/// any step, with no iteration between the two.  In three moves:
///
///     exchange.prepare(...);                                        // K_p = hA C / (C + hA), C = m c / (Gamma step)
///     w.scatter(exchange.coefficient(), implicit_part);             // sum_p W_pc K_p       [W/K] to the gas's
///     diagonal w.scatter(exchange.source(), explicit_part);                  // sum_p W_pc K_p T_p   [W]   to its
///     right-hand side
///     ... the gas solves for its temperatures at the end of the step ...
///     w.gather(gas_temperature, at_particles);
///     exchange.finish(at_particles, ...);                           // q_p = K_p (gas - T_p), T_p += q_p / C
///
/// The gas's matrix keeps its sign pattern, what the gas loses is the sum of q_p because gather is the transpose of
/// scatter, and T_p ends between its own temperature and that of the gas around it.
///
/// cp(T): C takes the least of the specific heats at the particle, at the gas, and of the chord between them, so the
/// enthalpy that a particle receives cannot carry it past gas of the temperature that prepare() was told.  Where cp
/// bends and the gas moves far in one step, overshoots() says before finish() how many particles would pass the gas;
/// then repeat the three moves, telling prepare() the gas that came out:
///
///     do { exchange.prepare(..., at_particles, ...); gas from its state before the step; w.gather(gas, at_particles);
///     } while (exchange.overshoots(at_particles, ...) > 0);
class gas_exchange {
  public:
    /// conductance[i] = h A [W/K], >= 0; gas_temperature[i] at the particle [K]: before the step, or a better guess of
    /// it after the step. Throws bad_value, before it changes anything.
    template <class Clock, class Mass, class CaloricOf>
    void prepare(const std::vector<double>& conductance, const std::vector<double>& gas_temperature, const Mass& mass,
                 const CaloricOf& caloric_of, const Clock& clock, double step, const std::vector<double>& temperature) {
        const std::size_t count = temperature.size();
        detail::require_positive("step", bad_value::no_index, step, "finite and > 0 [s]");
        for (const std::size_t size : {conductance.size(), gas_temperature.size(), mass.size()})
            if (size != count)
                throw bad_value("number of conductances, gas temperatures or masses", bad_value::no_index,
                                static_cast<double>(size), "as many as temperatures");
        for (std::size_t i = 0; i < count; ++i) {
            const auto index = static_cast<std::int64_t>(i);
            detail::require_positive("temperature of particle", index, temperature[i], "finite and > 0 [K]");
            detail::require_positive("gas temperature at particle", index, gas_temperature[i], "finite and > 0 [K]");
            detail::require_positive("mass of particle", index, mass[i], "finite and > 0 [kg]");
            detail::require_positive("specific_heat of particle", index,
                                     least_specific_heat(caloric_of(i), temperature[i], gas_temperature[i]),
                                     "finite and > 0 [J/(kg K)]");
            detail::require_not_negative("gas conductance of particle", index, conductance[i], "finite and >= 0 [W/K]");
            detail::check_acceleration_factor(clock.factor(i), index);
        }
        step_ = step;
        coefficient_.resize(count);
        source_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double capacity = mass[i] * least_specific_heat(caloric_of(i), temperature[i], gas_temperature[i]) /
                                    (clock.factor(i) * step);
            // hA C / (C + hA), in a form that neither a huge nor a tiny step can overflow.
            coefficient_[i] = conductance[i] / (1.0 + conductance[i] / capacity);
            source_[i] = coefficient_[i] * temperature[i];
        }
    }

    const std::vector<double>& coefficient() const { return coefficient_; }  ///< [W/K]
    const std::vector<double>& source() const { return source_; }            ///< [W]

    /// Particles that finish() would carry past the gas at their place; always 0 for a constant specific heat.
    template <class Clock, class Mass, class CaloricOf>
    std::int64_t overshoots(const std::vector<double>& gas_temperature, const Mass& mass, const CaloricOf& caloric_of,
                            const Clock& clock, const std::vector<double>& temperature) const {
        std::int64_t count = 0;
        for (std::size_t i = 0; i < temperature.size(); ++i) {
            const double gap = gas_temperature[i] - temperature[i];
            const double after = carried(clock.factor(i) * lost(i, gap), mass[i], caloric_of(i), temperature[i]);
            // Past by more than round-off: 1e-10 of the gap and some digits of the temperature itself.
            if ((gas_temperature[i] - after) * gap < -(1e-10 * std::fabs(gap) + 1e-14 * after) * std::fabs(gap))
                ++count;
        }
        return count;
    }

    /// Advances the temperatures [K] and returns the heat that the gas lost, by the model's clock [J].
    /// gas_temperature[i] after the gas's step, at the particle [K]; taken[i] in the particle's own time, its conducted
    /// part being all of it.  Throws bad_value, before it changes anything.
    template <class Clock, class Mass, class CaloricOf>
    double finish(const std::vector<double>& gas_temperature, const Mass& mass, const CaloricOf& caloric_of,
                  const Clock& clock, std::vector<double>& temperature,
                  std::vector<particle_step<double>>& taken) const {
        if (gas_temperature.size() != coefficient_.size() || temperature.size() != coefficient_.size())
            throw bad_value("number of temperatures", bad_value::no_index, static_cast<double>(temperature.size()),
                            "as many as prepared");
        for (std::size_t i = 0; i < temperature.size(); ++i)
            detail::require_positive("gas temperature at particle", static_cast<std::int64_t>(i), gas_temperature[i],
                                     "finite and > 0 [K]");
        double total = 0.0;
        taken.resize(temperature.size());
        for (std::size_t i = 0; i < temperature.size(); ++i) {
            const double lost_by_gas = lost(i, gas_temperature[i] - temperature[i]);
            const double heat = clock.factor(i) * lost_by_gas;
            temperature[i] = carried(heat, mass[i], caloric_of(i), temperature[i]);
            taken[i] = {temperature[i], heat, heat, 0.0};
            total += lost_by_gas;
        }
        return total;
    }

  private:
    double lost(std::size_t i, double gap) const { return coefficient_[i] * gap * step_; }

    template <class Caloric>
    static double carried(double heat, double mass, const Caloric& caloric, double before) {
        return caloric.temperature(caloric.enthalpy(before) + heat / mass);
    }

    template <class Caloric>
    static double least_specific_heat(const Caloric& caloric, double here, double there) {
        const double at_ends = std::fmin(caloric.specific_heat(here), caloric.specific_heat(there));
        if (!(std::fabs(there - here) > 1e-6 * here)) return at_ends;
        return std::fmin(at_ends, (caloric.enthalpy(there) - caloric.enthalpy(here)) / (there - here));
    }

    double step_ = 0.0;
    std::vector<double> coefficient_, source_;
};

}  // namespace hearth
