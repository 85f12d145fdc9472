// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/function.hpp>

namespace hearth {

/// Constants of nature and of convention, in SI units.
/// Functions, because a static constexpr object that is bound to a reference is undefined in device code.
template <class Real>
struct constants {
    /// Circle constant [-].
    HEARTH_FUNCTION static constexpr Real pi() { return Real(3.14159265358979323846264338327950288L); }

    /// Stefan-Boltzmann constant, exact since 2019 up to its digits here (CODATA 2018) [W/(m^2 K^4)].
    HEARTH_FUNCTION static constexpr Real stefan_boltzmann() { return Real(5.670374419e-8L); }

    /// Molar gas constant, exact since 2019 (CODATA 2018) [J/(mol K)].
    HEARTH_FUNCTION static constexpr Real gas_constant() { return Real(8.31446261815324L); }

    /// Standard acceleration of free fall (CGPM 1901) [m/s^2].
    HEARTH_FUNCTION static constexpr Real standard_gravity() { return Real(9.80665L); }

    /// Standard atmosphere (CGPM 1954); with zero_celsius the state of a normal cubic metre (DIN 1343) [Pa].
    HEARTH_FUNCTION static constexpr Real standard_atmosphere() { return Real(101325.0L); }

    /// 0 degrees Celsius [K].
    HEARTH_FUNCTION static constexpr Real zero_celsius() { return Real(273.15L); }
};

}  // namespace hearth
