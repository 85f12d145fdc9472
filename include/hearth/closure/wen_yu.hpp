// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/drag.hpp>
#include <hearth/core/interval.hpp>

namespace hearth::closure {

/// Drag in dilute suspensions:  beta = 0.75 Cd e (1-e) rho |u-v| / d  e^-2.65,  Cd on Re_s = e Re.
/// Wen, Yu, Chem. Eng. Prog. Symp. Ser. 62 (1966) 100; Cd of Schiller and Naumann up to Re_s = 1000, 0.44 above.
struct wen_yu {
    HEARTH_FUNCTION static constexpr const char* name() { return "wen_yu"; }
    /// [-]
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.8, 1.0}; }
    /// Interstitial; above 2e5 the drag of a sphere falls, which 0.44 does not know [-].
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {0.0, 2e5}; }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::a; }

    /// Drag coefficient of a single sphere times its Reynolds number: 24 in creeping flow [-].
    /// Jumps by 0.4 % at 1000, as it is used everywhere.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar sphere_drag_times_reynolds(const Scalar& reynolds) {
        using real = real_t<Scalar>;
        const Scalar schiller_naumann = real(24) * (real(1) + real(0.15) * power(reynolds, real(0.687)));
        const Scalar newton = real(0.44) * reynolds;
        return select(reynolds <= real(1000), schiller_naumann, newton);
    }

    /// 0.75 Cd Re_s e^-2.65 [-].  reynolds is on the interstitial slip [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) {
        using real = real_t<Scalar>;
        const Scalar superficial_reynolds = void_fraction * reynolds;
        return real(0.75) * sphere_drag_times_reynolds(superficial_reynolds) * power(void_fraction, real(-2.65));
    }
};

}  // namespace hearth::closure
