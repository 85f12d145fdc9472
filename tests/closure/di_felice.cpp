// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/di_felice.hpp>

#include "support/drag_table.hpp"

using namespace hearth::closure;

TEST_CASE("di_felice: agrees with forces computed elsewhere") {
    for (const auto& row : hearth_test::drag_table)
        CHECK(particle_coefficient(di_felice{}, hearth_test::flow_of(row)) * row.slip_speed ==
              doctest::Approx(row.force_di_felice).epsilon(hearth_test::drag_table_precision));
}

TEST_CASE("di_felice: at rest the exponent is 3.7 and the drag 0.75 * 4.8^2") {
    CHECK(di_felice::dimensionless_exchange(1.0, 0.0) == doctest::Approx(17.28).epsilon(1e-15));
    CHECK(di_felice::dimensionless_exchange(0.5, 0.0) == doctest::Approx(17.28 * std::pow(0.5, -2.7)).epsilon(1e-14));
    // The floor of the logarithm at 1e-8 is felt nowhere.
    const double slow = di_felice::dimensionless_exchange(0.5, 1e-16),
                 slower = di_felice::dimensionless_exchange(0.5, 0.0);
    // 2 * 0.63/4.8 sqrt(5e-17) = 1.9e-9 is the drag's own rise
    CHECK(slow == doctest::Approx(slower).epsilon(3e-9));
}
