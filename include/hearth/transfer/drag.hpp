// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>

#include <hearth/closure/drag.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth {

/// Force between gas and particles: drag on the slip with v / Gamma, and with a closure of model A each particle's
/// share -V_p grad p of the pressure.  The gas receives the drag with the opposite sign; the pressure's share it has in
/// its own term e grad p.  Forces are not multiplied by Gamma: the motion runs in the model's time.
template <class Closure>
struct drag : Closure {
    using reads = quantities<quantity::radius, quantity::velocity>;
    using writes = quantities<quantity::force>;
    using gas_reads = quantities<quantity::void_fraction, quantity::gas_density, quantity::gas_viscosity,
                                 quantity::gas_velocity, quantity::pressure_gradient>;
    using gas_writes = quantities<quantity::gas_force>;
    static constexpr act acts = act::gas_force;

    constexpr explicit drag(Closure closure) : Closure(std::move(closure)) {}

    template <class Particle, class Gas, class Clock>
    drag_exchange gas_force(const Particle& p, const Gas& g, const Clock& clock) const {
        const auto slip = detail::slip_velocity(p, g, clock);
        const double diameter = 2.0 * static_cast<double>(p[quantity::radius{}]);
        const closure::bed_flow<double> flow{static_cast<double>(g[quantity::void_fraction{}]), detail::length(slip),
                                             static_cast<double>(g[quantity::gas_density{}]),
                                             static_cast<double>(g[quantity::gas_viscosity{}]), diameter};
        drag_exchange result{closure::particle_coefficient(static_cast<const Closure&>(*this), flow), slip, {}};
        if constexpr (Closure::model() == closure::momentum_model::a) {
            const double volume = constants<double>::pi() / 6.0 * diameter * diameter * diameter;
            const auto& gradient = g[quantity::pressure_gradient{}];
            detail::for_each_axis(
                [&](std::size_t a) { result.pressure_force[a] = -volume * static_cast<double>(gradient[a]); });
        }
        return result;
    }
};
template <class Closure>
drag(Closure) -> drag<Closure>;

}  // namespace hearth
