// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/drag.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/interval.hpp>

namespace hearth::closure {

/// Pressure drop of packed beds of spheres in a tube, with the wall's friction and the looser packing beside it.
/// Eisfeld, Schnitzlein, Chem. Eng. Sci. 56 (2001) 4321, doi:10.1016/S0009-2509(00)00533-9; constants for spheres.
/// -dp/dx = (154 Aw^2 + Aw/Bw Re_s/(1-e)) mu U (1-e)^2 / (d^2 e^3), U superficial, r = d/D,
/// Aw = 1 + 2 r/(3 (1-e)), Bw = (1.15 r^2 + 0.87)^2.
class eisfeld_schnitzlein {
  public:
    HEARTH_FUNCTION static constexpr const char* name() { return "eisfeld_schnitzlein"; }

    /// tube_to_particle is D/d [-]; infinity for a bed without walls.  Throws bad_value unless D/d >= 1.
    explicit eisfeld_schnitzlein(double tube_to_particle) : particle_to_tube_(1 / tube_to_particle) {
        if (!(tube_to_particle >= 1))
            throw bad_value("tube_to_particle of closure eisfeld_schnitzlein", bad_value::no_index, tube_to_particle,
                            ">= 1 [-]");
    }

    /// [-]
    HEARTH_FUNCTION static constexpr interval void_fraction_range() { return {0.33, 0.88}; }
    /// Interstitial; the data reach 17635 in superficial flow and down to D/d = 1.6 [-].
    HEARTH_FUNCTION static constexpr interval reynolds_range() { return {0.0, 2e4}; }
    HEARTH_FUNCTION static constexpr momentum_model model() { return momentum_model::a; }

    /// 154 Aw^2 (1-e)/e + Aw/Bw Re [-].  reynolds is on the interstitial slip [-].
    /// The tube's friction is spread over the particles' volume: in Aw a solid fraction below 0.01 counts as 0.01.
    template <class Scalar>
    HEARTH_FUNCTION Scalar dimensionless_exchange(const Scalar& void_fraction, const Scalar& reynolds) const {
        using real = real_t<Scalar>;
        const real ratio = real(particle_to_tube_);
        const real root = real(1.15) * ratio * ratio + real(0.87);
        const Scalar solid = real(1) - void_fraction;
        const Scalar wall = real(1) + real(2) / real(3) * ratio / at_least(solid, real(0.01));
        return wall * (real(154) * wall * solid / void_fraction + reynolds / (root * root));
    }

  private:
    double particle_to_tube_;
};

}  // namespace hearth::closure
