// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Heat or mass transfer between particles and gas in fixed and fluidised beds.
/// Gunn, Int. J. Heat Mass Transfer 21 (1978) 467, doi:10.1016/0017-9310(78)90080-7.
/// Nu = (7 - 10 e + 5 e^2)(1 + 0.7 Re^0.2 Pr^(1/3)) + (1.33 - 2.4 e + 1.2 e^2) Re^0.7 Pr^(1/3),  e the void fraction.
/// Some codes put the interstitial velocity into Re, which overstates h by up to 1.7 in a bed.
struct gunn {
    HEARTH_FUNCTION static constexpr const char* name() { return "gunn"; }
    /// [-]
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.35, 1.0}; }
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {0.0, 1e5}; }

    /// Nusselt number on the particle diameter [-].
    /// reynolds is on the superficial slip velocity (void fraction times |u - v|) and the particle diameter [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar nusselt(const Scalar& void_fraction, const Scalar& reynolds, const Scalar& prandtl) {
        using real = real_t<Scalar>;
        const Scalar a = real(7) - void_fraction * (real(10) - real(5) * void_fraction);
        const Scalar b = real(1.33) - void_fraction * (real(2.4) - real(1.2) * void_fraction);
        const Scalar pr = cube_root(prandtl);
        return a * (real(1) + real(0.7) * power(reynolds, real(0.2)) * pr) + b * power(reynolds, real(0.7)) * pr;
    }

    /// Sherwood number on the particle diameter [-]: the same function of the Schmidt number.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar sherwood(const Scalar& void_fraction, const Scalar& reynolds, const Scalar& schmidt) {
        return nusselt(void_fraction, reynolds, schmidt);
    }
};

}  // namespace hearth::closure
