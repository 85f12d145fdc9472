// SPDX-License-Identifier: MIT
#include <hearth/dem/feed.hpp>

#include <cmath>

#include <doctest/doctest.h>

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>

#include "solvers/dem/packed.hpp"

using namespace hearth::dem;
using hearth_test::feed_into;
using hearth_test::soft_settings;
using hearth_test::tube_on_floor;

namespace {

constexpr double d = 0.018;

double mass_of(const bed& b) {
    double sum = 0;
    for (std::int32_t i = 0; i < b.size(); ++i) sum += b.mass(i);
    return sum;
}

double deepest_overlap(const bed& b) {
    double deepest = 0;
    b.for_each_contact([&](std::int32_t, std::int32_t, double, double overlap, const vector3&) {
        deepest = std::fmax(deepest, overlap);
    });
    return deepest;
}

}  // namespace

TEST_CASE("sizes: the masses of drawn particles follow the sieve table") {
    const size_distribution sizes({{0.016, 0.0}, {0.017, 0.2}, {0.018, 0.7}, {0.0195, 1.0}});
    random_source random{7};
    double total = 0, below[2] = {0, 0};
    const int n = 200000;
    for (int k = 0; k < n; ++k) {
        const double diameter = sizes.draw(random), mass = diameter * diameter * diameter;
        CHECK((diameter >= 0.016 && diameter <= 0.0195));
        total += mass;
        if (diameter < 0.017) below[0] += mass;
        if (diameter < 0.018) below[1] += mass;
    }
    // A share p of n draws scatters by sqrt(p (1 - p) / n): 1e-3; four times that.
    CHECK(std::fabs(below[0] / total - 0.2) < 4e-3);
    CHECK(std::fabs(below[1] / total - 0.7) < 4e-3);
    CHECK(size_distribution({{0.01, 1.0}}).draw(random) == 0.01);
    using table = std::vector<size_distribution::point>;
    for (const table& bad : {table{}, table{{0.02, 0}, {0.01, 1}}, table{{0.01, 0}, {0.02, 0.5}}, table{{0.01, 0.1}, {0.02, 1}},
                             table{{-0.01, 0}, {0.02, 1}}, table{{0.01, 0.0}}}) {
        CHECK_THROWS_AS(size_distribution{bad}, hearth::bad_value);
    }
}

TEST_CASE("feed: exact over time whatever the calls, without overlap; what finds no room waits") {
    const auto run = [](int steps_per_call) {
        bed b = tube_on_floor(soft_settings(0.5, 0.3), 5 * d, 2);
        feed source = feed_into({{0, 0, 0.5}, 5 * d, 5 * d}, 3580, 0.016, 0.0195, 1.3);
        for (int k = 0; k < 12000; k += steps_per_call) {
            source.update(b, steps_per_call * b.settings().step);
            CHECK(deepest_overlap(b) < 0.1 * d);
            b.advance(steps_per_call);
        }
        const double due = 1.3 * b.time();
        CHECK(source.now().brought + source.now().due == doctest::Approx(due).epsilon(1e-12));
        CHECK(source.now().due < 3580 * 0.5236 * 0.0195 * 0.0195 * 0.0195);  // less than one particle
        CHECK(source.now().brought == doctest::Approx(mass_of(b)).epsilon(1e-12));
        CHECK(source.now().particles == b.size());
    };
    run(100);
    run(400);

    bed b = tube_on_floor(soft_settings(0.5, 0.3), 5 * d, 2);
    feed flood = feed_into({{0, 0, 0.1}, 5 * d, 3 * d}, 3580, d, d, 1000);
    const auto report = flood.update(b, 1.0);
    CHECK(report.full);
    CHECK(report.inserted == b.size());
    CHECK(flood.now().brought + flood.now().due == doctest::Approx(1000).epsilon(1e-12));
    CHECK(mass_of(b) == doctest::Approx(flood.now().brought).epsilon(1e-12));

    // A zone that reaches into the floor: refused, and nothing counts as brought.
    bed low = tube_on_floor(soft_settings(0.5, 0.3), 5 * d, 2);
    feed sunk = feed_into({{0, 0, -2 * d}, 5 * d, 3 * d}, 3580, d, d, 1000);
    CHECK_THROWS_AS(sunk.update(low, 1.0), motion_error);
    CHECK(low.size() == 0);
    CHECK(sunk.now().brought == 0);
    CHECK(sunk.now().due == 1000);
}

TEST_CASE("feed and outflow refuse bad settings") {
    CHECK_THROWS_AS(feed_into({{0, 0, 0}, 0.3 * d, d}, 3580, d, d), hearth::bad_value);
    CHECK_THROWS_AS(feed_into({{0, 0, 0}, d, 0.5 * d}, 3580, d, d), hearth::bad_value);
    CHECK_THROWS_AS(feed_into({{0, 0, 0}, d, d}, 0, d, d), hearth::bad_value);
    CHECK_THROWS_AS(feed_into({{0, 0, 0}, d, d}, 3580, d, d, -1), hearth::bad_value);
    outflow::settings s;
    s.mass_flow = -1;
    CHECK_THROWS_AS(outflow{s}, hearth::bad_value);
}

TEST_CASE("filling reaches the level; driven and paper's outflow are exact, and keep the level with an equal feed") {
    for (const auto how : {outflow::rule::driven, outflow::rule::paper}) {
        CAPTURE(static_cast<int>(how));
        const double radius = 5 * d, level = 12 * d, flow = 2.0;
        bed b = tube_on_floor(soft_settings(0.5, 0.3), radius, 2);
        feed source = feed_into({{0, 0, level + 2 * d}, radius, 6 * d}, 3580, 0.016, 0.0195);
        const zone shaft{{0, 0, 0}, radius, level};
        fill_to_level(b, source, shaft, level, 50000);
        hearth_test::settle(b, 20000);
        const double filled = surface_level(b, shaft);
        CHECK(filled > level);
        CHECK(filled < level + 4 * d);

        outflow::settings s;
        s.mass_flow = flow;
        s.how = how;
        outflow sink(s);
        source.set_mass_flow(flow);
        const double fed_before = source.now().brought, started = b.time(), held = mass_of(b);
        double largest_due = 0;
        for (int k = 0; k < 12000; k += 100) {
            b.advance(100);
            source.update(b, 100 * b.settings().step);
            sink.update(b, 100 * b.settings().step);
            largest_due = std::fmax(largest_due, sink.now().due);
        }
        const double seconds = b.time() - started;
        const double one = 3580 * hearth::constants<double>::pi() / 6 * std::pow(0.0195, 3);
        CHECK(sink.now().taken + sink.now().due == doctest::Approx(flow * seconds).epsilon(1e-12));
        // The driven layer follows within a fraction of its mass; the paper's rule within what touches the floor.
        const double layer = 3580 * 0.6 * hearth::constants<double>::pi() * radius * radius * 0.0195;
        CHECK(largest_due < (how == outflow::rule::driven ? 0.3 * layer : 1.5 * layer));
        CHECK(sink.now().taken > 0.5 * flow * seconds);
        CHECK(std::fabs(mass_of(b) - held - (source.now().brought - fed_before) + sink.now().taken) < 1e-9 * held);
        CHECK(source.now().due < one);
        CHECK(surface_level(b, shaft) == doctest::Approx(filled).epsilon(0.12));
        CHECK(sink.now().mass_temperature == doctest::Approx(300 * sink.now().taken).epsilon(1e-12));
        for (std::int32_t i = 0; i < b.size(); ++i) CHECK(b.spheres()[i].centre.z > -2 * d);
    }
}
