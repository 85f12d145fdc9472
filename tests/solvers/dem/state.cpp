// SPDX-License-Identifier: MIT
#include <cstring>

#include <doctest/doctest.h>

#include "solvers/dem/packed.hpp"

using namespace hearth::dem;
using hearth_test::feed_into;
using hearth_test::soft_settings;
using hearth_test::wall_of;

namespace {

constexpr double d = 0.018;

/// A drum that turns, with feed and outflow: everything that has a state.
struct plant {
    bed b;
    feed source;
    outflow sink;

    explicit plant(double friction = 0.5)
        : b(settings(friction)), source(feed_into({{0, 0, 0.3}, 3 * d, 4 * d}, 3580, 0.8 * d, d, 3.0)), sink(leaving()) {
        b.add_wall(wall_of(b.settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
        b.add_wall(wall_of(b.settings(), shape::cylinder({0, 0, -1}, {0, 0, 2}, 4 * d)));
        wall stirrer = wall_of(b.settings(), shape::box({-3 * d, -0.3 * d, d}, {3 * d, 0.3 * d, 2 * d}), 3);
        stirrer.motion.spin = {0, 0, 3};
        b.add_wall(stirrer);
    }
    static bed_settings settings(double friction) {
        bed_settings s = soft_settings(friction, 0.3);
        s.contact.rolling_friction = 0.02;
        return s;
    }
    static outflow::settings leaving() {
        outflow::settings s;
        s.mass_flow = 1.0;
        s.how = outflow::rule::paper;
        return s;
    }
    void run(int steps) {
        for (int k = 0; k < steps; k += 50) {
            source.update(b, 50 * b.settings().step);
            sink.update(b, 50 * b.settings().step);
            b.advance(50);
            b.update_flight();
        }
    }
};

/// The same particles in the same order, to the last bit of everything that moves.
bool equal(const bed& a, const bed& b) {
    const auto n = static_cast<std::size_t>(a.size());
    return a.size() == b.size() && std::memcmp(a.spheres(), b.spheres(), n * sizeof(sphere)) == 0 &&
           std::memcmp(a.motions(), b.motions(), n * sizeof(motion)) == 0 && std::memcmp(a.ids(), b.ids(), n * 8) == 0 &&
           std::memcmp(a.loads(), b.loads(), n * sizeof(load)) == 0;
}

}  // namespace

TEST_CASE("restart: N + N steps with feed, outflow and moving walls equal 2 N, bit for bit") {
    plant whole;
    whole.run(6000);
    CHECK(whole.sink.now().particles > 0);
    const auto bytes = whole.b.state();
    const auto fed = whole.source.now();
    const auto left = whole.sink.now();
    whole.run(6000);

    plant again;
    again.run(500);  // whatever it was before
    again.b.restore(bytes);
    again.source.restore(fed);
    again.sink.restore(left);
    CHECK(again.b.state() == bytes);
    again.run(6000);
    CHECK(equal(whole.b, again.b));
    CHECK(whole.b.time() == again.b.time());
    CHECK(whole.source.now().brought == again.source.now().brought);
    CHECK(whole.sink.now().taken == again.sink.now().taken);
    CHECK(whole.b.state() == again.b.state());
}

TEST_CASE("restart: a state that is damaged, cut off or of other settings is refused, with the bed as it was") {
    plant made;
    made.run(2000);
    const auto bytes = made.b.state();
    plant other;
    other.run(1000);
    const auto before = other.b.state();
    for (const std::size_t at : {std::size_t{0}, std::size_t{9}, bytes.size() / 2, bytes.size() - 1}) {
        auto damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 4);
        CAPTURE(at);
        CHECK_THROWS_AS(other.b.restore(damaged), state_error);
    }
    for (const std::size_t length : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1}) {
        CHECK_THROWS_AS(other.b.restore({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}), state_error);
    }
    CHECK(other.b.state() == before);
    plant rougher(0.6);
    CHECK_THROWS_AS(rougher.b.restore(bytes), state_error);
    bed without_walls(made.b.settings());
    CHECK_THROWS_AS(without_walls.restore(bytes), state_error);
}
