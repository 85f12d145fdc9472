// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/wakao_kaguei.hpp>

using hearth::closure::wakao_kaguei;

TEST_CASE("wakao_kaguei: agrees with the correlation computed elsewhere") {
    // Prandtl number 0.7; printed with eight decimals by an independent evaluation.
    constexpr double rows[][2]{
        {0, 2}, {1, 2.97669440}, {100, 17.47956309}, {500, 42.65750285}, {5000, 163.86043421}, {100000, 978.69440192}};
    for (const auto& row : rows) {
        const double reynolds = row[0], nusselt = row[1];
        CAPTURE(reynolds);
        CHECK(std::fabs(wakao_kaguei::nusselt(0.4, reynolds, 0.7) - nusselt) <= 0.5e-8 + 1e-12);
    }
}

TEST_CASE("wakao_kaguei: mass follows heat and the void fraction does not matter") {
    CHECK(wakao_kaguei::sherwood(0.4, 120.0, 0.61) == wakao_kaguei::nusselt(0.37, 120.0, 0.61));
}
