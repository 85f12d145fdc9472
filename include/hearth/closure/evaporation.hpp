// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Properties of water that drying needs.
struct water {
    /// [kg/mol]
    HEARTH_FUNCTION static constexpr double molar_mass() { return 0.018015268; }
    /// [K]
    HEARTH_FUNCTION static constexpr double critical_temperature() { return 647.096; }
    /// [Pa]
    HEARTH_FUNCTION static constexpr double critical_pressure() { return 22.064e6; }

    /// Of saturation_pressure: triple to critical point [K].
    HEARTH_FUNCTION static constexpr interval saturation_range() { return {273.16, 647.096}; }
    /// Of latent_heat [K].
    HEARTH_FUNCTION static constexpr interval latent_heat_range() { return {273.16, 523.15}; }
    /// Of diffusivity_in_air [K].
    HEARTH_FUNCTION static constexpr interval diffusivity_range() { return {280.0, 450.0}; }

    /// Vapour pressure over liquid water [Pa]; that of the critical point above it.
    /// Wagner, Pruss, J. Phys. Chem. Ref. Data 31 (2002) 387, Eq. 2.5, doi:10.1063/1.1461829; within 0.03 %.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar saturation_pressure(const Scalar& temperature) {
        using real = real_t<Scalar>;
        const Scalar t = below_critical(temperature);
        const Scalar root = square_root(t);
        const Scalar t3 = cube(t);
        const Scalar series = t * (real(-7.85951783) + root * real(1.84408259)) +
                              t3 * (real(-11.7866497) + root * real(22.6807411) - t * real(15.9618719)) +
                              t3 * t3 * t * root * real(1.80122502);
        const real critical = real(critical_temperature());
        return real(critical_pressure()) * exponential(Scalar(critical / temperature * series));
    }

    /// Heat of evaporation [J/kg]; 0 above the critical point.
    /// Own fit to the steam tables of IAPWS-95 (2500.9, 2256.4, 1939.7, 1715.2 kJ/kg at 0.01, 100, 200, 250 C, as
    /// handbooks print them): within 0.03 % up to 200 C, 0.1 % up to 250 C, 1 % low at 300 C, up to 20 % low close to
    /// the critical point.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar latent_heat(const Scalar& temperature) {
        using real = real_t<Scalar>;
        const Scalar t = below_critical(temperature);
        return square_root(t) * (real(4.4500508e6) + t * (real(-3.1769119e6) + t * real(2.0229465e6)));
    }

    /// Diffusion coefficient of vapour in air, 1.87e-10 T^2.072 / (p / 1 atm) [m^2/s].
    /// Marrero, Mason, J. Phys. Chem. Ref. Data 1 (1972) 3, doi:10.1063/1.3253094.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar diffusivity_in_air(const Scalar& temperature, const Scalar& pressure) {
        using real = real_t<Scalar>;
        return real(1.87e-10) * power(temperature, real(2.072)) * (constants<real>::standard_atmosphere() / pressure);
    }

  private:
    template <class Scalar>
    HEARTH_FUNCTION static Scalar below_critical(const Scalar& temperature) {
        using real = real_t<Scalar>;
        const Scalar t = real(1) - temperature / real(critical_temperature());
        return at_least(t, real(0));
    }
};

/// A wet sphere in gas.
template <class Scalar>
struct wet_sphere {
    Scalar diameter;          ///< [m]
    Scalar sherwood;          ///< [-]
    Scalar diffusivity;       ///< of the vapour in the gas, at film_temperature [m^2/s]
    Scalar film_temperature;  ///< mean of surface and gas [K]
    Scalar pressure;          ///< of the gas [Pa]
    Scalar surface_pressure;  ///< of vapour at the surface, the saturation pressure of a wet one [Pa]
    Scalar gas_pressure;      ///< of vapour in the gas [Pa]
};

/// Evaporation of water from a wet sphere through the film of gas around it.
struct evaporation {
    /// Mass that leaves the sphere, < 0 for condensation: pi d Sh D M/(R T) p ln((p - p_gas)/(p - p_surface)) [kg/s].
    /// Diffusion of vapour through gas that itself rests (Stefan, Sitzungsber. Akad. Wiss. Wien 68 (1873) 385).  Gas
    /// that is more than 99 % vapour counts as 99 %.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar mass_rate(const wet_sphere<Scalar>& sphere) {
        using real = real_t<Scalar>;
        const Scalar dry = sphere.pressure - sphere.gas_pressure;
        const Scalar b =
            (sphere.surface_pressure - sphere.gas_pressure) / maximum(dry, Scalar(real(0.01) * sphere.pressure));
        const Scalar conductance = constants<real>::pi() * real(water::molar_mass()) * sphere.diameter *
                                   sphere.sherwood * sphere.diffusivity /
                                   (constants<real>::gas_constant() * sphere.film_temperature);
        return conductance * sphere.pressure * b * stefan_factor(b);
    }

    /// What the outflow of vapour adds to its diffusion: -ln(1 - b)/b with b = (p_surface - p_gas)/(p - p_gas) [-].
    /// Above b = 0.99 the factor stays 4.65: it would grow without bound towards the boiling point, where no film but
    /// the supply of heat limits the rate.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar stefan_factor(const Scalar& b) {
        using real = real_t<Scalar>;
        const Scalar left = at_least(Scalar(real(1) - b), real(0.01));
        // With the rounded 1 - b in both places the quotient keeps its digits at small b.
        const Scalar taken = left - real(1);
        const auto none = taken == real(0);
        return select(none, uniform(b, real(1)), Scalar(logarithm(left) / select(none, uniform(b, real(1)), taken)));
    }
};

}  // namespace hearth::closure
