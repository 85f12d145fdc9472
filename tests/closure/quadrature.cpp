// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/quadrature.hpp>

TEST_CASE("gauss_legendre: exact for powers up to 15, not for 16") {
    using rule = hearth::closure::gauss_legendre<long double>;
    for (int power = 0; power <= 16; ++power) {
        CAPTURE(power);
        long double sum = 0;
        for (int k = 0; k < rule::count(); ++k)
            sum += rule::weight(k) * std::pow(rule::node(k), static_cast<long double>(power));
        const double error = static_cast<double>(std::fabs(sum * static_cast<long double>(power + 1) - 1));
        if (power <= 15)
            CHECK(error <= 1e-17);
        else
            CHECK(error == doctest::Approx(6.04e-9).epsilon(1e-2));  // (8!)^4 / (16!)^2
    }
}
