// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/drag.hpp>
#include <hearth/core/interval.hpp>

namespace hearth::closure {

/// Drag of random arrays of equal spheres from lattice-Boltzmann simulations, on average within 10 % of them.
/// Beetstra, van der Hoef, Kuipers, AIChE J. 53 (2007) 489, doi:10.1002/aic.11065, 35 pairs of void fraction and
/// Reynolds number up to 1000; as it stands in MFIX.
/// beta = 18 mu e (1-e) F / d^2 with p = 1 - e, Re_s = e Re and
/// F = 10 p/e^2 + e^2 (1 + 1.5 sqrt(p)) + 0.413 Re_s/(24 e^2) (1/e + 3 e p + 8.4 Re_s^-0.343) / (1 + 10^(3p) Re_s^-c),
/// c = (1 + 4p)/2.
struct beetstra {
    HEARTH_FUNCTION static constexpr const char* name() { return "beetstra"; }
    /// [-]
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.4, 1.0}; }
    /// Interstitial; the simulations reach Re_s = 1000 [-].
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {0.0, 1000.0}; }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::a; }

    /// 18 e F [-].  reynolds is on the interstitial slip [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) {
        using real = real_t<Scalar>;
        const Scalar solid = real(1) - void_fraction;
        const Scalar squared = square(void_fraction);
        const Scalar rest = real(10) * solid / squared + squared * (real(1) + real(1.5) * square_root(solid));
        // Below 1e-18 inertia is less than 1e-20 of the drag; the floor keeps the derivatives of its powers finite.
        // Numerator and denominator are multiplied by Re_s^c, so that none of them is negative.
        const Scalar moving = at_least(Scalar(void_fraction * reynolds), real(1e-18));
        const Scalar rise = variable_power(moving, Scalar(real(0.5) + real(2) * solid));
        const Scalar ten = exponential(Scalar(real(3) * real(2.302585092994045684017991454684364208L) * solid));
        const Scalar inertia = moving * (real(1) / void_fraction + real(3) * void_fraction * solid) +
                               real(8.4) * power(moving, real(0.657));
        return real(18) * void_fraction * (rest + real(0.413) / real(24) * inertia * rise / ((rise + ten) * squared));
    }
};

}  // namespace hearth::closure
