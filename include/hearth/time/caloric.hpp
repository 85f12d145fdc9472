// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include <hearth/core/function.hpp>

namespace hearth {

/// A caloric says how much heat a material holds.  Anything serves that has
///
///     Real enthalpy(Real temperature)          [J/kg], increasing
///     Real temperature(Real enthalpy)          [K], its inverse
///     Real specific_heat(Real temperature)     [J/(kg K)], its slope
///
/// Integrators go from temperature to temperature through the enthalpy, so energy is exact for any cp(T).

/// Constant specific heat; enthalpy is 0 at 0 K.
template <class Real = double>
struct constant_specific_heat {
    Real value;  ///< [J/(kg K)]

    HEARTH_FUNCTION constexpr Real enthalpy(Real temperature) const { return value * temperature; }
    HEARTH_FUNCTION constexpr Real temperature(Real enthalpy) const { return enthalpy / value; }
    HEARTH_FUNCTION constexpr Real specific_heat(Real) const { return value; }
};

/// Specific heat a0 + a1 T + a2 T^2 + ... + c T^-2, the form of most handbooks (Maier & Kelley 1932,
/// doi:10.1021/ja01347a029, has a0, a1 and c).  Enthalpy is 0 at `reference`.  The specific heat must be > 0 wherever
/// the particle may come; the inverse is a bracketed Newton that ends within 4 round-offs.
template <std::size_t Count, class Real = double>
struct polynomial_specific_heat {
    Real coefficients[Count];        ///< a0, a1, ...  [J/(kg K^(k+1))]
    Real inverse_square = Real(0);   ///< c  [J K/kg]
    Real reference = Real(298.15L);  ///< [K]

    HEARTH_FUNCTION Real specific_heat(Real t) const {
        Real value = Real(0);
        for (std::size_t k = Count; k-- > 0;) value = value * t + coefficients[k];
        return value + inverse_square / (t * t);
    }

    HEARTH_FUNCTION Real enthalpy(Real t) const { return primitive(t) - primitive(reference); }

    HEARTH_FUNCTION Real temperature(Real enthalpy_wanted) const {
        const Real wanted = enthalpy_wanted + primitive(reference);
        Real t = reference;
        Real low = Real(0), high = Real(0);  // 0: not known yet
        for (int pass = 0; pass < 200; ++pass) {
            const Real excess = primitive(t) - wanted;
            if (excess > Real(0))
                high = t;
            else
                low = t;
            Real next = t - excess / specific_heat(t);
            // Outside of what is known the slope misled: halve what is known, or double or halve where one side is
            // open.
            if (!(next > low)) next = high > Real(0) ? (low + high) / Real(2) : t * Real(2);
            if (high > Real(0) && !(next < high)) next = (low + high) / Real(2);
            const Real change = std::fabs(next - t);
            t = next;
            if (!(change > Real(2) * rounding() * t)) break;
        }
        return t;
    }

  private:
    HEARTH_FUNCTION static constexpr Real rounding() {
        return sizeof(Real) == sizeof(float) ? Real(1.1920929e-7L) : Real(2.220446049250313e-16L);
    }
    HEARTH_FUNCTION Real primitive(Real t) const {
        Real value = Real(0);
        for (std::size_t k = Count; k-- > 0;) value = (value + coefficients[k] / Real(k + 1)) * t;
        return value - inverse_square / t;
    }
};

}  // namespace hearth
