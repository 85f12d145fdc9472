// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <hearth/core/particle_traits.hpp>
#include <hearth/core/quantity.hpp>

namespace hearth {

/// A term states one piece of physics once and does not loop.  A scene (scene/scene.hpp) fuses all its terms into one
/// loop of each kind.  A term is any type with
///
///     using reads      = quantities<...>;   what it asks of a particle
///     using writes     = quantities<...>;   rates that it adds to a particle
///     using gas_reads  = quantities<...>;   what it asks of the gas at a particle
///     using gas_writes = quantities<...>;   rates that it adds to the gas there
///     static constexpr act acts             the kinds of exchange below that it has
///
/// and for each kind its statement, where p, q are particles and g, h the gas at them, as views: p[quantity::radius{}].
///
///     act::gas_heat    link gas_link(p, g, clock)               heat between particle and gas
///     act::gas_force   drag_exchange gas_force(p, g, clock)     momentum between particle and gas
///     act::gas_mass    vapour_exchange gas_mass(p, g, clock)    water from particle to gas
///     act::contact     link contact_link(p, q, g, h, contact)   heat between touching particles
///                      link wall_contact_link(p, g, contact)    heat between a particle and a wall in touch
///     act::nearby      link near_link(p, q, g, h, distance)     heat between particles near each other
///                      double reach()                           of it, in diameters
///     act::views       radiation: see transfer/radiation.hpp
///
/// A link is conductive_link, radiative_link or thermal_link (core/thermal_link.hpp).  Heat counts positive into p.
enum class act : unsigned { none = 0, gas_heat = 1, gas_force = 2, gas_mass = 4, contact = 8, nearby = 16, views = 32 };

constexpr act operator|(act a, act b) { return static_cast<act>(static_cast<unsigned>(a) | static_cast<unsigned>(b)); }

/// True where a term has this kind of exchange.
template <class Term>
constexpr bool has_act(act kind) {
    return (static_cast<unsigned>(Term::acts) & static_cast<unsigned>(kind)) != 0;
}

/// One element of a host's data: a particle, or the gas at it.  view[quantity::radius{}] is what the host's traits
/// give.
template <class Host>
class view {
  public:
    using index = particle_index_t<Host>;
    view(const Host& host, index i) : host_(&host), index_(i) {}

    template <class Tag>
    decltype(auto) operator[](Tag tag) const {
        return detail::particles_of<Host>::get(tag, *host_, index_);
    }
    index number() const { return index_; }

  private:
    const Host* host_;
    index index_;
};

/// Momentum between a particle and its gas.
struct drag_exchange {
    double coefficient;                    ///< force per slip velocity [N s/m]
    std::array<double, 3> slip;            ///< gas less true particle velocity [m/s]
    std::array<double, 3> pressure_force;  ///< on the particle alone: the gas has it in its own pressure term [N]
};

/// Water that leaves a particle as vapour.
struct vapour_exchange {
    double rate;             ///< < 0 for condensation [kg/s]
    double latent_heat;      ///< that the particle pays [J/kg]
    double vapour_enthalpy;  ///< that the gas receives with it [J/kg]
};

namespace detail {

/// visit(0), visit(1), visit(2), written out: compilers keep a vector's components in registers where they leave a loop
/// over them in memory.
template <class Visit>
constexpr void for_each_axis(Visit&& visit) {
    visit(std::size_t{0});
    visit(std::size_t{1});
    visit(std::size_t{2});
}

/// Interstitial slip of the gas past the true motion of a particle [m/s].
template <class Particle, class Gas, class Clock>
std::array<double, 3> slip_velocity(const Particle& p, const Gas& g, const Clock& clock) {
    const auto& u = g[quantity::gas_velocity{}];
    const auto v = clock.true_velocity(p.number(), p[quantity::velocity{}]);
    return {static_cast<double>(u[0]) - static_cast<double>(v[0]),
            static_cast<double>(u[1]) - static_cast<double>(v[1]),
            static_cast<double>(u[2]) - static_cast<double>(v[2])};
}

inline double length(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace detail
}  // namespace hearth
