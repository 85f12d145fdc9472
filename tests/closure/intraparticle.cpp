// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <hearth/closure/intraparticle.hpp>

using hearth::closure::biot_report;
using hearth::closure::intraparticle;

TEST_CASE("intraparticle: hand values") {
    // spinel of the furnace at its hottest: 300 W/(m^2 K), 17.75 mm, 4 W/(m K)
    CHECK(intraparticle::biot(300.0, 0.01775, 4.0) == doctest::Approx(0.221875).epsilon(1e-15));
    CHECK(intraparticle::transfer_coefficient(300.0, 0.01775, 4.0) == doctest::Approx(300 / 1.133125).epsilon(1e-15));
}

TEST_CASE("intraparticle: exact for the steadily heated sphere") {
    // With heat source s per volume the profile is T(r) = T_surface - s (R^2 - r^2)/(6 k), mean T_surface - s R^2/(15
    // k); the surface gives s R/3 = h (T_gas - T_surface).
    const double radius = 0.01, conductivity = 2, h = 150, source = 3e5;
    const double surface_to_mean = source * radius * radius / (15 * conductivity);
    const double flux = source * radius / 3;
    CHECK(intraparticle::transfer_coefficient(h, 2 * radius, conductivity) ==
          doctest::Approx(flux / (flux / h + surface_to_mean)).epsilon(1e-14));
}

TEST_CASE("intraparticle: a perfect conductor is not corrected, and no exchange stays none") {
    CHECK(intraparticle::transfer_coefficient(150.0, 0.02, std::numeric_limits<double>::infinity()) == 150);
    CHECK(intraparticle::transfer_coefficient(0.0, 0.02, 2.0) == 0);
}

TEST_CASE("intraparticle: never more than the film, nor than the solid lets through") {
    for (double h = 1e-3; h < 1e9; h *= 10) {
        const double corrected = intraparticle::transfer_coefficient(h, 0.02, 2.0);
        CHECK(corrected <= h);
        CHECK(corrected <= 10 * 2.0 / 0.02);
    }
}

TEST_CASE("biot_report: counts what passes the limit, and adds up over threads") {
    biot_report one, two;
    one.add(0.1);
    one.add(0.3);  // at the limit, not above
    two.add(0.5);
    two.add(0.2);
    one += two;
    CHECK(one.evaluations == 4);
    CHECK(one.above_limit == 1);
    CHECK(one.largest == 0.5);
}
