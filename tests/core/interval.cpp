// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/core/interval.hpp>
#include <hearth/eigen.hpp>

using hearth::interval;

static_assert(interval{0.35, 1}.contains(0.35) && interval{0.35, 1}.clamp(2.0) == 1.0);

TEST_CASE_TEMPLATE("interval: its ends are inside in every precision", Real, float, double, long double) {
    constexpr interval range{0.35, 0.7};
    CHECK(range.contains(static_cast<Real>(0.35)));
    CHECK(range.contains(static_cast<Real>(0.7)));
    CHECK_FALSE(range.contains(std::nextafter(static_cast<Real>(0.35), Real(0))));
    CHECK_FALSE(range.contains(std::nextafter(static_cast<Real>(0.7), Real(1))));
}

TEST_CASE("interval: clamps to the nearest value inside") {
    constexpr interval range{-1, 2};
    CHECK(range.clamp(-3.0) == -1);
    CHECK(range.clamp(0.5) == 0.5);
    CHECK(range.clamp(std::numeric_limits<double>::infinity()) == 2);
}

TEST_CASE("interval: NaN is outside and stays NaN") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(interval{0, 1}.contains(nan));
    CHECK(std::isnan(interval{0, 1}.clamp(nan)));
}

TEST_CASE("interval: works lane by lane") {
    const Eigen::Array4d x(-1, 0, 0.5, 3);
    CHECK(interval{0, 1}.contains(x).count() == 2);
    CHECK((interval{0, 1}.clamp(x) == Eigen::Array4d(0, 0, 0.5, 1)).all());
}
