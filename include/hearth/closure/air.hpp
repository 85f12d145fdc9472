// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Properties of dry air as an ideal gas at low pressure.
struct air {
    /// [K]
    HEARTH_FUNCTION static constexpr interval temperature_range() { return {200.0, 2400.0}; }
    /// [kg/mol]
    HEARTH_FUNCTION static constexpr double molar_mass() { return 0.028965; }

    /// [kg/m^3]
    template <class Scalar>
    HEARTH_FUNCTION static Scalar density(const Scalar& temperature, const Scalar& pressure) {
        using real = real_t<Scalar>;
        return pressure * real(molar_mass()) / (constants<real>::gas_constant() * temperature);
    }

    /// Dynamic viscosity [Pa s]: Sutherland, Phil. Mag. 36 (1893) 507, with 1.716e-5 Pa s at 273.15 K and S = 110.4 K.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar viscosity(const Scalar& temperature) {
        using real = real_t<Scalar>;
        const Scalar ratio = temperature / real(273.15);
        return real(1.716e-5) * ratio * square_root(ratio) * real(383.55) / (temperature + real(110.4));
    }

    /// Thermal conductivity 2.646e-3 T^1.5/(T + 245.4 10^(-12/T)) [W/(m K)]: U.S. Standard Atmosphere 1976, Eq. 53.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar conductivity(const Scalar& temperature) {
        using real = real_t<Scalar>;
        const Scalar cold = exponential(Scalar(real(-12 * 2.302585092994045684L) / temperature));
        return real(2.646e-3) * temperature * square_root(temperature) / (temperature + real(245.4) * cold);
    }

    /// Specific heat at constant pressure [J/(kg K)]: 21 % oxygen and 79 % nitrogen by mole, NASA's seven-coefficient
    /// polynomials as in GRI-Mech 3.0, in two branches that meet at 1000 K within 1e-4.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar specific_heat(const Scalar& temperature) {
        using real = real_t<Scalar>;
        const Scalar& t = temperature;
        const Scalar oxygen_cold =
            real(3.78245636) + t * (real(-2.99673416e-3) +
                                    t * (real(9.84730201e-6) + t * (real(-9.68129509e-9) + t * real(3.24372837e-12))));
        const Scalar oxygen_hot =
            real(3.28253784) + t * (real(1.48308754e-3) +
                                    t * (real(-7.57966669e-7) + t * (real(2.09470555e-10) - t * real(2.16717794e-14))));
        const Scalar nitrogen_cold =
            real(3.298677) +
            t * (real(1.4082404e-3) + t * (real(-3.963222e-6) + t * (real(5.641515e-9) - t * real(2.444854e-12))));
        const Scalar nitrogen_hot =
            real(2.92664) +
            t * (real(1.4879768e-3) + t * (real(-5.68476e-7) + t * (real(1.0097038e-10) - t * real(6.753351e-15))));
        const Scalar oxygen = select(t < real(1000), oxygen_cold, oxygen_hot);
        const Scalar nitrogen = select(t < real(1000), nitrogen_cold, nitrogen_hot);
        return constants<real>::gas_constant() / real(molar_mass()) * (real(0.21) * oxygen + real(0.79) * nitrogen);
    }

    /// Prandtl number [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar prandtl(const Scalar& temperature) {
        return specific_heat(temperature) * viscosity(temperature) / conductivity(temperature);
    }
};

}  // namespace hearth::closure
