// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <hearth/closure/beetstra.hpp>

#include "support/drag_table.hpp"

using namespace hearth::closure;

TEST_CASE("beetstra: agrees with exchange coefficients computed elsewhere") {
    for (const auto& row : hearth_test::drag_table)
        CHECK(exchange_coefficient(beetstra{}, hearth_test::flow_of(row)) ==
              doctest::Approx(row.beetstra).epsilon(hearth_test::drag_table_precision));
}

TEST_CASE("beetstra: a single resting sphere has Stokes' 18, a bed at rest the Carman-Kozeny-like 180") {
    CHECK(beetstra::dimensionless_exchange(1.0, 0.0) == 18);
    // 18 e (10 p/e^2 + e^2 (1 + 1.5 sqrt(p))) at e = p = 1/2
    CHECK(beetstra::dimensionless_exchange(0.5, 0.0) ==
          doctest::Approx(9 * (20 + 0.25 * (1 + 1.5 * 0.70710678118654752))).epsilon(1e-15));
}
