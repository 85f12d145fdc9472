// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/ranz_marshall.hpp>

using hearth::closure::ranz_marshall;

TEST_CASE("ranz_marshall: agrees with the correlation computed elsewhere") {
    // Prandtl number 0.7; printed with eight decimals by an independent evaluation.
    constexpr double rows[][2]{{0, 2}, {1, 2.53274240}, {50, 5.76705764}, {200, 9.53411529}, {10000, 55.27424010}};
    for (const auto& row : rows) {
        const double reynolds = row[0], nusselt = row[1];
        CAPTURE(reynolds);
        CHECK(std::fabs(ranz_marshall::nusselt(1.0, reynolds, 0.7) - nusselt) <= 0.5e-8 + 1e-12);
    }
}

TEST_CASE("ranz_marshall: hand value") {
    // 2 + 0.6 sqrt(100) 0.125^(1/3) = 2 + 6/2
    CHECK(ranz_marshall::nusselt(1.0, 100.0, 0.125) == doctest::Approx(5).epsilon(1e-15));
    CHECK(ranz_marshall::sherwood(1.0, 100.0, 0.125) == ranz_marshall::nusselt(1.0, 100.0, 0.125));
}
