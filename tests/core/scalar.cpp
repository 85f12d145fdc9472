// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <type_traits>

#include <doctest/doctest.h>

#include <hearth/core/scalar.hpp>

using namespace hearth;

static_assert(std::is_same_v<real_t<float>, float> && std::is_same_v<value_t<long double>, long double>);
static_assert(minimum(1.0, 2.0) == 1.0 && maximum(1.0F, 2.0F) == 2.0F, "usable in constant expressions");
static_assert(select(true, 1.0, 2.0) == 1.0 && square(3.0) == 9.0 && cube(2.0F) == 8.0F && uniform(7.0, 4.0) == 4.0);
static_assert(lane_count(3.0) == 1 && lane(3.0, 0) == 3.0);

TEST_CASE_TEMPLATE("scalar: powers and roots at zero and one", Real, float, double, long double) {
    CHECK(power(Real(0), Real(0.2L)) == 0);
    CHECK(power(Real(1), Real(0.2L)) == 1);
    CHECK(variable_power(Real(0), Real(0.5L)) == 0);
    CHECK(std::isnan(power(Real(-1), Real(0.2L))));
    CHECK(square_root(Real(4)) == 2);
    CHECK(absolute(cube_root(Real(27)) - 3) <= 4 * std::numeric_limits<Real>::epsilon());  // one round-off of 3
    CHECK(cube_root(Real(0)) == 0);
    CHECK(exponential(Real(0)) == 1);
    CHECK(logarithm(Real(1)) == 0);
    CHECK(absolute(Real(-2)) == 2);
}

TEST_CASE("scalar: no plain number passes through another precision") {
    // 2^0.5 in float is not that of double rounded twice only if float itself computed it
    static_assert(std::is_same_v<decltype(power(2.0F, 0.5F)), float>);
    static_assert(std::is_same_v<decltype(power(2.0L, 0.5L)), long double>);
    CHECK(power(10.0L, 0.3L) != static_cast<long double>(power(10.0, 0.3)));
}

TEST_CASE("scalar: exponential_minus_one keeps its digits at small arguments") {
    CHECK(exponential_minus_one(1e-12) == doctest::Approx(1e-12).epsilon(1e-12));
}

TEST_CASE("scalar: a NaN in the first argument of minimum and maximum comes through") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(minimum(nan, 1.0)));
    CHECK(std::isnan(maximum(nan, 1.0)));
}
