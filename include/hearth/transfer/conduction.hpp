// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

#include <hearth/closure/gas_film.hpp>
#include <hearth/closure/hertz.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/core/contact_traits.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth {

namespace detail {

/// Cube root of x > 0 (not a denormal number) to a few units in the last place, several times as fast as std::cbrt: a
/// third of the exponent as a first guess of 1 over it, good to 4 %, then two steps of fourth order without a division.
inline double fast_cube_root(double x) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    bits = 0x553ef0ff289dd796u - bits / 3;
    double y;
    std::memcpy(&y, &bits, sizeof y);
    for (int pass = 0; pass < 2; ++pass) {
        const double off = 1.0 - x * y * y * y;
        y += y * off * (1.0 / 3.0 + off * (2.0 / 9.0 + off * (14.0 / 81.0)));
    }
    return x * y * y;
}

}  // namespace detail

/// What conducts at a contact besides the particles: elasticities of the true, unsoftened materials, and the wall.
struct contact_materials {
    closure::elastic<double> particle{2.0e11, 0.3};
    closure::elastic<double> wall{2.0e11, 0.3};
    double wall_conductivity = 0.0;  ///< [W/(m K)]; 0: no conduction to walls
};

/// Heat through the contacts of particles with one another and with walls; the contact radius is Hertz's from the
/// elastic normal force with the true modulus, however soft the motion is. Closure: one of closure::zhang.  Paper: Eqs.
/// 2 and 3.
template <class Closure>
struct conduction : Closure {
    contact_materials materials;

    using reads = quantities<quantity::radius, quantity::conductivity, quantity::temperature>;
    using writes = quantities<quantity::heat_rate>;
    using gas_reads = quantities<>;
    using gas_writes = quantities<>;
    static constexpr act acts = act::contact;

    constexpr explicit conduction(Closure closure, contact_materials contact = {})
        : Closure(std::move(closure)), materials(contact) {}

    template <class Particle, class Gas>
    conductive_link<double> contact_link(const Particle& p, const Particle& q, const Gas&, const Gas&,
                                         const contact& touch) const {
        const double radius_p = static_cast<double>(p[quantity::radius{}]);
        const double radius_q = static_cast<double>(q[quantity::radius{}]);
        return link(touch.normal_force, closure::hertz::effective_radius(radius_p, radius_q),
                    closure::hertz::effective_modulus(materials.particle, materials.particle),
                    static_cast<double>(p[quantity::conductivity{}]), static_cast<double>(q[quantity::conductivity{}]),
                    radius_p, radius_q);
    }

    template <class Particle, class Gas>
    conductive_link<double> wall_contact_link(const Particle& p, const Gas&, const contact& touch) const {
        if (!(materials.wall_conductivity > 0.0)) return {0.0};
        const double radius = static_cast<double>(p[quantity::radius{}]);
        return link(touch.normal_force, radius, closure::hertz::effective_modulus(materials.particle, materials.wall),
                    static_cast<double>(p[quantity::conductivity{}]), materials.wall_conductivity, radius, 0.0);
    }

  private:
    conductive_link<double> link(double force, double effective_radius, double modulus, double conductivity_i,
                                 double conductivity_j, double radius_i, double radius_j) const {
        const double cube = 0.75 * force * effective_radius / modulus;
        const double contact_radius = cube > 1e-290 ? detail::fast_cube_root(cube)
                                                    : closure::hertz::contact_radius(force, effective_radius, modulus);
        return {this->conductance(
            closure::contact_pair<double>{contact_radius, force, conductivity_i, conductivity_j, radius_i, radius_j})};
    }
};

template <class Closure>
conduction(Closure) -> conduction<Closure>;
template <class Closure>
conduction(Closure, contact_materials) -> conduction<Closure>;

/// Heat from particle to particle through the gas around their contact or narrow gap.
/// Distances are those of the motion, whose overlap is too large where it is softened: `overlap_scale` brings the
/// geometric overlap to the true one, (E_soft / E_true)^(2/3); see closure::hertz::true_overlap.
template <class Closure = closure::gas_film>
struct film_conduction : Closure {
    double overlap_scale;

    using reads = quantities<quantity::radius, quantity::conductivity, quantity::temperature>;
    using writes = quantities<quantity::heat_rate>;
    using gas_reads = quantities<quantity::void_fraction, quantity::gas_conductivity>;
    using gas_writes = quantities<>;
    static constexpr act acts = act::nearby;

    constexpr explicit film_conduction(Closure closure = {}, double true_over_softened_overlap = 1.0)
        : Closure(std::move(closure)), overlap_scale(true_over_softened_overlap) {}

    /// The film counts for gaps up to the radius.
    static constexpr double reach() { return 1.5; }

    template <class Particle, class Gas>
    conductive_link<double> near_link(const Particle& p, const Particle& q, const Gas& g, const Gas& h,
                                      double distance) const {
        const double radius_p = static_cast<double>(p[quantity::radius{}]);
        const double radius_q = static_cast<double>(q[quantity::radius{}]);
        const double gap = distance - radius_p - radius_q;
        const double gas = 0.5 * (static_cast<double>(g[quantity::gas_conductivity{}]) +
                                  static_cast<double>(h[quantity::gas_conductivity{}]));
        const double void_fraction = 0.5 * (static_cast<double>(g[quantity::void_fraction{}]) +
                                            static_cast<double>(h[quantity::void_fraction{}]));
        return {Closure::conductance(closure::film_pair<double>{
            gap < 0.0 ? gap * overlap_scale : gap, radius_p, radius_q, static_cast<double>(p[quantity::conductivity{}]),
            static_cast<double>(q[quantity::conductivity{}]), gas, void_fraction})};
    }
};
template <class Closure>
film_conduction(Closure) -> film_conduction<Closure>;
template <class Closure>
film_conduction(Closure, double) -> film_conduction<Closure>;

}  // namespace hearth
