// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/quadrature.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Two particles, or a particle and a wall, with resting gas between them.
template <class Scalar>
struct film_pair {
    Scalar gap;               ///< distance of the surfaces, < 0 for a contact; of the true modulus, see hertz.hpp [m]
    Scalar radius_i;          ///< [m]
    Scalar radius_j;          ///< not used at a wall [m]
    Scalar conductivity_i;    ///< [W/(m K)], > 0
    Scalar conductivity_j;    ///< not used at a wall, which is taken at the temperature of its surface [W/(m K)]
    Scalar gas_conductivity;  ///< [W/(m K)], >= 0
    Scalar void_fraction;     ///< of the bed around [-]
};

/// Conduction from particle to particle through the gas in the wedge around their contact or near-contact.
/// Cheng, Yu, Zulli, Chem. Eng. Sci. 54 (1999) 4199, doi:10.1016/S0009-2509(99)00125-6: heat flows in rings along the
/// line of centres, in the solid up to the double cone of the pair's Voronoi cell of radius r_v = 0.56 R (1-e)^(-1/3):
/// H = int 2 pi r dr / ((w - r (R+g)/r_v)(1/k1 + 1/k2) + 2/k_g (R + g - w)),  w = sqrt(R^2 - r^2), g half the gap,
/// from the contact's rim (r^2 = R^2 - (R+g)^2 if g < 0, else 0) to the cone's r = R r_v / sqrt(r_v^2 + (R+g)^2).
/// For unequal radii R is 2 R1 R2/(R1 + R2), which keeps the shape of the narrow gap [assumption].
/// The contact itself is left to a closure of contact conduction; the two add up.
struct gas_film {
    /// Packed and dense fluidised beds [-].
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.35, 0.7}; }

    /// Conductance of a pair [W/K].  0 where the gap exceeds the radius: too far apart to be a pair.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar conductance(const film_pair<Scalar>& pair) {
        using real = real_t<Scalar>;
        const Scalar radius = real(2) * pair.radius_i * pair.radius_j / (pair.radius_i + pair.radius_j);
        const Scalar half_gap = real(0.5) * pair.gap;
        const Scalar solid = pair.gas_conductivity * (real(1) / pair.conductivity_i + real(1) / pair.conductivity_j);
        return pair.gas_conductivity * shape(radius, half_gap, pair.void_fraction, solid, real(2));
    }

    /// Conductance between a particle and a wall [W/K]: twice that of the pair of the particle and its mirror image,
    /// in whose middle lies the wall.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar wall_conductance(const film_pair<Scalar>& pair) {
        const Scalar solid = pair.gas_conductivity / pair.conductivity_i;
        return pair.gas_conductivity * shape(pair.radius_i, pair.gap, pair.void_fraction, solid, real_t<Scalar>(1));
    }

    /// The integral over k_g: int 2 pi w dw / ((w - r q) solid + faces (R + g - w)) [m].
    /// In w the rim's root is gone, and R - w = rim + s sinh^2(y) spreads the narrow gap, where the heat flows, evenly:
    /// eight-point Gauss-Legendre in y is good to 1e-5 for solids 1 to 1e5 times as conductive as the gas.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar shape(const Scalar& radius, const Scalar& half_gap, const Scalar& void_fraction,
                                        const Scalar& solid, real_t<Scalar> faces) {
        using real = real_t<Scalar>;
        using rule = gauss_legendre<real>;
        const Scalar zero = uniform(radius, real(0));
        const Scalar middle = radius + half_gap;                  // R + g
        const Scalar open = at_least(half_gap, real(0));          // narrowest gap
        const Scalar rim = at_least(Scalar(-half_gap), real(0));  // R - w at the rim
        const Scalar rim_radius = square_root(Scalar(rim * (real(2) * radius - rim)));
        const Scalar q = middle / radius * cube_root(Scalar(real(1) - void_fraction)) / real(0.56);
        const Scalar outer = radius * q / square_root(Scalar(real(1) + q * q));  // w at the cone
        const Scalar span = at_least(Scalar(radius - rim - outer), real(0));

        // Where solid and gas resist alike; only the nodes' places depend on it.
        const Scalar balance = (radius - rim - rim_radius * q) * solid / faces + open;
        const Scalar scale = maximum(balance, Scalar(real(1e-12L) * radius));
        const Scalar reach = square_root(Scalar(span / scale));
        const Scalar last = logarithm(Scalar(reach + square_root(Scalar(real(1) + reach * reach))));

        Scalar sum = zero;
        for (int k = 0; k < rule::count(); ++k) {
            const Scalar e = exponential(Scalar(last * rule::node(k)));
            const Scalar sinh = real(0.5) * (e - real(1) / e);
            const Scalar cosh = real(0.5) * (e + real(1) / e);
            const Scalar depth = scale * sinh * sinh;  // w below the rim
            const Scalar fallen = rim + depth;         // R - w
            const Scalar w = radius - fallen;
            const Scalar r = square_root(Scalar(fallen * (real(2) * radius - fallen)));
            sum = sum + rule::weight(k) * w * sinh * cosh / ((w - r * q) * solid + faces * (open + depth));
        }
        const Scalar integral = real(4) * constants<real>::pi() * scale * last * sum;
        return select(half_gap > real(0.5) * radius, zero, integral);
    }
};

/// Conduction through the gas where the lens of gas around one particle, of 1.2 times its radius, meets the other.
/// Rong, Horio, 2nd Int. Conf. on CFD in the Minerals and Process Industries, Melbourne 1999, 65, as MFIX uses it:
/// H = k_g int 2 pi r dr / max(gap(r), 4e-10 m), particles without resistance of their own.  For unequal radii R is
/// 2 R1 R2/(R1 + R2) [assumption].  The integral is done in closed form.
struct rong_horio {
    /// The source states none; it serves from packed to dilute beds [-].
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.35, 1.0}; }

    /// Conductance of a pair [W/K]; 0 beyond the lens.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar conductance(const film_pair<Scalar>& pair) {
        using real = real_t<Scalar>;
        const Scalar radius = real(2) * pair.radius_i * pair.radius_j / (pair.radius_i + pair.radius_j);
        return pair.gas_conductivity * shape(radius, Scalar(real(0.5) * pair.gap));
    }

    /// Conductance between a particle and a wall [W/K]: twice that of the particle and its mirror image.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar wall_conductance(const film_pair<Scalar>& pair) {
        return real_t<Scalar>(2) * pair.gas_conductivity * shape(pair.radius_i, pair.gap);
    }

    /// int 2 pi r dr / max(gap, least) [m].  With t half the gap at r it is int 2 pi (R + g - t) / max(2 t, least) dt.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar shape(const Scalar& radius, const Scalar& half_gap) {
        using real = real_t<Scalar>;
        const real least = real(4e-10);
        const Scalar middle = radius + half_gap;
        const Scalar from = at_least(half_gap, real(0));
        const Scalar to = maximum(Scalar(real(0.11) * radius * radius / middle), from);  // (1.2^2 - 1)/4
        const Scalar clipped = minimum(at_least(from, real(0.5) * least), to);
        const Scalar flat = (clipped - from) * (middle - real(0.5) * (clipped + from)) / least;
        const Scalar wedge = middle * logarithm(Scalar(to / clipped)) - (to - clipped);
        return constants<real>::pi() * (real(2) * flat + wedge);
    }
};

}  // namespace hearth::closure
