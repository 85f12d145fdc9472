// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/error.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// View factors between equal spheres of a random packed bed, with the shading by all others.
/// Feng, Han, Int. J. Heat Mass Transfer 55 (2012) 6374.
struct feng_han {
    class monte_carlo_fit;
};

/// Stands in for the table and fit that Feng and Han published, which were not at hand: a fit to own ray tracing.
///
/// Rays of eight gravity-settled packings of 3000 spheres, solid fraction p from 0.577 to 0.637, 4e4 rays per sphere;
/// reciprocity holds within the noise, row sums are 0.999 to 1.000.  It agrees with Johnson, Tari, Baker (2021,
/// doi:10.1016/j.powtec.2020.11.050) to 0.3 % at contact and 4 % at s = 1.9.  s is the distance of the centres over the
/// diameter; for unequal spheres use their mean diameter and an area product A_i F_ij that is symmetric.
///
/// F is the mean over all pairs at s.  Below s = sqrt(3) it is within 0.5 % rms of the bins up to 1.5 and 1.5 % up to
/// 1.73; beyond within 4 % rms up to 2 and 6 % from there, dip at 2 included (two spheres behind a third that touches
/// both).  It is continuous.  A single pair differs from the mean by 3 % at s = 1.1, 30 % at 1.6, 100 % at 2.
class feng_han::monte_carlo_fit {
  public:
    HEARTH_FUNCTION static constexpr const char* name() { return "feng_han::monte_carlo_fit"; }

    /// [-]
    HEARTH_FUNCTION static constexpr interval distance_ratio_range() { return {1.0, 4.0}; }
    HEARTH_FUNCTION static constexpr interval solid_fraction_range() { return {0.57, 0.64}; }

    /// solid_fraction is the bed's, where it is not given with each pair [-].  Throws bad_value outside the range.
    explicit monte_carlo_fit(double solid_fraction = 0.6) : solid_fraction_(solid_fraction) {
        if (!solid_fraction_range().contains(solid_fraction))
            throw bad_value("solid_fraction of closure feng_han::monte_carlo_fit", bad_value::no_index, solid_fraction,
                            "in [0.57, 0.64] [-]");
    }

    /// View factor of a pair [-]; symmetric.
    template <class Scalar>
    HEARTH_FUNCTION Scalar view_factor(const Scalar& distance_ratio) const {
        return view_factor(distance_ratio, uniform(distance_ratio, real_t<Scalar>(solid_fraction_)));
    }

    /// View factor of a pair in a bed of the given solid fraction [-].
    /// Overlapping spheres (s < 1) count as touching; beyond s = 4, where less than 2e-5 is left, F is 0.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar view_factor(const Scalar& distance_ratio, const Scalar& solid_fraction) {
        using real = real_t<Scalar>;
        const Scalar s = at_least(distance_ratio, real(1));
        const Scalar dense = solid_fraction - real(0.6);
        const Scalar logarithm_of_f = select(s < real(kink()), near(s, dense), far(s, dense));
        return select(s > real(4), uniform(s, real(0)), exponential(logarithm_of_f));
    }

  private:
    /// Distance at which a third and a fourth sphere, touching both and each other, close the view [-].
    HEARTH_FUNCTION static constexpr double kink() { return 1.7320508075688772; }

    /// ln F below the kink.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar near(const Scalar& s, const Scalar& dense) {
        using real = real_t<Scalar>;
        const Scalar u = s - real(1);
        const Scalar mean =
            real(-2.59918486) +
            u * (real(-2.94773731) +
                 u * (real(3.01123217) + u * (real(-6.62931446) + u * (real(6.45019103) - u * real(5.75446422)))));
        return mean + dense * (real(-0.38724277) + u * (real(5.09061389) - u * real(20.06480561)));
    }

    /// ln F beyond it: a decay, less the dip around s = 2, which is narrower on its far side.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar far(const Scalar& s, const Scalar& dense) {
        using real = real_t<Scalar>;
        const Scalar u = s - real(kink());
        const Scalar mean =
            u * (real(-3.0059237) + u * (real(-1.1426061) + u * (real(0.98566144) - u * real(0.22479875))));
        const Scalar off = s - real(2);
        const Scalar width = select(off < real(0), uniform(s, real(0.080945506)), uniform(s, real(0.02967045)));
        const Scalar dip = real(1) / (real(1) + square(Scalar(off / width))) - real(0.0836281199386);
        const Scalar depth = real(0.76403643) + dense * real(2.7376376);
        return real(-5.101457458722) - dense * real(7.413351679778) + mean - dense * u * real(10.274712) - depth * dip;
    }

    double solid_fraction_;
};

}  // namespace hearth::closure
