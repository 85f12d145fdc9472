// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/gas_film.hpp>

#include "support/tanh_sinh.hpp"

using namespace hearth::closure;

namespace {

constexpr long double pi = 3.14159265358979323846L;

/// The integral of Cheng, Yu and Zulli as they write it, over r, for a sphere of radius 1.
long double film_integral(long double half_gap, long double void_fraction, long double solid, long double faces) {
    const long double middle = 1 + half_gap;
    const long double q = middle * std::cbrt(1 - void_fraction) / 0.56L;  // (R + g)/r_v
    const long double outer = 1 / std::sqrt(1 + q * q);
    const long double rim = half_gap < 0 ? std::sqrt(-half_gap * (2 + half_gap)) : 0;
    return hearth_test::tanh_sinh(outer - rim, [=](long double from_rim, long double to_cone) {
        const bool near_cone = to_cone < from_rim;
        const long double r = near_cone ? outer - to_cone : rim + from_rim;
        // 1 - r^2, exact at the end where the cone is the equator
        const long double w = std::sqrt(q == 0 && near_cone ? to_cone * (2 - to_cone) : (1 - r) * (1 + r));
        // R + g - w without cancellation, from r^2 - rim^2 = (R + g)^2 - w^2
        const long double gap =
            half_gap < 0 ? from_rim * (2 * rim + from_rim) / (middle + w) : half_gap + r * r / (1 + w);
        return 2 * pi * r / ((w - r * q) * solid + faces * gap);
    });
}

film_pair<double> steel_in_air(double gap) { return {gap, 0.0099, 0.0099, 45, 45, 0.026, 0.4}; }

}  // namespace

TEST_CASE("gas_film: eight nodes agree with the integral") {
    double worst = 0;
    for (const long double ratio : {1.0L, 10.0L, 100.0L, 1e3L, 1e4L, 1e5L})
        for (const long double half_gap :
             {-3e-2L, -1e-3L, -1e-5L, -1e-7L, 0.0L, 1e-7L, 1e-5L, 1e-3L, 1e-2L, 0.1L, 0.5L})
            for (const long double void_fraction : {0.1L, 0.35L, 0.4L, 0.7L, 0.9L, 1.0L})
                for (const long double faces : {1.0L, 2.0L}) {
                    CAPTURE(ratio);
                    CAPTURE(half_gap);
                    CAPTURE(void_fraction);
                    const long double solid = faces / ratio;
                    const long double exact = film_integral(half_gap, void_fraction, solid, faces);
                    const long double eight = gas_film::shape<long double>(1, half_gap, void_fraction, solid, faces);
                    const double error = static_cast<double>(std::fabs(eight / exact - 1));
                    CHECK(error <= 1e-5);  // as the header says
                    if (ratio > 5 && ratio < 5e3L) CHECK(error <= 2e-6);
                    worst = std::max(worst, error);
                }
    CHECK(worst > 1e-7);  // the oracle is another rule, not the same one
}

TEST_CASE("gas_film: rises as the gap closes and passes contact without a jump") {
    double last = 0;
    for (double gap = 9e-3; gap > 1e-9; gap /= 1.3) {
        const double now = gas_film::conductance(steel_in_air(gap));
        CHECK(now > last);
        last = now;
    }
    const double contact = gas_film::conductance(steel_in_air(0));
    // The gap of 1 nm is 1e-4 of the depth, 2 um, at which gas and solid resist alike.
    CHECK(gas_film::conductance(steel_in_air(1e-9)) == doctest::Approx(contact).epsilon(1e-3));
    CHECK(gas_film::conductance(steel_in_air(-1e-9)) == doctest::Approx(contact).epsilon(1e-3));
}

TEST_CASE("gas_film: no gas, no film; too far apart, no film") {
    film_pair<double> p = steel_in_air(-1e-7);
    p.gas_conductivity = 0;
    CHECK(gas_film::conductance(p) == 0);
    CHECK(gas_film::wall_conductance(p) == 0);
    CHECK(gas_film::conductance(steel_in_air(1.001 * 0.0099)) == 0);
    CHECK(gas_film::conductance(steel_in_air(0.999 * 0.0099)) > 0);
}

TEST_CASE("gas_film: symmetric in the two particles") {
    const film_pair<double> p{1e-6, 0.008, 0.01, 2, 45, 0.05, 0.4}, q{1e-6, 0.01, 0.008, 45, 2, 0.05, 0.4};
    CHECK(gas_film::conductance(p) == gas_film::conductance(q));
    CHECK(rong_horio::conductance(p) == rong_horio::conductance(q));
}

TEST_CASE("gas_film: a wall is the middle between a particle and its image") {
    for (const double gap : {-1e-7, 0.0, 1e-5, 1e-3}) {
        const film_pair<double> image = steel_in_air(2 * gap), wall = steel_in_air(gap);
        CHECK(gas_film::wall_conductance(wall) == doctest::Approx(2 * gas_film::conductance(image)).epsilon(1e-13));
        CHECK(rong_horio::wall_conductance(wall) == doctest::Approx(2 * rong_horio::conductance(image)).epsilon(1e-13));
    }
}

TEST_CASE("rong_horio: the closed form is the integral over the lens") {
    const long double radius = 0.01L, least = 4e-10L;
    for (const long double half_gap : {-1e-5L, -1e-8L, 0.0L, 1e-10L, 1e-8L, 1e-5L, 5e-4L}) {
        CAPTURE(half_gap);
        // The lens of 1.2 R around one sphere meets the other at this radius (law of cosines).
        const long double d = 2 * (radius + half_gap);
        const long double along = (1.44L * radius * radius - radius * radius + d * d) / (2 * d);
        const long double outer = std::sqrt(1.44L * radius * radius - along * along);
        const long double rim = half_gap < 0 ? std::sqrt(-half_gap * (2 * radius + half_gap)) : 0;
        // split where the shortest gap begins to act
        const long double t = std::max(least / 2, std::max(half_gap, 0.0L));
        const long double w_split = radius + half_gap - t;
        const long double split = std::max(rim, std::sqrt(std::max((radius - w_split) * (radius + w_split), 0.0L)));
        const auto part = [&](long double from, long double to) {
            return hearth_test::tanh_sinh(to - from, [&](long double from_start, long double) {
                const long double r = from + from_start;
                const long double gap = 2 * (half_gap + r * r / (radius + std::sqrt((radius - r) * (radius + r))));
                return 2 * pi * r / std::max(gap, least);
            });
        };
        const long double exact = part(rim, split) + part(split, outer);
        CHECK(static_cast<double>(std::fabs(rong_horio::shape(radius, half_gap) / exact - 1)) <= 1e-12);
    }
}

TEST_CASE("rong_horio: beyond the lens nothing is exchanged") {
    CHECK(rong_horio::conductance(steel_in_air(0.23 * 0.0099)) == 0);
    CHECK(rong_horio::conductance(steel_in_air(0.15 * 0.0099)) > 0);
}
