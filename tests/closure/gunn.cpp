// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/air.hpp>
#include <hearth/closure/gunn.hpp>

using hearth::closure::gunn;

TEST_CASE("gunn: agrees with the correlation computed elsewhere") {
    struct row {
        double reynolds, void_fraction, nusselt;
    };
    // Prandtl number 0.7; printed with eight decimals by an independent evaluation.
    constexpr row rows[]{{0, 0.35, 4.1125},
                         {0, 0.4, 3.8},
                         {0, 1, 2},
                         {1, 0.4, 6.66082669},
                         {10, 0.5, 8.36498154},
                         {100, 0.35, 24.74011674},
                         {100, 0.4, 22.26700004},
                         {100, 0.7, 11.58313589},
                         {100, 1, 8.02184784},
                         {1000, 0.5, 59.35730278},
                         {10000, 0.4, 333.55111377},
                         {100000, 0.35, 1818.24099250},
                         {100000, 1, 379.44452461}};
    for (const row& r : rows) {
        CAPTURE(r.reynolds);
        CAPTURE(r.void_fraction);
        CHECK(std::fabs(gunn::nusselt(r.void_fraction, r.reynolds, 0.7) - r.nusselt) <= 0.5e-8 + 1e-13);
    }
}

TEST_CASE("gunn: mass follows heat") { CHECK(gunn::sherwood(0.4, 120.0, 0.61) == gunn::nusselt(0.4, 120.0, 0.61)); }

TEST_CASE("gunn: a single sphere at rest has Nusselt number 2") {
    CHECK(gunn::nusselt(1.0, 0.0, 0.7) == 2.0);
    CHECK(gunn::nusselt(1.0F, 0.0F, 0.7F) == 2.0F);
}

TEST_CASE("gunn: rises with flow, falls with void fraction, in its whole range") {
    for (double e = 0.35; e < 1; e += 0.01)
        for (double re = 0.01; re < 1e5; re *= 1.5) {
            CAPTURE(e);
            CAPTURE(re);
            CHECK(gunn::nusselt(e, 1.5 * re, 0.7) > gunn::nusselt(e, re, 0.7));
            // at rest the first polynomial is flat at void fraction 1, and the second rises by 0.03 after 0.97
            if (e < 0.95) CHECK(gunn::nusselt(e + 0.01, re, 0.7) < gunn::nusselt(e, re, 0.7));
        }
}

TEST_CASE("gunn: the superficial Reynolds number gives the paper's furnace 120 to 300 W/(m^2 K)") {
    // Mass fluxes of gas below and above the burners from the furnace's mass balance, mean particle of 17.75 mm, void
    // fraction 0.42 and properties of air: the coldest and the hottest place.
    using hearth::closure::air;
    const auto coefficient = [](double temperature, double mass_flux) {
        const double d = 0.01775;
        const double reynolds = mass_flux * d / air::viscosity(temperature);
        return gunn::nusselt(0.42, reynolds, air::prandtl(temperature)) * air::conductivity(temperature) / d;
    };
    CHECK(coefficient(300, 1.27) == doctest::Approx(127).epsilon(0.05));
    CHECK(coefficient(2200, 1.63) == doctest::Approx(304).epsilon(0.05));
    // Interstitial it would be outside: above 220 and 500.
    CHECK(coefficient(300, 1.27 / 0.42) > 200);
    CHECK(coefficient(2200, 1.63 / 0.42) > 450);
}
