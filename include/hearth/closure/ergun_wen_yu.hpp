// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/ergun.hpp>
#include <hearth/closure/wen_yu.hpp>

namespace hearth::closure {

/// The pair ErgunWenYuDrag of OpenFOAM 2.4, which the paper uses: Ergun below void fraction 0.8, Wen and Yu from there.
/// Its force is Gidaspow's over e, so it belongs to momentum model b: the gas must feel the full pressure gradient.
/// Beside e grad p it would count the pressure on the particles twice.
struct ergun_wen_yu {
    HEARTH_FUNCTION static constexpr const char* name() { return "ergun_wen_yu"; }
    /// [-]
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.35, 1.0}; }
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return ergun::reynolds_range(); }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::b; }

    /// reynolds is on the interstitial slip [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) {
        using real = real_t<Scalar>;
        const Scalar dense = ergun::dimensionless_exchange(void_fraction, reynolds);
        const Scalar dilute = wen_yu::dimensionless_exchange(void_fraction, reynolds);
        return select(void_fraction < real(0.8), dense, dilute) / void_fraction;
    }
};

}  // namespace hearth::closure
