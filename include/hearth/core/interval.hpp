// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/function.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth {

/// The closed interval [lo, hi] in which a closure was fitted.
/// Compared in the precision of the argument, so that 0.35f lies in [0.35, 1].
struct interval {
    double lo;
    double hi;

    /// True, lane by lane, where lo <= x <= hi; false for NaN.
    template <class Scalar>
    HEARTH_FUNCTION constexpr auto contains(const Scalar& x) const {
        using real = real_t<Scalar>;
        return x >= real(lo) && x <= real(hi);
    }

    /// The nearest value inside.  NaN stays NaN.
    template <class Scalar>
    HEARTH_FUNCTION constexpr value_t<Scalar> clamp(const Scalar& x) const {
        using real = real_t<Scalar>;
        return at_most(at_least(x, real(lo)), real(hi));
    }
};

}  // namespace hearth
