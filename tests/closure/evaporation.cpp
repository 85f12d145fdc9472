// SPDX-License-Identifier: MIT
#include <cmath>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/closure/evaporation.hpp>
#include <hearth/eigen.hpp>

using namespace hearth::closure;

TEST_CASE("water: vapour pressure of the IAPWS formulation") {
    // triple point 611.657 Pa, normal boiling point 373.1243 K, critical point 22.064 MPa: values of IAPWS-95
    CHECK(water::saturation_pressure(273.16) == doctest::Approx(611.657).epsilon(1e-5));
    CHECK(water::saturation_pressure(373.1243) == doctest::Approx(101325).epsilon(3e-5));
    CHECK(water::saturation_pressure(647.096) == doctest::Approx(22.064e6).epsilon(1e-14));
    // IAPWS-IF97, which differs by up to 0.02 %: 300 K, 500 K, 600 K (its verification values)
    CHECK(water::saturation_pressure(300.0) == doctest::Approx(3536.58941).epsilon(2e-4));
    CHECK(water::saturation_pressure(500.0) == doctest::Approx(2.63889776e6).epsilon(2e-4));
    CHECK(water::saturation_pressure(600.0) == doctest::Approx(12.3443146e6).epsilon(2e-4));
}

TEST_CASE("water: vapour pressure rises up to the critical point and stays finite above") {
    for (double t = 250; t < 647; t += 1) CHECK(water::saturation_pressure(t + 1) > water::saturation_pressure(t));
    CHECK(water::saturation_pressure(2000.0) == 22.064e6);
    CHECK(water::latent_heat(2000.0) == 0);
}

TEST_CASE("water: heat of evaporation of the steam tables") {
    // IAPWS-95, from common steam tables [deg C, kJ/kg]
    constexpr double rows[][2]{{0.01, 2500.9}, {25, 2441.7},  {60, 2357.7}, {100, 2256.4},
                               {150, 2113.8},  {200, 1939.8}, {250, 1715.2}};
    for (const auto& row : rows) {
        const double celsius = row[0], kilojoule = row[1];
        CAPTURE(celsius);
        CHECK(water::latent_heat(celsius + 273.15) ==
              doctest::Approx(1e3 * kilojoule).epsilon(celsius < 225 ? 3e-4 : 1e-3));
    }
}

TEST_CASE("water: vapour pressure and heat of evaporation obey Clausius and Clapeyron") {
    // d ln p / dT = L M / (R T^2) while vapour is nearly ideal: its compressibility is 0.997 at 320 K
    using dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
    for (const double t : {280.0, 300.0, 320.0}) {
        CAPTURE(t);
        const dual p = water::saturation_pressure(dual(t, 1, 0));
        const double slope = p.derivatives()[0] / p.value();
        CHECK(slope * 8.314462618 * t * t / water::molar_mass() ==
              doctest::Approx(water::latent_heat(t)).epsilon(4e-3));
    }
}

TEST_CASE("water: diffusion in air") {
    // 1.87e-10 298.15^2.072 = 2.5054e-5; measured 2.49e-5 to 2.6e-5
    CHECK(water::diffusivity_in_air(298.15, 101325.0) == doctest::Approx(2.5054e-5).epsilon(1e-4));
    CHECK(water::diffusivity_in_air(298.15, 202650.0) ==
          doctest::Approx(0.5 * water::diffusivity_in_air(298.15, 101325.0)).epsilon(1e-15));
}

namespace {

const wet_sphere<double> sphere{0.01, 10, 2.5e-5, 320, 1e5, 2e4, 1e3};

}  // namespace

TEST_CASE("evaporation: hand value") {
    // pi d Sh D M/(R T) p ln((p - p_gas)/(p - p_surface))
    const double expected =
        3.14159265358979324 * 0.01 * 10 * 2.5e-5 * 0.018015268 / (8.31446261815324 * 320) * 1e5 * std::log(99.0 / 80);
    CHECK(evaporation::mass_rate(sphere) == doctest::Approx(expected).epsilon(1e-13));
}

TEST_CASE("evaporation: none in saturated gas, condensation beyond") {
    wet_sphere<double> s = sphere;
    s.gas_pressure = s.surface_pressure;
    CHECK(evaporation::mass_rate(s) == 0);
    s.gas_pressure = 2 * s.surface_pressure;
    CHECK(evaporation::mass_rate(s) < 0);
}

TEST_CASE("evaporation: rises with the vapour pressure through the boiling point and stays finite") {
    wet_sphere<double> s = sphere;
    double last = 0;
    for (s.surface_pressure = 1.5e3; s.surface_pressure < 5e5; s.surface_pressure *= 1.1) {
        const double now = evaporation::mass_rate(s);
        CHECK(now > last);
        CHECK(std::isfinite(now));
        last = now;
    }
}

TEST_CASE("evaporation: pure vapour around the sphere is not singular") {
    wet_sphere<double> s = sphere;
    s.gas_pressure = s.pressure;
    const double rate = evaporation::mass_rate(s);
    CHECK(std::isfinite(rate));
    CHECK(rate < 0);
}

TEST_CASE("evaporation: units rescale with pressure, size and diffusivity") {
    wet_sphere<double> s = sphere;
    s.diameter *= 2, s.diffusivity *= 4;
    s.pressure *= 8, s.surface_pressure *= 8, s.gas_pressure *= 8;
    s.film_temperature *= 2;
    CHECK(evaporation::mass_rate(s) == 32 * evaporation::mass_rate(sphere));  // powers of two, so exactly
}

TEST_CASE("evaporation: the outflow of vapour") {
    CHECK(evaporation::stefan_factor(0.0) == 1);
    // 1 + b/2 + b^2/3
    CHECK(evaporation::stefan_factor(1e-9) == doctest::Approx(1 + 0.5e-9).epsilon(3e-16));
    CHECK(evaporation::stefan_factor(1e-3) == doctest::Approx(1 + 0.5e-3 + 1e-6 / 3 + 1e-9 / 4).epsilon(1e-12));
    CHECK(evaporation::stefan_factor(0.5) == doctest::Approx(2 * std::log(2.0)).epsilon(1e-15));
    CHECK(evaporation::stefan_factor(-1.0) == doctest::Approx(std::log(2.0)).epsilon(1e-15));
    CHECK(evaporation::stefan_factor(0.99) == doctest::Approx(std::log(100.0) / 0.99).epsilon(1e-14));
    CHECK(evaporation::stefan_factor(3.0) == evaporation::stefan_factor(0.99));
}
