// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <hearth/closure/wen_yu.hpp>

#include "support/drag_table.hpp"

using namespace hearth::closure;

TEST_CASE("wen_yu: agrees with exchange coefficients computed elsewhere") {
    for (const auto& row : hearth_test::drag_table)
        CHECK(exchange_coefficient(wen_yu{}, hearth_test::flow_of(row)) ==
              doctest::Approx(row.wen_yu).epsilon(hearth_test::drag_table_precision));
}

TEST_CASE("wen_yu: drag coefficient of a sphere") {
    CHECK(wen_yu::sphere_drag_times_reynolds(0.0) == 24);
    // 24 (1 + 0.15) at 1
    CHECK(wen_yu::sphere_drag_times_reynolds(1.0) == doctest::Approx(27.6).epsilon(1e-15));
    CHECK(wen_yu::sphere_drag_times_reynolds(2000.0) == 880);
    // the known jump where Schiller and Naumann hand over: 438.1 to 440
    CHECK(wen_yu::sphere_drag_times_reynolds(1000.0) == doctest::Approx(438.1).epsilon(1e-3));
    CHECK(wen_yu::sphere_drag_times_reynolds(1000.0001) == doctest::Approx(440).epsilon(1e-6));
}
