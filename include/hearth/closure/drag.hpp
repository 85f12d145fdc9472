// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Gas that flows past the particles of a bed.
template <class Scalar>
struct bed_flow {
    Scalar void_fraction;  ///< [-]
    Scalar slip_speed;  ///< |u - v| of interstitial gas and particle; times the void fraction it is superficial [m/s]
    Scalar density;     ///< of the gas [kg/m^3]
    Scalar viscosity;   ///< of the gas, dynamic [Pa s]
    Scalar diameter;    ///< of the particles [m]
};

/// Who carries the pressure gradient.
/// a: gas feels e grad p, each particle its share V_p grad p, and the drag acts beside them.
/// b: gas feels the full grad p, particles none, and the drag contains the pressure's work on them (1/e larger).
enum class momentum_model { a, b };

// Every drag closure is one function of two numbers, of which the free functions below make forces and gradients:
//     static constexpr momentum_model model();
//     Scalar dimensionless_exchange(void_fraction, reynolds)  =  beta d^2 / ((1 - e) mu)   [-]
// with reynolds on the interstitial slip.  It is finite at e = 1 and at Re = 0: 18 is Stokes' drag.

/// Particle Reynolds number on the interstitial slip [-].
template <class Scalar>
HEARTH_FUNCTION Scalar reynolds(const bed_flow<Scalar>& flow) {
    return flow.density * flow.slip_speed * flow.diameter / flow.viscosity;
}

/// beta: force on the particles per volume of bed and slip velocity [kg/(m^3 s)].
template <class Drag, class Scalar>
HEARTH_FUNCTION Scalar exchange_coefficient(const Drag& drag, const bed_flow<Scalar>& flow) {
    using real = real_t<Scalar>;
    const Scalar exchange = drag.dimensionless_exchange(flow.void_fraction, reynolds(flow));
    return (real(1) - flow.void_fraction) * exchange * flow.viscosity / square(flow.diameter);
}

/// Force on one particle per slip velocity: V_p beta / (1 - e) [kg/s].
template <class Drag, class Scalar>
HEARTH_FUNCTION Scalar particle_coefficient(const Drag& drag, const bed_flow<Scalar>& flow) {
    using real = real_t<Scalar>;
    const Scalar exchange = drag.dimensionless_exchange(flow.void_fraction, reynolds(flow));
    return constants<real>::pi() / real(6) * exchange * flow.viscosity * flow.diameter;
}

/// -dp/dx of steady flow through a resting homogeneous bed, whichever the model [Pa/m].
template <class Drag, class Scalar>
HEARTH_FUNCTION Scalar pressure_gradient(const Drag& drag, const bed_flow<Scalar>& flow) {
    const Scalar sink = exchange_coefficient(drag, flow) * flow.slip_speed;
    if (Drag::model() == momentum_model::b) return sink;
    return sink / flow.void_fraction;
}

}  // namespace hearth::closure
