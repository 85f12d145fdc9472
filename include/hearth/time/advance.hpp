// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/time/tssm.hpp>

namespace hearth {

namespace detail {

inline void require_positive(const char* place, std::int64_t index, double value, const char* allowed) {
    if (!(value > 0.0 && std::isfinite(value))) throw bad_value(place, index, value, allowed);
}
inline void require_not_negative(const char* place, std::int64_t index, double value, const char* allowed) {
    if (!(value >= 0.0 && std::isfinite(value))) throw bad_value(place, index, value, allowed);
}
inline void require_bath(const heat_bath<double>& bath, std::int64_t index) {
    require_not_negative("bath conductance of particle", index, bath.conductance, "finite and >= 0 [W/K]");
    require_not_negative("bath conductance times temperature of particle", index, bath.conductance_times_t,
                         "finite and >= 0 [W]");
    require_not_negative("bath radiation of particle", index, bath.radiation, "finite and >= 0 [W/K^4]");
    require_not_negative("bath radiation times T^4 of particle", index, bath.radiation_times_t4, "finite and >= 0 [W]");
}

/// What every step of many particles asks of its input.
template <class Clock, class Mass, class CaloricOf>
void check_particles(const std::vector<heat_bath<double>>& baths, const Mass& mass, const CaloricOf& caloric_of,
                     const Clock& clock, double step, const std::vector<double>& temperature) {
    require_positive("step", bad_value::no_index, step, "finite and > 0 [s]");
    const auto size_is = [&](const char* name, std::size_t size) {
        if (size != temperature.size())
            throw bad_value(name, bad_value::no_index, static_cast<double>(size), "as many as temperatures");
    };
    size_is("number of baths", baths.size());
    size_is("number of masses", mass.size());
    for (std::size_t i = 0; i < temperature.size(); ++i) {
        const auto index = static_cast<std::int64_t>(i);
        require_positive("temperature of particle", index, temperature[i], "finite and > 0 [K]");
        require_positive("mass of particle", index, mass[i], "finite and > 0 [kg]");
        require_positive("specific_heat of particle", index, caloric_of(i).specific_heat(temperature[i]),
                         "finite and > 0 [J/(kg K)]");
        check_acceleration_factor(clock.factor(i), index);
        require_bath(baths[i], index);
    }
}

}  // namespace detail

/// Advances particles that exchange with baths alone by a step of the model [s], each with the integrator Scheme
/// (particle_energy.hpp) in its own time; for particles that exchange with one another see thermal_network.
/// mass[i] [kg]; caloric_of(i) is the particle's caloric; temperature [K]; taken[i] is what it received.
/// Throws bad_value, before it changes anything, for numbers that are not finite or have the wrong sign.
template <class Scheme = etd2_secant, class Clock, class Mass, class CaloricOf>
void advance(const std::vector<heat_bath<double>>& baths, const Mass& mass, const CaloricOf& caloric_of,
             const Clock& clock, double step, std::vector<double>& temperature,
             std::vector<particle_step<double>>& taken) {
    detail::check_particles(baths, mass, caloric_of, clock, step, temperature);
    taken.resize(temperature.size());
    for (std::size_t i = 0; i < temperature.size(); ++i) {
        taken[i] = Scheme::advance(temperature[i], mass[i], caloric_of(i), baths[i], clock.factor(i) * step);
        temperature[i] = taken[i].temperature;
    }
}

}  // namespace hearth
