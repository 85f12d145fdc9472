// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/lane_math.hpp>

#include "support/random.hpp"

using namespace hearth::detail;

TEST_CASE_TEMPLATE("lane_math: powers are within two round-offs, however large or small the number", Real, float,
                   double) {
    const auto epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
    hearth_test::seeded random(41);
    // the exponents of the closures
    for (const double exponent : {0.05, 0.2, 1.0 / 3, 0.657, 0.687, 0.7, 0.95, 2.072, -2.65}) {
        CAPTURE(exponent);
        const auto a = static_cast<Real>(exponent);
        std::vector<Real> x(4096), y(x.size());
        for (Real& number : x) number = static_cast<Real>(random.log_uniform(1e-12, 1e12));
        raise_to_power(x.data(), y.data(), x.size(), a);
        for (std::size_t k = 0; k < x.size(); ++k) {
            const long double exact = std::pow(static_cast<long double>(x[k]), static_cast<long double>(a));
            REQUIRE(std::fabs(static_cast<double>(static_cast<long double>(y[k]) / exact - 1)) <= 2 * epsilon);
        }
    }
}

TEST_CASE_TEMPLATE("lane_math: a cube root knows a third better than its type", Real, float, double) {
    const auto epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
    constexpr Real third = Real(1) / Real(3);
    const auto tail = static_cast<Real>(1.0L / 3 - static_cast<long double>(third));
    hearth_test::seeded random(42);
    std::vector<Real> x(10000), y(x.size());
    for (Real& number : x) number = static_cast<Real>(random.log_uniform(1e-30, 1e30));
    raise_to_power(x.data(), y.data(), x.size(), third, tail);
    for (std::size_t k = 0; k < x.size(); ++k) {
        const long double exact = std::cbrt(static_cast<long double>(x[k]));
        REQUIRE(std::fabs(static_cast<double>(static_cast<long double>(y[k]) / exact - 1)) <= 1.2 * epsilon);
    }
}

TEST_CASE_TEMPLATE("lane_math: any count, with an exponent each, and nothing beside it touched", Real, float, double) {
    const auto epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
    for (std::size_t count = 0; count < 40; ++count) {
        CAPTURE(count);
        std::vector<Real> x(count), a(count), y(count + 1, Real(-1));
        for (std::size_t k = 0; k < count; ++k) {
            x[k] = Real(0.5) + static_cast<Real>(k);
            a[k] = Real(0.1) * static_cast<Real>(k) - Real(2);
        }
        raise_to_powers(x.data(), a.data(), y.data(), count);
        for (std::size_t k = 0; k < count; ++k) {
            const long double exact = std::pow(static_cast<long double>(x[k]), static_cast<long double>(a[k]));
            REQUIRE(std::fabs(static_cast<double>(static_cast<long double>(y[k]) / exact - 1)) <= 2 * epsilon);
        }
        CHECK(y[count] == Real(-1));
    }
}

TEST_CASE_TEMPLATE("lane_math: zero, infinity, NaN, negative and very small numbers", Real, float, double) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity(), nan = std::numeric_limits<Real>::quiet_NaN();
    const std::vector<Real> x{0, Real(-0.0), infinity, nan, -1, -infinity, std::numeric_limits<Real>::denorm_min()};
    std::vector<Real> y(x.size());
    const auto raise = [&](Real a) { raise_to_power(x.data(), y.data(), x.size(), a); };
    raise(Real(0.5));
    CHECK(y[0] == 0);
    CHECK(y[1] == 0);
    CHECK(y[2] == infinity);
    for (std::size_t undefined = 3; undefined < 6; ++undefined) CHECK(std::isnan(y[undefined]));
    CHECK(y[6] == std::sqrt(std::numeric_limits<Real>::min()));  // counts as the smallest normal number
    raise(Real(-0.5));
    CHECK(y[0] == infinity);
    CHECK(y[2] == 0);
    raise(Real(0));
    CHECK(y[0] == 1);
    CHECK(y[2] == 1);
}

TEST_CASE("lane_math: what leaves the range ends at its end") {
    const double x[]{1e300, 1e-300};
    double y[2];
    raise_to_power(x, y, 2, 5.0);
    CHECK(y[0] > 1e307);
    CHECK(std::isfinite(y[0]));
    CHECK(y[1] < 1e-307);
    CHECK(y[1] > 0);
}

TEST_CASE_TEMPLATE("lane_math: infinity and NaN are kept", Real, float, double) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity(), nan = std::numeric_limits<Real>::quiet_NaN();
    const Real x[]{1, infinity, nan};
    Real y[]{2, 3, 4};
    keep_infinity(x, y, 3);
    CHECK(y[0] == 2);
    CHECK(y[1] == infinity);
    CHECK(std::isnan(y[2]));
}
