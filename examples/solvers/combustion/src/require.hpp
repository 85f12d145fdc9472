// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <hearth/combustion/jones_lindstedt.hpp>
#include <hearth/combustion/reactor.hpp>
#include <hearth/combustion/species.hpp>
#include <hearth/core/error.hpp>

namespace hearth::combustion {

/// Throws bad_value unless the condition holds.
inline void require(bool holds, const char* place, double value, const char* allowed,
                    std::int64_t index = bad_value::no_index) {
    if (!holds) throw bad_value(place, index, value, allowed);
}

inline void require_mixture(const per_species& amount) {
    for (std::size_t k = 0; k < species_count; ++k)
        require(amount[k] >= 0 && std::isfinite(amount[k]), "amount of species", amount[k], "finite and >= 0 [mol/kg]",
                static_cast<std::int64_t>(k));
    require(sum(amount) > 0, "amount of mixture", sum(amount), "> 0 [mol/kg]");
}

inline void require_pressure(double pressure) {
    require(pressure > 0 && std::isfinite(pressure), "pressure", pressure, "finite and > 0 [Pa]");
}

inline void require_duration(const char* place, double seconds) {
    require(seconds >= 0 && std::isfinite(seconds), place, seconds, "finite and >= 0 [s]");
}

inline void require_mechanism(const jones_lindstedt& m) {
    const auto share = [](const char* place, double value) {
        require(value > 0 && value < 1, place, value, "in (0, 1) [-]");
    };
    share("regularisation", m.regularisation);
    share("water_seed", m.water_seed);
    share("oxygen_seed", m.oxygen_seed);
}

inline void require_tolerance(const tolerance& t) {
    require(t.relative >= 1e-13 && t.relative < 1, "relative tolerance", t.relative, "in [1e-13, 1) [-]");
    require(t.absolute >= 1e-16 && t.absolute < 1, "absolute tolerance", t.absolute, "in [1e-16, 1) [-]");
}

}  // namespace hearth::combustion
