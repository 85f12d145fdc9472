// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/core/particle_halo.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/time/network_input.hpp>
#include <hearth/time/network_solver.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/time/tssm.hpp>

namespace hearth {

/// One implicit step of many particles that exchange heat with one another and with their baths: backward Euler, with
/// radiation on its secant (Picard), in two passes.  At any step size
///     temperatures stay between the least and the greatest of particles and baths, to 1e-9 of what lies between,
///     what one side of a pair loses the other gains.
/// The system of a pass is symmetric, with positive diagonal and no positive entry beside it.  The first pass only says
/// where the secants are taken and is solved roughly, the others tightly; energy closes in each (network_solver.hpp).
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
        double tolerance = 4e-10;  ///< of a temperature, over the range of those of particles and baths [-]
        int iterations = 20000;    ///< of conjugate gradients, per pass
    };

    struct report {
        int passes = 0;
        int iterations = 0;         ///< of all passes
        double error = 0.0;         ///< bound of the last pass: no temperature is farther from its solution [K]
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
    ///
    /// Over ranks: all ranks call it with their own particles and a halo.  The second of a pair may be a ghost, index
    /// temperature.size() + its place in the halo; such a pair stands in the list of each of the two ranks.  The result
    /// is that of one rank to the solver's tolerance, energy closes over all ranks, and bad input, lists that disagree
    /// included, is thrown on every rank.
    template <class Link, class Clock, class Mass, class CaloricOf, class Communicator = serial_communicator>
    report advance(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths,
                   const Mass& mass, const CaloricOf& caloric_of, const Clock& clock, double step,
                   std::vector<double>& temperature, std::vector<particle_step<double>>& taken,
                   const particle_halo<Communicator>& halo = {}) {
        detail::check_network(pairs, baths, mass, caloric_of, clock, step, temperature, halo);
        const std::size_t count = temperature.size();
        capacity_.resize(count);
        offset_.assign(count, 0.0);
        conductive_.resize(count);
        radiative_.resize(count);
        bath_radiation_.resize(count);
        deviation_.resize(count + halo.ghost_count());
        next_ = temperature;
        next_.resize(count + halo.ghost_count());
        system_.arrange(pairs, count, halo.ghost_count());
        islands_.reset(count + halo.ghost_count());
        system_.join(islands_);
        islands_.number(halo);
        const bounds within = bounds_of(baths, temperature, halo.communicator());
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
            if (radiation_moves) freeze_radiation(pairs, baths, halo);
            const bool rough = pass == 0 && params_.passes > 1;
            solve(baths, temperature, within.range, rough ? rough_tolerance * within.range : 0.0, halo, result);
            // The solution lies within; so does, from here, the place where the next pass takes its secants.
            for (double& t : next_) t = rough ? std::min(std::max(t, within.least), within.greatest) : t;
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
            missing = detail::sum_over_ranks(halo.communicator(), missing);
            allowed = detail::sum_over_ranks(halo.communicator(), allowed);
            result.missing_heat = missing * step;
            if (result.passes >= params_.passes && missing <= allowed) break;
            if (result.passes == params_.passes + params_.caloric_passes && missing > 1e3 * allowed)
                result.converged = false;
        }
        next_.resize(count);
        book(baths, mass, caloric_of, clock, step, temperature, taken);
        temperature = next_;
        return result;
    }

  private:
    /// Error of the first pass over the range of temperatures: the second forgets nine tenths of it or more [-].
    static constexpr double rough_tolerance = 1e-2;

    /// Of the temperatures of all particles and baths [K]; their range is not less than what doubles can tell apart.
    struct bounds {
        double least, greatest, range;
    };

    template <class Communicator>
    static bounds bounds_of(const std::vector<heat_bath<double>>& baths, const std::vector<double>& temperature,
                            const Communicator& ranks) {
        double least = std::numeric_limits<double>::max(), greatest = 0.0;
        for (std::size_t i = 0; i < temperature.size(); ++i) {
            for (const double t : {temperature[i], baths[i].conductive_temperature(temperature[i]),
                                   baths[i].radiative_temperature(temperature[i])}) {
                least = std::min(least, t);
                greatest = std::max(greatest, t);
            }
        }
        least = -ranks.max(-least);
        greatest = ranks.max(greatest);
        return {least, greatest, std::max(greatest - least, 1e-6 * greatest)};
    }

    template <class Link, class Communicator>
    void freeze_radiation(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths,
                          const particle_halo<Communicator>& halo) {
        halo.gather(next_);
        system_.freeze(pairs, next_);
        for (std::size_t i = 0; i < baths.size(); ++i) {
            conductive_[i] = baths[i].conductive_temperature(next_[i]);
            radiative_[i] = baths[i].radiative_temperature(next_[i]);
            bath_radiation_[i] = radiative_link<double>{baths[i].radiation}.secant(next_[i], radiative_[i]);
        }
    }

    /// Unknowns are deviations from each island's own mean of what pulls at it.  So the digits of small differences
    /// survive at huge steps, and a closed island keeps its energy.
    template <class Communicator>
    void solve(const std::vector<heat_bath<double>>& baths, const std::vector<double>& temperature, double range,
               double rough, const particle_halo<Communicator>& halo, report& result) {
        const std::size_t count = temperature.size();
        system_.diagonal.resize(count);
        system_.right.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            system_.diagonal[i] = capacity_[i] + baths[i].conductance + bath_radiation_[i];
        islands_.means(
            halo, system_.diagonal,
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
        const auto solved =
            system_.solve(halo, islands_, params_.tolerance * range, rough, params_.iterations, deviation_);
        result.iterations += solved.iterations;
        result.error = solved.error;
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
    std::vector<double> bath_radiation_;                // secants [W/K]
    std::vector<double> reference_, deviation_, next_;  // [K]
};

}  // namespace hearth
