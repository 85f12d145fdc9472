// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Heat or mass transfer of a single sphere in free flow:  Nu = 2 + 0.6 Re^(1/2) Pr^(1/3).
/// Ranz, Marshall, Chem. Eng. Prog. 48 (1952) 141 and 173.
struct ranz_marshall {
    HEARTH_FUNCTION static constexpr const char* name() { return "ranz_marshall"; }
    /// A single sphere; the correlation itself does not contain the void fraction [-].
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.99, 1.0}; }
    /// The authors' drops reach Re = 200 [-].
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {0.0, 200.0}; }

    /// Nusselt number on the particle diameter [-].
    /// reynolds is on the slip velocity and the particle diameter [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar nusselt(const Scalar&, const Scalar& reynolds, const Scalar& prandtl) {
        using real = real_t<Scalar>;
        return real(2) + real(0.6) * square_root(reynolds) * cube_root(prandtl);
    }

    /// Sherwood number on the particle diameter [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar sherwood(const Scalar& void_fraction, const Scalar& reynolds, const Scalar& schmidt) {
        return nusselt(void_fraction, reynolds, schmidt);
    }
};

}  // namespace hearth::closure
