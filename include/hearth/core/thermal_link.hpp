// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <hearth/core/function.hpp>

namespace hearth {

/// How two bodies exchange heat.  A transfer term states a link once; explicit rates, implicit systems and step limits
/// all read the same statement.  There are three kinds, so that a scene without radiation never computes a T^4:
///
///     conductive_link    conductance (T_there - T_here)
///     radiative_link     radiation (T_there^4 - T_here^4)
///     thermal_link       both
///
/// Each has
///     heat(here, there)      heat rate into `here` [W]
///     secant(here, there)    heat rate over difference of temperatures, > 0 [W/(K)]
/// and links of any kinds add up.
template <class Real>
struct conductive_link {
    Real conductance;  ///< >= 0 [W/K]

    HEARTH_FUNCTION constexpr Real secant(const Real&, const Real&) const { return conductance; }
    HEARTH_FUNCTION constexpr Real heat(const Real& here, const Real& there) const {
        return conductance * (there - here);
    }
};

template <class Real>
struct radiative_link {
    Real radiation;  ///< Stefan-Boltzmann constant times exchange area, >= 0 [W/K^4]

    HEARTH_FUNCTION constexpr Real secant(const Real& here, const Real& there) const {
        return radiation * (here + there) * (here * here + there * there);
    }
    HEARTH_FUNCTION constexpr Real heat(const Real& here, const Real& there) const {
        // In this form the difference of close temperatures keeps its digits, and equal ones exchange exactly nothing.
        return secant(here, there) * (there - here);
    }
};

template <class Real>
struct thermal_link {
    Real conductance;  ///< >= 0 [W/K]
    Real radiation;    ///< >= 0 [W/K^4]

    HEARTH_FUNCTION constexpr Real secant(const Real& here, const Real& there) const {
        return conductance + radiation * (here + there) * (here * here + there * there);
    }
    HEARTH_FUNCTION constexpr Real heat(const Real& here, const Real& there) const {
        return secant(here, there) * (there - here);
    }
};

template <class Real>
HEARTH_FUNCTION constexpr thermal_link<Real> widened(const conductive_link<Real>& link) {
    return {link.conductance, Real(0)};
}
template <class Real>
HEARTH_FUNCTION constexpr thermal_link<Real> widened(const radiative_link<Real>& link) {
    return {Real(0), link.radiation};
}
template <class Real>
HEARTH_FUNCTION constexpr thermal_link<Real> widened(const thermal_link<Real>& link) {
    return link;
}

/// Two particles that exchange heat, by their local indices.
template <class Link>
struct linked_pair {
    std::int32_t first;
    std::int32_t second;
    Link link;
};

}  // namespace hearth
