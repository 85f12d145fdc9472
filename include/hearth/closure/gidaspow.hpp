// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/ergun.hpp>
#include <hearth/closure/wen_yu.hpp>

namespace hearth::closure {

/// Drag over all void fractions: Ergun up to 0.8, Wen and Yu above.  Jumps there, by up to a factor of four.
/// Gidaspow, Multiphase Flow and Fluidization, Academic Press 1994.
struct gidaspow {
    HEARTH_FUNCTION static constexpr const char* name() { return "gidaspow"; }
    /// [-]
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.35, 1.0}; }
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return ergun::reynolds_range(); }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::a; }

    /// reynolds is on the interstitial slip [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) {
        using real = real_t<Scalar>;
        const Scalar dense = ergun::dimensionless_exchange(void_fraction, reynolds);
        const Scalar dilute = wen_yu::dimensionless_exchange(void_fraction, reynolds);
        return select(void_fraction <= real(0.8), dense, dilute);
    }
};

}  // namespace hearth::closure
