// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <type_traits>

#include <hearth/closure/quadrature.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// View factor between two equal spheres with nothing else around: the upper bound of any shaded one.
/// s is the distance of the centres over the diameter.  F(1) = 0.0755868, far away F = 1/(16 s^2).
struct sphere_pair {
    HEARTH_FUNCTION static constexpr const char* name() { return "sphere_pair"; }
    /// [-]
    HEARTH_FUNCTION static constexpr interval distance_ratio_range() { return {1.0, 1e9}; }

    /// Compact fit to the exact factor: off by up to 7e-5 of it [-].  Overlapping spheres (s < 1) count as touching.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar view_factor(const Scalar& distance_ratio) {
        using real = real_t<Scalar>;
        const Scalar s = at_least(distance_ratio, real(1));
        const Scalar x = real(1) / square(s);
        const Scalar x2 = square(x);
        const Scalar x4 = square(x2);
        const Scalar series =
            real(1) +
            x * (real(0.125623570) + x * (real(0.0287823226) + x * (real(0.0687180836) - x * real(0.0789526763)))) +
            x4 * x2 * (real(0.117917136) - x2 * real(0.0788043068)) + x4 * x4 * x4 * real(0.0260326856);
        return series * x / real(16);
    }

    /// The exact factor, for plain numbers: to 1e-13 of itself in double up to s = 100 [-].  s >= 1.
    ///
    /// It is the mean over the polar cosine m of the factor from a surface element to the other sphere (radius 1 here,
    /// centres 2 s apart).  At distance H from that centre, under the angle t to the element's normal, with C = H cos t
    /// = 2 s m - 1, the element sees the sphere whole for C > 1, not at all for C < -1, and between cut by its horizon:
    /// whole:  C/H^3
    /// cut:    atan(q/c)/pi + (C/H atan2(H q, -c C) - c q)/(pi H^2),  c = sqrt(H^2 - 1), q = sqrt(1 - C^2)
    /// (Howell, Menguc, Daun, Thermal Radiation Heat Transfer, factor of a tilted element and a sphere).
    template <class Real>
    HEARTH_FUNCTION static Real exact_view_factor(Real s) {
        static_assert(std::is_floating_point_v<Real>, "hearth: the exact factor of a sphere pair is for plain numbers");
        using rule = gauss_legendre<Real>;
        const Real edge = s * std::sqrt(Real(4) * s * s - Real(3));
        const Real whole = (s * s - Real(1)) / (Real(2) * edge * (edge + Real(2) * s * s - Real(1)));
        // m = v^2 (3 - 2 v)/s makes both ends of the cut part smooth.
        constexpr int panels = 8;
        Real cut = 0;
        for (int panel = 0; panel < panels; ++panel)
            for (int k = 0; k < rule::count(); ++k) {
                const Real v = (Real(panel) + rule::node(k)) / Real(panels);
                const Real seen = v * v * (Real(3) - Real(2) * v);                            // (1 + C)/2
                const Real hidden = (Real(1) - v) * (Real(1) - v) * (Real(1) + Real(2) * v);  // (1 - C)/2
                cut += rule::weight(k) * v * (Real(1) - v) * cut_element(s, seen, hidden);
            }
        return whole + Real(3) * cut / (s * Real(panels));
    }

  private:
    template <class Real>
    HEARTH_FUNCTION static Real cut_element(Real s, Real seen, Real hidden) {
        const Real cosine = seen - hidden;  // C
        const Real q = Real(2) * std::sqrt(seen * hidden);
        const Real c = Real(2) * std::sqrt((s - Real(1)) * (s + Real(1)) + hidden);
        const Real h = std::sqrt(Real(1) + c * c);
        const Real tilted = cosine / h * std::atan2(h * q, -c * cosine);
        return (std::atan2(q, c) + (tilted - c * q) / (h * h)) / constants<Real>::pi();
    }
};

}  // namespace hearth::closure
