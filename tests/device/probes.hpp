// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include <hearth/core/thermal_link.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/limits.hpp>
#include <hearth/time/particle_energy.hpp>

#include "support/closure_probes.hpp"

/// What hosts may call in GPU kernels, each in the form of closure_probes.hpp: the closures, the integrators of a
/// particle and the limits of the step.
namespace hearth_test {

namespace probes {

/// Temperature after a step against gas and radiation.
template <class Scheme>
struct integrator {
    static constexpr description<7> about() {
        return {std::is_same_v<Scheme, hearth::explicit_euler>   ? "explicit_euler"
                : std::is_same_v<Scheme, hearth::backward_euler> ? "backward_euler"
                                                                 : "etd2_secant",
                {{{250, 2500},     // own temperature
                  {1e-3, 1e-2},    // mass
                  {1e-2, 1},       // conductance to gas
                  {250, 2500},     // gas
                  {1e-12, 1e-10},  // radiation
                  {250, 2500},     // surroundings
                  {1e-4, 0.1}}}};  // step, stable for the explicit scheme
    }
    template <class Real>
    HEARTH_FUNCTION Real operator()(const Real* x) const {
        const hearth::polynomial_specific_heat<2, Real> caloric{{Real(700), Real(0.2L)}, Real(-1e6L), Real(298.15L)};
        hearth::heat_bath<Real> bath;
        bath.add(hearth::conductive_link<Real>{x[2]}, x[3]);
        bath.add(hearth::radiative_link<Real>{x[4]}, x[5]);
        return Scheme::advance(x[0], x[1], caloric, bath, x[6]).temperature;
    }
};

/// The stable steps, as one number that feels each of them.
struct stable_steps {
    static constexpr description<6> about() {
        return {"stable_step", {{{1e-3, 1}, {1e-12, 1e-10}, {250, 2500}, {1, 100}, {1e-6, 1}, {1, 1000}}}};
    }
    template <class Real>
    HEARTH_FUNCTION Real operator()(const Real* x) const {
        namespace limit = hearth::stable_step;
        hearth::heat_bath<Real> bath;
        bath.add(hearth::thermal_link<Real>{x[0], x[1]}, x[2]);
        const Real thermal = limit::particle(bath, x[3], x[2], x[5]) + limit::pair(x[0], x[3], x[4], x[5]) +
                             limit::particle_and_gas(x[0], x[3], x[4], x[5]);
        const Real moving = limit::drag(x[0], x[4]) + limit::contact(x[3], x[4]) + limit::advection(x[4], x[3]) +
                            limit::diffusion(x[4], x[0], 3) + limit::depletion(x[4], x[0], x[5]);
        return thermal + moving;
    }
};

}  // namespace probes

template <class Visit>
void for_each_device_function(Visit&& visit) {
    for_each_closure(visit);
    visit(probes::integrator<hearth::explicit_euler>{});
    visit(probes::integrator<hearth::backward_euler>{});
    visit(probes::integrator<hearth::etd2_secant>{});
    visit(probes::stable_steps{});
}

}  // namespace hearth_test
