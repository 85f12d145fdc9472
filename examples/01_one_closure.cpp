// SPDX-License-Identifier: MIT
// One closure by itself: how much heat does hot air give to a particle of a packed bed?
//
// A closure is a function of numbers.  It needs no mesh, no particles and no set-up, and takes any number type.
#include <cmath>
#include <cstdio>
#include <limits>

#include <hearth/closure/gunn.hpp>

int main() {
    using hearth::closure::gunn;

    // Air at 1000 K and 1 bar through a bed of 18 mm spheres.
    const double density = 0.348;             // [kg/m^3]
    const double viscosity = 4.24e-5;         // [Pa s]
    const double conductivity = 0.0667;       // [W/(m K)]
    const double prandtl = 0.726;             // [-]
    const double diameter = 0.018;            // [m]
    const double void_fraction = 0.4;         // [-]
    const double superficial_velocity = 1.5;  // [m/s], of the gas relative to the particles
    const double reynolds = density * superficial_velocity * diameter / viscosity;

    const double nusselt = gunn::nusselt(void_fraction, reynolds, prandtl);
    std::printf("Re %.0f, Nu %.2f, h %.0f W/(m^2 K), %s the range of the fit\n", reynolds, nusselt,
                nusselt * conductivity / diameter,
                gunn::void_fraction_range().contains(void_fraction) && gunn::reynolds_range().contains(reynolds)
                    ? "inside"
                    : "outside");

    // The same closure in float and in long double: the error of each is its round-off.
    using real = long double;
    const real exact = gunn::nusselt(real(void_fraction), real(reynolds), real(prandtl));
    const float single = gunn::nusselt(float(void_fraction), float(reynolds), float(prandtl));
    const auto double_error = static_cast<double>(std::abs(real(nusselt) / exact - 1));
    const auto float_error = static_cast<double>(std::abs(real(single) / exact - 1));
    std::printf("relative error of double %.0e, of float %.0e\n", double_error, float_error);

    // A sphere alone in resting gas has Nu = 2; at e = 1 the closure says 7 - 10 + 5.
    const double limit_error = std::abs(gunn::nusselt(1.0, 0.0, prandtl) - 2);
    std::printf("single sphere at rest: Nu off by %g\n", limit_error);

    // About ten operations, each with half a unit in the last place, and the three rounded arguments.
    const bool right = double_error < 16 * std::numeric_limits<double>::epsilon() &&
                       float_error < 16 * double(std::numeric_limits<float>::epsilon()) && limit_error == 0;
    return right ? 0 : 1;
}
