// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/drag.hpp>
#include <hearth/core/interval.hpp>

namespace hearth::closure {

/// Drag over all void fractions without a switch:  F = Cd pi d^2/8 rho e^(2 - x) |u-v| (u-v),
/// Cd = (0.63 + 4.8/sqrt(Re_s))^2, x = 3.7 - 0.65 exp(-(1.5 - log10 Re_s)^2 / 2), Re_s = e Re.
/// Di Felice, Int. J. Multiphase Flow 20 (1994) 153, doi:10.1016/0301-9322(94)90011-6, for fixed and suspended beds;
/// his summary gives no bounds: the ranges below are those of packed beds to single spheres, as other codes use it.
struct di_felice {
    HEARTH_FUNCTION static constexpr const char* name() { return "di_felice"; }
    /// [-]
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.4, 1.0}; }
    /// Interstitial, from creeping to fully turbulent flow [-].
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {0.0, 1e4}; }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::a; }

    /// 0.75 (0.63 sqrt(Re_s) + 4.8)^2 e^(1 - x) [-]: Cd Re_s, so that nothing diverges at rest.
    /// reynolds is on the interstitial slip [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) {
        using real = real_t<Scalar>;
        const Scalar superficial_reynolds = void_fraction * reynolds;
        // Below 1e-8 the bell is under 3e-20 of its top: x is 3.7, and its logarithm need not be taken at zero.
        const Scalar moving = at_least(superficial_reynolds, real(1e-8));
        const Scalar decades = real(1.5) - logarithm(moving) * real(0.434294481903251827651128918916605082L);
        const Scalar bell = exponential(Scalar(real(-0.5) * decades * decades));
        const Scalar exponent = real(0.65) * bell - real(2.7);
        const Scalar drag = square(Scalar(real(0.63) * square_root(superficial_reynolds) + real(4.8)));
        return real(0.75) * drag * variable_power(void_fraction, exponent);
    }
};

}  // namespace hearth::closure
