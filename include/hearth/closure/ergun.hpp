// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/drag.hpp>
#include <hearth/core/interval.hpp>

namespace hearth::closure {

/// Pressure drop of packed beds:  -dp/dx = 150 (1-e)^2 mu U / (e^3 d^2) + 1.75 (1-e) rho U^2 / (e^3 d),  U superficial.
/// Ergun, Chem. Eng. Prog. 48 (1952) 89; 150 and 1.75 are least squares over 640 experiments (as told by Quinn,
/// J. Mater. 2014, 548482, doi:10.1155/2014/548482, who doubts them).  The ranges below are those that textbooks give.
struct ergun {
    HEARTH_FUNCTION static constexpr const char* name() { return "ergun"; }
    /// Beds of spheres [-]; used up to 0.8 in fluidised beds, see gidaspow.
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.35, 0.5}; }
    /// Interstitial; the data reach 2500 in U d rho / (mu (1 - e)) [-].
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {0.0, 4000.0}; }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::a; }

    /// 150 (1 - e)/e + 1.75 Re [-].  reynolds is on the interstitial slip [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) {
        using real = real_t<Scalar>;
        return real(150) * (real(1) - void_fraction) / void_fraction + real(1.75) * reynolds;
    }

    struct paper;
};

/// Eq. 10 of Spijker et al. (2023, doi:10.1002/ceat.202200617) as printed: Ergun's gradient once more over e (1 - e).
/// The factor is 4.2 at e = 0.4 and has no counterpart in Ergun's work; here for comparison only.
/// The paper applies it where the solid fraction is above 0.1, so below that 1 - e counts as 0.1 in the factor.
struct ergun::paper {
    HEARTH_FUNCTION static constexpr const char* name() { return "ergun::paper"; }
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return ergun::void_fraction_range(); }
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return ergun::reynolds_range(); }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::a; }

    /// reynolds is on the interstitial slip [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) {
        using real = real_t<Scalar>;
        const Scalar solid = real(1) - void_fraction;
        const Scalar factor = void_fraction * at_least(solid, real(0.1));
        return ergun::dimensionless_exchange(void_fraction, reynolds) / factor;
    }
};

}  // namespace hearth::closure
