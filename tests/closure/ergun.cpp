// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <hearth/closure/air.hpp>
#include <hearth/closure/ergun.hpp>

#include "support/drag_table.hpp"

using namespace hearth::closure;

namespace {

/// Pressure drop over the paper's 145 mm of 14 mm glass spheres (its Fig. 5), air at 293.15 K [Pa].
double drop(double superficial_speed, double void_fraction) {
    return 0.145 * pressure_gradient(ergun{}, bed_flow<double>{void_fraction, superficial_speed / void_fraction,
                                                               1.20411, 1.81332e-5, 0.014});
}

}  // namespace

TEST_CASE("ergun: agrees with exchange coefficients computed elsewhere") {
    for (const auto& row : hearth_test::drag_table)
        CHECK(exchange_coefficient(ergun{}, hearth_test::flow_of(row)) ==
              doctest::Approx(row.ergun).epsilon(hearth_test::drag_table_precision));
}

TEST_CASE("ergun: pressure drop of the paper's bed") {
    // computed elsewhere, printed with four decimals; the gas properties have six digits
    CHECK(drop(0.2, 0.4) == doctest::Approx(10.4479).epsilon(1e-5));
    CHECK(drop(1, 0.4) == doctest::Approx(215.9235).epsilon(1e-5));
    CHECK(drop(2, 0.4) == doctest::Approx(841.0562).epsilon(1e-5));
    CHECK(drop(1, 0.36) == doctest::Approx(317.0415).epsilon(1e-5));
    CHECK(drop(2, 0.44) == doctest::Approx(588.7132).epsilon(1e-5));
}

TEST_CASE("ergun: hand values") {
    // e = 1/2: 150 + 1.75 Re
    CHECK(ergun::dimensionless_exchange(0.5, 8.0) == 164);
    CHECK(ergun::dimensionless_exchange(1.0, 0.0) == 0);
}

TEST_CASE("ergun::paper: Eq. 10 as printed is Ergun's gradient over e (1 - e)") {
    const bed_flow<double> flow{0.4, 1, 1.2, 1.8e-5, 0.014};
    CHECK(pressure_gradient(ergun::paper{}, flow) / pressure_gradient(ergun{}, flow) ==
          doctest::Approx(1 / 0.24).epsilon(1e-14));
    // below the paper's packed bed (solid fraction 0.1) the factor stays that of 0.1
    const bed_flow<double> dilute{0.95, 1, 1.2, 1.8e-5, 0.014};
    CHECK(pressure_gradient(ergun::paper{}, dilute) / pressure_gradient(ergun{}, dilute) ==
          doctest::Approx(1 / 0.095).epsilon(1e-14));
}
