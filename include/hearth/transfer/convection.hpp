// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <hearth/closure/intraparticle.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth {

/// The particle is at one temperature: h is the gas film's alone.
struct isothermal_particle {
    using reads = quantities<>;
    template <class Particle>
    static double effective(double h, const Particle&, double) {
        return h;
    }
};

/// Temperature falls inside the particle: closure::intraparticle corrects h for it.
struct parabolic_particle {
    using reads = quantities<quantity::conductivity>;
    template <class Particle>
    static double effective(double h, const Particle& p, double diameter) {
        return closure::intraparticle::transfer_coefficient(h, diameter,
                                                            static_cast<double>(p[quantity::conductivity{}]));
    }
};

/// The same, and counts where the Biot number passes 0.3.  The host owns the report, which belongs to one thread.
struct counted_parabolic_particle : parabolic_particle {
    closure::biot_report* report;
    explicit counted_parabolic_particle(closure::biot_report& owned_by_host) : report(&owned_by_host) {}

    template <class Particle>
    double effective(double h, const Particle& p, double diameter) const {
        report->add(closure::intraparticle::biot(h, diameter, static_cast<double>(p[quantity::conductivity{}])));
        return parabolic_particle::effective(h, p, diameter);
    }
};

namespace detail {
template <class A, class B>
struct joined;
template <class... A, class... B>
struct joined<quantities<A...>, quantities<B...>> {
    using type = quantities<A..., B...>;
};
}  // namespace detail

/// Heat between particles and gas:  Q = Nu k_g / d * pi d^2 (T_gas - T).
/// Nusselt: a closure with nusselt(void_fraction, reynolds, prandtl), Reynolds number on the superficial slip.
/// Paper: Eqs. 1, 11 and 14 with Gunn; the slip is with v / Gamma (Eq. 16).
template <class Nusselt, class Interior = isothermal_particle>
struct convection : Nusselt, Interior {
    using reads = typename detail::joined<quantities<quantity::radius, quantity::velocity, quantity::temperature>,
                                          typename Interior::reads>::type;
    using writes = quantities<quantity::heat_rate>;
    using gas_reads =
        quantities<quantity::void_fraction, quantity::gas_density, quantity::gas_viscosity, quantity::gas_conductivity,
                   quantity::gas_specific_heat, quantity::gas_velocity, quantity::gas_temperature>;
    using gas_writes = quantities<quantity::gas_heat_rate>;
    static constexpr act acts = act::gas_heat;

    constexpr explicit convection(Nusselt closure, Interior interior = Interior())
        : Nusselt(std::move(closure)), Interior(std::move(interior)) {}

    template <class Particle, class Gas, class Clock>
    conductive_link<double> gas_link(const Particle& p, const Gas& g, const Clock& clock) const {
        const double diameter = 2.0 * static_cast<double>(p[quantity::radius{}]);
        const double void_fraction = static_cast<double>(g[quantity::void_fraction{}]);
        const double viscosity = static_cast<double>(g[quantity::gas_viscosity{}]);
        const double conductivity = static_cast<double>(g[quantity::gas_conductivity{}]);
        const double superficial = void_fraction * detail::length(detail::slip_velocity(p, g, clock));
        const double reynolds = static_cast<double>(g[quantity::gas_density{}]) * superficial * diameter / viscosity;
        const double prandtl = static_cast<double>(g[quantity::gas_specific_heat{}]) * viscosity / conductivity;
        const double h = this->nusselt(void_fraction, reynolds, prandtl) * conductivity / diameter;
        return {Interior::effective(h, p, diameter) * constants<double>::pi() * diameter * diameter};
    }
};
template <class Nusselt>
convection(Nusselt) -> convection<Nusselt>;
template <class Nusselt, class Interior>
convection(Nusselt, Interior) -> convection<Nusselt, Interior>;

}  // namespace hearth
