// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <type_traits>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/eigen.hpp>

using namespace hearth;

using lanes = Eigen::Array<double, 8, 1>;
using dual = Eigen::AutoDiffScalar<Eigen::Vector2d>;

static_assert(std::is_same_v<real_t<Eigen::Array<float, 16, 1>>, float>);
static_assert(std::is_same_v<value_t<std::decay_t<decltype(lanes() + lanes())>>, lanes>,
              "expressions evaluate to their lanes");
static_assert(std::is_same_v<real_t<dual>, double>);

TEST_CASE_TEMPLATE("lanes: special values", Lanes, Eigen::Array<double, 8, 1>, Eigen::Array<float, 16, 1>,
                   Eigen::Array<long double, 2, 1>) {
    using real = typename Lanes::Scalar;
    const real infinity = std::numeric_limits<real>::infinity();
    const real nan = std::numeric_limits<real>::quiet_NaN();
    const auto all = [](real v) { return Lanes(Lanes::Constant(v)); };
    CHECK((power(all(0), real(0.2L)) == real(0)).all());
    CHECK((power(all(0), real(0)) == real(1)).all());
    CHECK((power(all(0), real(-0.343L)) == infinity).all());
    CHECK(power(all(-1), real(0.2L)).isNaN().all());
    CHECK(power(all(nan), real(0.2L)).isNaN().all());
    CHECK((power(all(infinity), real(0.2L)) == infinity).all());
    CHECK((variable_power(all(0), all(real(0.5L))) == real(0)).all());
    CHECK((cube_root(all(0)) == real(0)).all());
    CHECK((square_root(all(0)) == real(0)).all());
    CHECK((square_root(all(infinity)) == infinity).all());
    CHECK(square_root(all(nan)).isNaN().all());
    CHECK(square_root(all(-1)).isNaN().all());
    CHECK((cube_root(all(-8)).isNaN() || cube_root(all(-8)) == real(-2)).all());  // defined for x >= 0 only
    // Eigen's own vectorised exponential ends at the smallest number instead of zero
    CHECK((exponential(all(-infinity)) <= std::numeric_limits<real>::min()).all());
    CHECK((exponential_minus_one(all(0)) == real(0)).all());
    CHECK((absolute(all(-2)) == real(2)).all());
}

TEST_CASE("lanes: selection, bounds and shape") {
    lanes x;
    x << 0, 1, 2, 3, 4, 5, 6, 7;
    CHECK((select(x > 3.0, x, uniform(x, -1.0)) == (lanes() << -1, -1, -1, -1, 4, 5, 6, 7).finished()).all());
    CHECK((minimum(x, uniform(x, 4.0)) == x.min(4.0)).all());
    CHECK((maximum(x, uniform(x, 4.0)) == x.max(4.0)).all());
    CHECK(lane_count(x) == 8);
    CHECK(lane(x, 3) == 3);
    const Eigen::ArrayXd dynamic = Eigen::ArrayXd::Constant(5, 2);
    CHECK(uniform(dynamic, 1.0).size() == 5);
    CHECK((square(dynamic) == 4.0).all());
}

TEST_CASE("lanes: functions take expressions") {
    const lanes x = lanes::Constant(2), y = lanes::Constant(8);
    CHECK((cube_root(x * 4.0) == cube_root(y)).all());
    CHECK((power(x + x + x + x, 0.5) == power(y, 0.5)).all());
    CHECK((maximum<lanes>(x - y, uniform(x, 0.0)) == 0.0).all());
}

TEST_CASE("duals: functions and their derivatives") {
    const dual x(0.37, 2, 0);
    const auto check = [](const dual& y, double value, double slope) {
        CHECK(y.value() == doctest::Approx(value).epsilon(1e-15));
        CHECK(y.derivatives()[0] == doctest::Approx(slope).epsilon(1e-14));
        CHECK(y.derivatives()[1] == 0);
    };
    check(power(x, 0.7), std::pow(0.37, 0.7), 0.7 * std::pow(0.37, -0.3));
    check(square_root(x), std::sqrt(0.37), 0.5 / std::sqrt(0.37));
    check(cube_root(x), std::cbrt(0.37), std::pow(0.37, -2.0 / 3) / 3);
    check(exponential(x), std::exp(0.37), std::exp(0.37));
    check(exponential_minus_one(x), std::expm1(0.37), std::exp(0.37));
    check(logarithm(x), std::log(0.37), 1 / 0.37);
    check(absolute(dual(-0.37, 2, 0)), 0.37, -1);
    check(variable_power(x, uniform(x, 0.7)), std::pow(0.37, 0.7), 0.7 * std::pow(0.37, -0.3));
    check(variable_power(uniform(x, 0.7), x), std::pow(0.7, 0.37), std::log(0.7) * std::pow(0.7, 0.37));
    check(square_root(x * x), 0.37, 1);  // an expression
}

TEST_CASE("duals: a root at zero is infinitely steep in its own direction and flat in all others") {
    const dual x(0.0, 2, 0);
    for (const dual& y : {power(x, 0.2), square_root(x), cube_root(x), variable_power(x, uniform(x, 0.2))}) {
        CHECK(y.value() == 0);
        CHECK(y.derivatives()[0] == std::numeric_limits<double>::infinity());
        CHECK(y.derivatives()[1] == 0);
    }
    const dual constant = uniform(x, 0.0);
    CHECK(power(constant, 0.2).derivatives().isZero(0));
}
