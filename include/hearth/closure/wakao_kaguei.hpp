// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Heat or mass transfer between particles and gas in fixed beds:  Nu = 2 + 1.1 Pr^(1/3) Re^0.6.
/// Wakao, Kaguei, Funazkri, Chem. Eng. Sci. 34 (1979) 325, doi:10.1016/0009-2509(79)85064-2; mass transfer:
/// Wakao, Funazkri, Chem. Eng. Sci. 33 (1978) 1375, doi:10.1016/0009-2509(78)85120-3.
struct wakao_kaguei {
    HEARTH_FUNCTION static constexpr const char* name() { return "wakao_kaguei"; }
    /// Fixed beds of spheres; the correlation itself does not contain the void fraction [-].
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.35, 0.5}; }
    /// The data for heat; those for mass reach from 3 to 1e4 [-].
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {15.0, 8500.0}; }

    /// Nusselt number on the particle diameter [-].
    /// reynolds is on the superficial slip velocity and the particle diameter [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar nusselt(const Scalar&, const Scalar& reynolds, const Scalar& prandtl) {
        using real = real_t<Scalar>;
        return real(2) + real(1.1) * cube_root(prandtl) * power(reynolds, real(0.6));
    }

    /// Sherwood number on the particle diameter [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar sherwood(const Scalar& void_fraction, const Scalar& reynolds, const Scalar& schmidt) {
        return nusselt(void_fraction, reynolds, schmidt);
    }
};

}  // namespace hearth::closure
