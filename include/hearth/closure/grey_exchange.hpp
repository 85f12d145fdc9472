// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Radiation between two isothermal bodies, and what reflection in a bed of grey spheres leaves of the black exchange.
///
/// Black exchange is sigma A F (Tj^4 - Ti^4).  In a bed of diffuse grey spheres it is multiplied by a factor R of the
/// emissivity e, the same for every pair: R is the ratio of the bed's radiative conductivity to that of a black bed by
/// own ray tracing with reflection (statistical error 0.3 %): 0.254 at e = 0.2, 0.404 at 0.4, 0.619 at 0.65, 0.833 at
/// 0.86, 1 at 1; between them a straight line.  The three packings, solid fraction 0.579 to 0.637, differ by 3 % at
/// 0.65 and 1 % at 0.86.  e/(2 - e), parallel planes, is too low by up to half of itself; the two-surface formula per
/// pair is far too high. R does not vanish with e, as reflection carries heat too; below the last node nothing is known
/// and R stays 0.254.
class grey_exchange {
  public:
    /// Throws bad_value unless emissivity is in (0, 1] [-].
    explicit grey_exchange(double emissivity = 1) : factor_(bed_factor(emissivity)) {
        if (!(emissivity > 0 && emissivity <= 1))
            throw bad_value("emissivity of closure grey_exchange", bad_value::no_index, emissivity, "in (0, 1] [-]");
    }

    /// Of the nodes [-].
    HEARTH_FUNCTION static constexpr interval emissivity_range() { return {0.2, 1.0}; }

    /// R [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar bed_factor(const Scalar& emissivity) {
        using real = real_t<Scalar>;
        // Each term is what one bend of the chain of lines takes away; a black bed is exactly 1.
        const real first = (real(1) - real(0.833)) / real(0.14);
        const real second = (real(0.833) - real(0.619)) / real(0.21);
        const real third = (real(0.619) - real(0.404)) / real(0.25);
        const real fourth = (real(0.404) - real(0.254)) / real(0.2);
        return real(1) - below(emissivity, 1.0) * first - below(emissivity, 0.86) * (second - first) -
               below(emissivity, 0.65) * (third - second) - below(emissivity, 0.4) * (fourth - third) +
               below(emissivity, 0.2) * fourth;
    }

    /// R of this bed [-].
    HEARTH_FUNCTION double factor() const { return factor_; }

    /// Heat rate into i [W]; exchange_area is A F [m^2].  Exactly the negative of that into j, and exactly 0 at equal
    /// temperatures, also where the compiler fuses multiplications and additions.
    template <class Scalar>
    HEARTH_FUNCTION Scalar heat_rate(const Scalar& exchange_area, const Scalar& temperature_i,
                                     const Scalar& temperature_j) const {
        return conductance(exchange_area, temperature_i, temperature_j) * (temperature_j - temperature_i);
    }

    /// Heat rate over difference of temperatures, the secant, > 0: R sigma A F (Ti + Tj)(Ti^2 + Tj^2) [W/K].
    /// At equal temperatures it is the derivative, 4 R sigma A F T^3.
    template <class Scalar>
    HEARTH_FUNCTION Scalar conductance(const Scalar& exchange_area, const Scalar& temperature_i,
                                       const Scalar& temperature_j) const {
        using real = real_t<Scalar>;
        // 2 (Ti^2 + Tj^2) = (Ti + Tj)^2 + (Ti - Tj)^2, which is symmetric to the last bit.
        const Scalar sum = temperature_i + temperature_j;
        const Scalar difference = temperature_i - temperature_j;
        const Scalar squares = sum * sum + difference * difference;
        return real(factor_) * constants<real>::stefan_boltzmann() * exchange_area * (real(0.5) * sum * squares);
    }

  private:
    template <class Scalar>
    HEARTH_FUNCTION static Scalar below(const Scalar& emissivity, double bend) {
        using real = real_t<Scalar>;
        const Scalar missing = real(bend) - emissivity;
        return at_least(missing, real(0));
    }

    double factor_;
};

}  // namespace hearth::closure
