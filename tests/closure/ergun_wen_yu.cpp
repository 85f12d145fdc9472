// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <hearth/closure/ergun_wen_yu.hpp>

#include "support/drag_table.hpp"

using namespace hearth::closure;

TEST_CASE("ergun_wen_yu: agrees with the force of OpenFOAM 2.4's pair computed elsewhere") {
    for (const auto& row : hearth_test::drag_table)
        CHECK(particle_coefficient(ergun_wen_yu{}, hearth_test::flow_of(row)) * row.slip_speed ==
              doctest::Approx(row.force_ergun_wen_yu).epsilon(hearth_test::drag_table_precision));
}

TEST_CASE("ergun_wen_yu: Ergun below void fraction 0.8, Wen and Yu from there, both over e") {
    CHECK(ergun_wen_yu::dimensionless_exchange(0.7999999, 100.0) ==
          ergun::dimensionless_exchange(0.7999999, 100.0) / 0.7999999);
    CHECK(ergun_wen_yu::dimensionless_exchange(0.8, 100.0) == wen_yu::dimensionless_exchange(0.8, 100.0) / 0.8);
    CHECK(ergun_wen_yu::model() == momentum_model::b);
}
