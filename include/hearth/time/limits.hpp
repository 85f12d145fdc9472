// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <hearth/core/function.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/time/network_solver.hpp>
#include <hearth/time/particle_energy.hpp>

namespace hearth {

/// Largest stable steps of explicit processes [s], by the model's clock: Gamma is the argument `factor` of each limit
/// that it shortens.  Above the limit an explicit scheme grows without bound; below half of it, it does not even
/// oscillate. Infinite where nothing is exchanged.  Implicit and exponential schemes (particle_energy.hpp,
/// thermal_network.hpp, gas_exchange.hpp) have no limit.
namespace stable_step {

namespace detail {
template <class Real>
HEARTH_FUNCTION Real over(Real numerator, Real denominator) {
    return denominator > Real(0) ? numerator / denominator : Real(HUGE_VAL);
}
}  // namespace detail

/// A particle against its bath, near temperature [K]; capacity = m c_p [J/K].  With radiation alone this is
/// 2 m c_p / (4 r T^3 Gamma).  Take the highest temperature that the particle may reach.
template <class Real>
HEARTH_FUNCTION Real particle(const heat_bath<Real>& bath, Real capacity, Real temperature, Real factor = Real(1)) {
    const Real slope = bath.conductance + Real(4) * bath.radiation * temperature * temperature * temperature;
    return detail::over(Real(2) * capacity, factor * slope);
}

/// A particle and the gas of its cell, both explicit; gas_capacity = V e rho c of the gas times its storage factor s,
/// conductance = h A [W/K].  Scale: 1 mm^3 of gas round a 10 mm particle allows 20 microseconds.
template <class Real>
HEARTH_FUNCTION Real particle_and_gas(Real conductance, Real particle_capacity, Real gas_capacity,
                                      Real factor = Real(1)) {
    return detail::over(Real(2), conductance * (factor / particle_capacity + Real(1) / gas_capacity));
}

/// Two bodies that exchange heat, both explicit, by contact or radiation near one temperature; slope: conductance plus
/// 4 r T^3 [W/K].
template <class Real>
HEARTH_FUNCTION Real pair(Real slope, Real first_capacity, Real second_capacity, Real factor = Real(1)) {
    return detail::over(Real(2), slope * factor * (Real(1) / first_capacity + Real(1) / second_capacity));
}

/// Many particles that exchange heat with one another and with baths, explicit, near their own temperatures: from
/// Gershgorin's bound of the spectrum.  Safe for any network; sharp (the bound is attained) where the particles of a
/// closed island fall into two groups that touch each other only and all rates are equal.
/// capacity[i] = m c_p / Gamma [J/K].  Over ranks temperature holds the ghosts' behind the owned ones, and the least of
/// the ranks' steps counts.
template <class Link>
double network(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths,
               const std::vector<double>& capacity, const std::vector<double>& temperature) {
    std::vector<double> own(temperature.size(), 0.0), bath(capacity.size(), 0.0);
    for (std::size_t i = 0; i < baths.size(); ++i)
        bath[i] = baths[i].conductance + 4.0 * baths[i].radiation * std::pow(temperature[i], 3);
    for (const linked_pair<Link>& pair : pairs) {
        const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
        const thermal_link<double> link = widened(pair.link);
        // The derivatives of the pair's heat by the two temperatures differ where these do; both bound a row.
        const double warmer = std::fmax(temperature[a], temperature[b]);
        const double slope = link.conductance + 4.0 * link.radiation * warmer * warmer * warmer;
        own[a] += slope;
        own[b] += slope;
    }
    double rate = 0.0;
    for (std::size_t i = 0; i < capacity.size(); ++i) rate = std::fmax(rate, (2.0 * own[i] + bath[i]) / capacity[i]);
    return detail::over(2.0, rate);
}

/// Drag on a particle, explicit; coefficient = force over slip [N s/m], mass [kg].  Motion is not accelerated.
template <class Real>
HEARTH_FUNCTION Real drag(Real coefficient, Real mass) {
    return detail::over(Real(2) * mass, coefficient);
}

/// A contact of two bodies as a spring, by leapfrog (velocity Verlet, symplectic Euler); stiffness at the largest
/// overlap [N/m], reduced mass m1 m2 / (m1 + m2) [kg].
template <class Real>
HEARTH_FUNCTION Real contact(Real stiffness, Real reduced_mass) {
    return Real(2) * std::sqrt(detail::over(reduced_mass, stiffness));
}

/// Courant's limit of explicit upwind transport; storage_factor is s of the clock (1 without splitting), which also
/// bounds the gas: less storage, shorter step.  0 for a quasi-steady gas: solve it implicitly.
template <class Real>
HEARTH_FUNCTION Real advection(Real spacing, Real speed, Real storage_factor = Real(1)) {
    return detail::over(storage_factor * spacing, std::fabs(speed));
}

/// Explicit diffusion on a lattice of that spacing in so many dimensions; diffusivity [m^2/s].
template <class Real>
HEARTH_FUNCTION Real diffusion(Real spacing, Real diffusivity, int dimensions, Real storage_factor = Real(1)) {
    return detail::over(storage_factor * spacing * spacing, Real(2 * dimensions) * diffusivity);
}

/// Explicit loss of a stock (the water of a drying particle): the step that takes all of it; rate > 0 [kg/s].
template <class Real>
HEARTH_FUNCTION Real depletion(Real stock, Real rate, Real factor = Real(1)) {
    return detail::over(stock, factor * rate);
}

}  // namespace stable_step
}  // namespace hearth
