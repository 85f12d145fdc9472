// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/time/advance.hpp>
#include <hearth/time/network_solver.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/time/tssm.hpp>

namespace hearth {

/// One implicit step of many particles that exchange heat with one another and with their baths: backward Euler, with
/// radiation on its secant (Picard), in two passes.  At any step size
///     temperatures stay between the least and the greatest of particles and baths,
///     what one side of a pair loses the other gains.
/// The system of a pass is symmetric, with positive diagonal and no positive entry beside it: conjugate gradients solve
/// it tightly, over the list of pairs, without a matrix, in one order of operations.
///
/// A plain linearisation of T^4 is not offered: it overshoots a wall at 2500 K to 16 600 K.
///
/// cp(T): the first passes take the secant of the enthalpy; where it bends, further passes on its tangent follow, with
/// the radiation frozen, until no energy is missing.
class thermal_network {
  public:
    struct params {
        int passes = 2;            ///< one pass lags: 10 K on a chain of 50 spheres where two are 0.4 K off
        int caloric_passes = 30;   ///< at most; none for a constant specific heat
        double tolerance = 1e-14;  ///< of the residual over the right-hand side, both in the diagonal's norm [-]
        int iterations = 20000;    ///< of conjugate gradients, per pass
    };

    struct report {
        int passes = 0;
        int iterations = 0;         ///< of all passes
        double residual = 0.0;      ///< largest of all passes, relative [-]
        double missing_heat = 0.0;  ///< enthalpy that the passes left unbooked: sum over particles of |.| / Gamma [J]
        bool converged = true;
    };

    thermal_network() = default;
    /// Throws bad_value for settings that cannot solve anything.
    explicit thermal_network(params settings) : params_(settings) {
        const auto at_least = [](const char* name, int value, int least, const char* allowed) {
            if (value < least) throw bad_value(name, bad_value::no_index, value, allowed);
        };
        at_least("passes", params_.passes, 1, ">= 1");
        at_least("caloric_passes", params_.caloric_passes, 0, ">= 0");
        at_least("iterations", params_.iterations, 1, ">= 1");
        if (!(params_.tolerance > 0.0 && params_.tolerance < 1.0))
            throw bad_value("tolerance", bad_value::no_index, params_.tolerance, "in (0, 1)");
    }

    /// Advances the temperatures [K] by a step of the model [s].  mass[i] [kg]; caloric_of(i) is the particle's caloric
    /// (see caloric.hpp); taken[i] holds what the particle received, in its own time: its enthalpy change, and of it
    /// the parts that its bath gave (the rest came from pairs). Throws bad_value, before it changes anything, for
    /// numbers that are not finite or have the wrong sign and for pairs with an index out of range or with itself.
    template <class Link, class Clock, class Mass, class CaloricOf>
    report advance(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths,
                   const Mass& mass, const CaloricOf& caloric_of, const Clock& clock, double step,
                   std::vector<double>& temperature, std::vector<particle_step<double>>& taken) {
        check(pairs, baths, mass, caloric_of, clock, step, temperature);
        const std::size_t count = temperature.size();
        islands_.find(pairs, count);
        capacity_.resize(count);
        offset_.assign(count, 0.0);
        conductive_.resize(count);
        radiative_.resize(count);
        deviation_.resize(count);
        link_.resize(pairs.size());
        bath_radiation_.resize(count);
        next_ = temperature;
        const auto per_time = [&](std::size_t i) { return mass[i] / (clock.factor(i) * step); };

        report result;
        for (int pass = 0; pass < params_.passes + params_.caloric_passes; ++pass) {
            const bool radiation_moves = pass < params_.passes;
            for (std::size_t i = 0; i < count; ++i) {
                const auto& caloric = caloric_of(i);
                const double known = temperature[i], latest = next_[i];
                const double gained = per_time(i) * (caloric.enthalpy(latest) - caloric.enthalpy(known));
                if (!radiation_moves) {
                    capacity_[i] = per_time(i) * caloric.specific_heat(latest);
                    offset_[i] = gained - capacity_[i] * (latest - known);
                } else {
                    // A secant over less than this would be round-off over round-off.
                    const bool near = !(std::fabs(latest - known) > 1e-6 * known);
                    capacity_[i] = near ? per_time(i) * caloric.specific_heat(latest) : gained / (latest - known);
                }
            }
            if (radiation_moves) freeze_radiation(pairs, baths);
            solve(pairs, baths, temperature, result);
            ++result.passes;
            if (!result.converged) break;

            double missing = 0.0, allowed = 0.0;
            for (std::size_t i = 0; i < count; ++i) {
                const auto& caloric = caloric_of(i);
                const double now = caloric.enthalpy(next_[i]), before = caloric.enthalpy(temperature[i]);
                const double booked = capacity_[i] * (next_[i] - temperature[i]) + offset_[i];
                missing += std::fabs(booked - per_time(i) * (now - before));
                allowed += 1e-13 * std::fabs(booked) + 1e-15 * per_time(i) * (std::fabs(now) + std::fabs(before));
            }
            result.missing_heat = missing * step;
            if (result.passes >= params_.passes && missing <= allowed) break;
            if (result.passes == params_.passes + params_.caloric_passes && missing > 1e3 * allowed)
                result.converged = false;
        }
        book(baths, mass, caloric_of, clock, step, temperature, taken);
        temperature = next_;
        return result;
    }

  private:
    template <class Link, class Clock, class Mass, class CaloricOf>
    static void check(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths,
                      const Mass& mass, const CaloricOf& caloric_of, const Clock& clock, double step,
                      const std::vector<double>& temperature) {
        detail::check_particles(baths, mass, caloric_of, clock, step, temperature);
        const auto count = static_cast<std::int64_t>(temperature.size());
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const auto index = static_cast<std::int64_t>(k);
            const linked_pair<Link>& pair = pairs[k];
            const bool in_range = pair.first >= 0 && pair.first < count && pair.second >= 0 && pair.second < count;
            if (!in_range || pair.first == pair.second)
                throw bad_value("second particle of pair", index, pair.second,
                                "two different indices of particles, first is " + std::to_string(pair.first));
            const thermal_link<double> link = widened(pair.link);
            detail::require_not_negative("conductance of pair", index, link.conductance, "finite and >= 0 [W/K]");
            detail::require_not_negative("radiation of pair", index, link.radiation, "finite and >= 0 [W/K^4]");
        }
    }

    template <class Link>
    void freeze_radiation(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths) {
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const linked_pair<Link>& pair = pairs[k];
            link_[k] = pair.link.secant(next_[static_cast<std::size_t>(pair.first)],
                                        next_[static_cast<std::size_t>(pair.second)]);
        }
        for (std::size_t i = 0; i < baths.size(); ++i) {
            conductive_[i] = baths[i].conductive_temperature(next_[i]);
            radiative_[i] = baths[i].radiative_temperature(next_[i]);
            bath_radiation_[i] = radiative_link<double>{baths[i].radiation}.secant(next_[i], radiative_[i]);
        }
    }

    /// Unknowns are deviations from each island's own mean of what pulls at it.  So the digits of small differences
    /// survive at huge steps, and a closed island keeps its energy.
    template <class Link>
    void solve(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths,
               const std::vector<double>& temperature, report& result) {
        const std::size_t count = temperature.size();
        system_.diagonal.resize(count);
        system_.right.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            system_.diagonal[i] = capacity_[i] + baths[i].conductance + bath_radiation_[i];
        islands_.means(
            system_.diagonal,
            [&](std::size_t i) {
                return capacity_[i] * temperature[i] + baths[i].conductance * conductive_[i] +
                       bath_radiation_[i] * radiative_[i];
            },
            reference_);
        for (std::size_t i = 0; i < count; ++i) {
            const double reference = reference_[islands_.of(i)];
            system_.right[i] = capacity_[i] * (temperature[i] - reference) - offset_[i] +
                               baths[i].conductance * (conductive_[i] - reference) +
                               bath_radiation_[i] * (radiative_[i] - reference);
            deviation_[i] = next_[i] - reference;
        }
        const auto solved = system_.solve(pairs, link_, islands_, params_.tolerance, params_.iterations, deviation_);
        result.iterations += solved.iterations;
        result.residual = std::fmax(result.residual, solved.residual);
        result.converged = solved.converged;
        for (std::size_t i = 0; i < count; ++i) next_[i] = reference_[islands_.of(i)] + deviation_[i];
    }

    template <class Clock, class Mass, class CaloricOf>
    void book(const std::vector<heat_bath<double>>& baths, const Mass& mass, const CaloricOf& caloric_of,
              const Clock& clock, double step, const std::vector<double>& temperature,
              std::vector<particle_step<double>>& taken) const {
        taken.resize(temperature.size());
        for (std::size_t i = 0; i < temperature.size(); ++i) {
            const auto& caloric = caloric_of(i);
            const double reference = reference_[islands_.of(i)];
            const double own_step = clock.factor(i) * step;
            taken[i] = {next_[i], mass[i] * (caloric.enthalpy(next_[i]) - caloric.enthalpy(temperature[i])),
                        own_step * baths[i].conductance * ((conductive_[i] - reference) - deviation_[i]),
                        own_step * bath_radiation_[i] * ((radiative_[i] - reference) - deviation_[i])};
        }
    }

    params params_;
    detail::islands islands_;
    detail::network_system system_;
    std::vector<double> capacity_, offset_;             // [W/K], [W]
    std::vector<double> conductive_, radiative_;        // temperatures of the baths [K]
    std::vector<double> bath_radiation_, link_;         // secants [W/K]
    std::vector<double> reference_, deviation_, next_;  // [K]
};

}  // namespace hearth
