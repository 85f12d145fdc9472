// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// View factors from the spheres of a packed bed to a flat wall beside it.
/// Each has  view_factor(height_ratio), height_ratio the distance of the centre from the wall over the diameter [-],
/// and  touching_only(): true where it is meant for particles in contact and for no others.
struct wall_view {
    struct paper;
    class closed;
    class bed;
};

/// 0.5 for every touching particle: the factor of a sphere that sees nothing but the wall (Spijker et al. 2023, Eq. 5).
/// The neighbours shade the wall, so that this adds up to 1.2 to 1.5 times the exchange of a black wall.
struct wall_view::paper {
    HEARTH_FUNCTION static constexpr bool touching_only() { return true; }

    /// [-]
    template <class Scalar>
    HEARTH_FUNCTION static Scalar view_factor(const Scalar& height_ratio) {
        return uniform(height_ratio, real_t<Scalar>(0.5));
    }
};

/// What touching particles must see of the wall so that together they see all of it: F = 1/(pi n), n the number of
/// touching particles on an area of one squared diameter.  The default: the exchange of the wall is that of a black
/// one.
class wall_view::closed {
  public:
    /// Takes n from the solid fraction p of the bed: 0.834 + 3.33 (p - 0.6), fitted within 2 % to own gravity-settled
    /// packings on a flat floor (n = 0.972, 0.882, 0.799, 0.767 at p = 0.637, 0.618, 0.593, 0.577).
    /// Throws bad_value outside [0.57, 0.64].
    explicit closed(double solid_fraction = 0.6)
        : view_factor_(1 / (constants<double>::pi() * coverage(solid_fraction))) {
        if (!solid_fraction_range().contains(solid_fraction))
            throw bad_value("solid_fraction of closure wall_view::closed", bad_value::no_index, solid_fraction,
                            "in [0.57, 0.64] [-]");
    }

    /// Takes n as counted [-].  Throws bad_value below 0.637, where F would exceed 0.5, and above 1.155, hexagonal.
    static closed with_coverage(double touching_per_squared_diameter) {
        if (!coverage_range().contains(touching_per_squared_diameter))
            throw bad_value("touching_per_squared_diameter of closure wall_view::closed", bad_value::no_index,
                            touching_per_squared_diameter, "in [0.637, 1.155] [-]");
        closed result;
        result.view_factor_ = 1 / (constants<double>::pi() * touching_per_squared_diameter);
        return result;
    }

    HEARTH_FUNCTION static constexpr interval solid_fraction_range() { return {0.57, 0.64}; }
    HEARTH_FUNCTION static constexpr interval coverage_range() { return {0.637, 1.155}; }
    HEARTH_FUNCTION static constexpr bool touching_only() { return true; }

    /// [-]
    template <class Scalar>
    HEARTH_FUNCTION Scalar view_factor(const Scalar& height_ratio) const {
        return uniform(height_ratio, real_t<Scalar>(view_factor_));
    }

  private:
    static constexpr double coverage(double solid_fraction) { return 0.834 + 3.33 * (solid_fraction - 0.6); }

    double view_factor_;
};

/// The factor at every distance from the wall, by own ray tracing in packings settled on a flat floor; 0.30 to 0.32 at
/// contact.  Together the particles see the wall once (1.001 to 1.004), of which 10 to 22 % is not by contact.
/// Within 2 % at contact and 10 % rms up to 4 diameters, where the noise of the rays is 4 to 9 %.
class wall_view::bed {
  public:
    /// Throws bad_value unless the bed's solid fraction is in [0.57, 0.64] [-].
    explicit bed(double solid_fraction = 0.6) : solid_fraction_(solid_fraction) {
        if (!solid_fraction_range().contains(solid_fraction))
            throw bad_value("solid_fraction of closure wall_view::bed", bad_value::no_index, solid_fraction,
                            "in [0.57, 0.64] [-]");
    }

    HEARTH_FUNCTION static constexpr interval solid_fraction_range() { return {0.57, 0.64}; }
    HEARTH_FUNCTION static constexpr interval height_ratio_range() { return {0.5, 4.0}; }
    HEARTH_FUNCTION static constexpr bool touching_only() { return false; }

    /// [-].  A particle pressed into the wall (below 0.5) counts as touching.
    template <class Scalar>
    HEARTH_FUNCTION Scalar view_factor(const Scalar& height_ratio) const {
        using real = real_t<Scalar>;
        // ln F is a chain of straight lines over the height; each term is what one bend adds.
        const real dense = real(solid_fraction_) - real(0.6);
        return exponential(Scalar(real(-1.17526) - real(1.04656) * dense -
                                  above(height_ratio, 0.5) * (real(1.7622) + real(13.1852) * dense) -
                                  above(height_ratio, 1.0) * real(2.98868) + above(height_ratio, 1.35) * real(3.27273) -
                                  above(height_ratio, 1.55) * real(1.08223) +
                                  above(height_ratio, 3.0) * (real(1.52755) + real(8.67639) * dense)));
    }

  private:
    template <class Scalar>
    HEARTH_FUNCTION static Scalar above(const Scalar& height_ratio, double bend) {
        using real = real_t<Scalar>;
        const Scalar height = height_ratio - real(bend);
        return at_least(height, real(0));
    }

    double solid_fraction_;
};

}  // namespace hearth::closure
