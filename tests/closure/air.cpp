// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <hearth/closure/air.hpp>

using hearth::closure::air;

TEST_CASE("air: agrees with the formulas computed elsewhere") {
    struct row {
        double temperature, viscosity, conductivity, specific_heat, density;
    };
    // viscosity printed with seven digits, conductivity with four, density with six
    constexpr row rows[]{
        {273.15, 1.716000e-05, 0.02413, 1007.344, 1.292275}, {293.15, 1.813322e-05, 0.02571, 1009.365, 1.204110},
        {400, 2.285161e-05, 0.03365, 1022.099, 0.882462},    {1000, 4.152006e-05, 0.06755, 1151.022, 0.352985},
        {1500, 5.259453e-05, 0.08830, 1219.294, 0.235323},   {2400, 6.828281e-05, 0.11773, 1282.235, 0.147077}};
    for (const row& r : rows) {
        CAPTURE(r.temperature);
        CHECK(air::viscosity(r.temperature) == doctest::Approx(r.viscosity).epsilon(5e-7));
        CHECK(air::conductivity(r.temperature) == doctest::Approx(r.conductivity).epsilon(3e-4));
        CHECK(air::density(r.temperature, 101325.0) == doctest::Approx(r.density).epsilon(3e-6));
        // Those of the specific heat are per mass of 21 % oxygen and 79 % nitrogen, 28.8503 g/mol; here of air.
        CHECK(air::specific_heat(r.temperature) * 28.965 / 28.8503 == doctest::Approx(r.specific_heat).epsilon(1e-5));
    }
}

TEST_CASE("air: measured values at room temperature") {
    // NIST REFPROP for dry air at 300 K, 101325 Pa: 1006.4 J/(kg K), 18.54e-6 Pa s, 26.4e-3 W/(m K)
    CHECK(air::specific_heat(300.0) == doctest::Approx(1006.4).epsilon(2e-3));
    CHECK(air::viscosity(300.0) == doctest::Approx(18.54e-6).epsilon(6e-3));
    CHECK(air::conductivity(300.0) == doctest::Approx(26.4e-3).epsilon(1e-2));
    CHECK(air::prandtl(300.0) == doctest::Approx(0.707).epsilon(1e-2));
}

TEST_CASE("air: the two branches of the specific heat meet") {
    CHECK(air::specific_heat(999.9999) == doctest::Approx(air::specific_heat(1000.0)).epsilon(1e-4));
}

TEST_CASE("air: keeps the units of its gas law") { CHECK(air::density(600.0, 2e5) == air::density(300.0, 1e5)); }
