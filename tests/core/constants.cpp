// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/core/constants.hpp>

using hearth::constants;

TEST_CASE_TEMPLATE("constants: rounded to the last digit of each precision", Real, float, double, long double) {
    CHECK(constants<Real>::pi() == static_cast<Real>(std::acos(-1.0L)));
    CHECK(constants<Real>::gas_constant() == static_cast<Real>(8.31446261815324L));
}

TEST_CASE("constants: Stefan-Boltzmann and the gas constant follow from the SI's defining constants") {
    // k, h, c, N_A of the SI (2019) are exact
    const double k = 1.380649e-23, h = 6.62607015e-34, c = 299792458, avogadro = 6.02214076e23;
    const double pi = constants<double>::pi();
    // ten digits are kept of the former, all of the latter
    CHECK(2 * std::pow(pi, 5) * std::pow(k, 4) / (15 * std::pow(h, 3) * c * c) ==
          doctest::Approx(constants<double>::stefan_boltzmann()).epsilon(1e-10));
    CHECK(k * avogadro == doctest::Approx(constants<double>::gas_constant()).epsilon(1e-15));
}

TEST_CASE("constants: conventions") {
    CHECK(constants<double>::standard_gravity() == 9.80665);
    CHECK(constants<double>::standard_atmosphere() == 101325);
    CHECK(constants<double>::zero_celsius() == 273.15);
}
