// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <hearth/closure/gidaspow.hpp>

#include "support/drag_table.hpp"

using namespace hearth::closure;

TEST_CASE("gidaspow: agrees with exchange coefficients computed elsewhere") {
    for (const auto& row : hearth_test::drag_table)
        CHECK(exchange_coefficient(gidaspow{}, hearth_test::flow_of(row)) ==
              doctest::Approx(row.gidaspow).epsilon(hearth_test::drag_table_precision));
}

TEST_CASE("gidaspow: Ergun up to void fraction 0.8, Wen and Yu above") {
    CHECK(gidaspow::dimensionless_exchange(0.8, 100.0) == ergun::dimensionless_exchange(0.8, 100.0));
    CHECK(gidaspow::dimensionless_exchange(0.8000001, 100.0) == wen_yu::dimensionless_exchange(0.8000001, 100.0));
}
