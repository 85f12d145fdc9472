// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <hearth/closure/wall_view.hpp>

using hearth::closure::wall_view;

namespace {

constexpr double pi = 3.14159265358979324;

/// Own packings settled on a flat floor: solid fraction and touching particles on a squared diameter.
constexpr double coverage[][2]{{0.63687, 0.9722}, {0.61780, 0.8819}, {0.59292, 0.7986}, {0.57671, 0.7674}};

}  // namespace

TEST_CASE("wall_view::closed: the touching particles together see a black wall once") {
    CHECK(pi * 0.85 * wall_view::closed::with_coverage(0.85).view_factor(0.5) == doctest::Approx(1).epsilon(1e-15));
    for (const auto& row : coverage) {
        const double solid_fraction = row[0], touching = row[1];
        CAPTURE(solid_fraction);
        // what the fit of the coverage leaves
        CHECK(pi * touching * wall_view::closed(solid_fraction).view_factor(0.5) == doctest::Approx(1).epsilon(0.02));
    }
}

TEST_CASE("wall_view::paper: 0.5 makes the wall more than black") {
    CHECK(wall_view::paper::view_factor(0.5) == 0.5);
    for (const auto& row : coverage) {
        const double touching = row[1];
        const double exchange = pi * touching * wall_view::paper::view_factor(0.5);
        CHECK(exchange > 1.2);
        CHECK(exchange < 1.54);
    }
}

TEST_CASE("wall_view: the bounded factors stay below that of a sphere alone") {
    for (double p = 0.57; p <= 0.64; p += 0.01) {
        CHECK(wall_view::closed(p).view_factor(0.5) < 0.5);
        for (double z = 0.5; z < 4; z += 0.01) REQUIRE(wall_view::bed(p).view_factor(z) < 0.34);
    }
}

TEST_CASE("wall_view::bed: within the stated error of the ray tracing") {
    struct row {
        double solid_fraction, height, factor, noise;
    };
    // own ray tracing against a black floor; noise is the standard error of the mean over it
    constexpr row rows[]{
        {0.6178, 0.5, 0.30229, 0.002},    {0.5929, 0.5, 0.31526, 0.003},    {0.6369, 0.5, 0.29526, 0.002},
        {0.5767, 0.5, 0.32207, 0.003},    {0.6178, 0.7468, 0.19664, 0.044}, {0.5767, 0.9598, 0.14562, 0.14},
        {0.5929, 1.0457, 0.10546, 0.045}, {0.6369, 1.0575, 0.07931, 0.035}, {0.6178, 1.2500, 0.03007, 0.036},
        {0.5767, 1.3450, 0.03459, 0.047}, {0.5929, 1.5268, 0.01807, 0.136}, {0.6178, 1.8997, 0.00522, 0.08},
        {0.6369, 2.3484, 0.00098, 0.082}, {0.5767, 2.7768, 0.00167, 0.054}, {0.5929, 3.2293, 0.00045, 0.044},
        {0.6178, 3.7422, 0.00011, 0.091}};
    double squares = 0;
    for (const row& r : rows) {
        CAPTURE(r.solid_fraction);
        CAPTURE(r.height);
        const double error = wall_view::bed(r.solid_fraction).view_factor(r.height) / r.factor - 1;
        CHECK(std::fabs(error) < (r.height == 0.5 ? 0.025 : 0.22));
        squares += error * error;
    }
    CHECK(std::sqrt(squares / std::size(rows)) < 0.1);
}

TEST_CASE("wall_view::bed: falls with distance; a particle pressed into the wall counts as touching") {
    const wall_view::bed bed(0.6);
    for (double z = 0.5; z < 6; z += 0.01) REQUIRE(bed.view_factor(z + 0.01) < bed.view_factor(z));
    CHECK(bed.view_factor(0.45) == bed.view_factor(0.5));
}

TEST_CASE("wall_view: says who is meant") {
    CHECK(wall_view::paper::touching_only());
    CHECK(wall_view::closed::touching_only());
    CHECK_FALSE(wall_view::bed::touching_only());
}

TEST_CASE("wall_view: settings outside the packings are refused") {
    for (const double bad : {0.56, 0.65, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK_THROWS_AS(wall_view::closed{bad}, std::invalid_argument);
        CHECK_THROWS_AS(wall_view::bed{bad}, std::invalid_argument);
    }
    for (const double bad : {0.6, 1.2, -1.0, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(wall_view::closed::with_coverage(bad), std::invalid_argument);
}
