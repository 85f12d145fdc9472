// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "solvers/dem/packed.hpp"
#include "support/random.hpp"

using namespace hearth::dem;
using hearth_test::feed_into;
using hearth_test::settle;
using hearth_test::soft_settings;
using hearth_test::tube_on_floor;
using hearth_test::wall_of;

namespace {

double kinetic_energy(const bed& b) {
    double sum = 0;
    for (std::int32_t i = 0; i < b.size(); ++i) sum += 0.5 * b.mass(i) * dot(b.motions()[i].velocity, b.motions()[i].velocity);
    return sum;
}

}  // namespace

TEST_CASE("size ratio 1:20: large spheres sink into a bed of small ones and all come to rest; nothing explodes") {
    bed_settings s = soft_settings(0.3, 0.5);
    s.step = 8e-6;  // of the small ones
    const double small = 0.001, large = 0.02;
    bed b = tube_on_floor(s, 0.012, 1);
    feed fine = feed_into({{0, 0, 0}, 0.012, 0.016}, 3000, small, small);
    fine.fill(b);
    particle p;
    p.radius = large / 2;
    p.density = 3000;
    p.position = {0, 0, 0.027};
    p.velocity = {0, 0, -0.5};
    b.insert({p});
    CHECK(b.size() > 1000);
    settle(b, 20000);
    CHECK(kinetic_energy(b) < 1e-5);
    for (std::int32_t i = 0; i < b.size(); ++i) {
        CHECK(b.spheres()[i].centre.z > 0);
        CHECK(std::hypot(b.spheres()[i].centre.x, b.spheres()[i].centre.y) < 0.012);
    }
}

TEST_CASE("softened by 1e-5: a bed of 2e6 Pa settles, with overlaps as Hertz says, and carries its weight") {
    bed_settings s = soft_settings(0.3, 0.5);
    s.body.youngs_modulus = 2e6;
    s.step = 2e-4;
    bed b = tube_on_floor(s, 0.06, 2);
    feed source = feed_into({{0, 0, 0}, 0.06, 0.3}, 3580, 0.016, 0.0195);
    source.fill(b);
    settle(b, 20000);
    b.advance(5000);
    double weight = 0;
    for (std::int32_t i = 0; i < b.size(); ++i) weight += b.mass(i) * 9.81;
    CHECK(-b.force_on_wall(0).z - b.force_on_wall(1).z == doctest::Approx(weight).epsilon(0.01));
    double deepest = 0;
    b.for_each_contact([&](std::int32_t i, std::int32_t, double, double overlap, const vector3&) {
        deepest = std::fmax(deepest, overlap / b.spheres()[i].radius);
    });
    CHECK(deepest > 0.005);
    CHECK(deepest < 0.2);
}

TEST_CASE("a million particles fall at once") {
    bed_settings s = soft_settings(0.3, 0.5);
    bed b(s);
    std::vector<particle> all(1000000);
    hearth_test::seeded random(8);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto at = [&](std::size_t n) { return 0.021 * static_cast<double>(n); };
        all[k].position = {at(k % 100), at(k / 100 % 100), at(k / 10000)};
        all[k].velocity = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        all[k].radius = 0.009;
        all[k].density = 3580;
    }
    b.insert(all);
    double before = 0, after = 0;  // momentum along x: gravity does not change it, collisions neither
    for (std::int32_t i = 0; i < b.size(); ++i) before += b.mass(i) * b.motions()[i].velocity.x;
    b.advance(30);
    CHECK(b.size() == 1000000);
    double scale = 0;
    for (std::int32_t i = 0; i < b.size(); ++i) {
        after += b.mass(i) * b.motions()[i].velocity.x;
        scale += b.mass(i) * std::fabs(b.motions()[i].velocity.x);
    }
    CHECK(std::fabs(after - before) < 1e-10 * scale);
    CHECK(static_cast<double>(b.memory()) < 400.0 * b.size());
}

TEST_CASE("a spring pressed far beyond its settings is an error that names the particle, not an explosion") {
    bed_settings s = soft_settings(0.3, 0.5);
    bed b = tube_on_floor(s, 0.05, 1);
    const int piston = b.add_wall(wall_of(s, shape::plane({0, 0, 0.0203}, {0, 0, -1}), 4));
    particle p;
    p.radius = 0.01;
    p.density = 3580;
    p.position = {0, 0, 0.0101};
    const auto id = b.insert({p});
    wall_motion down;
    down.velocity = {0, 0, -0.5};
    b.set_motion(piston, down);
    try {
        b.advance(10000);
        FAIL("the piston has passed through the particle");
    } catch (const motion_error& error) {
        CHECK(error.id == id);
        CHECK(std::string(error.what()).find("particle 0") != std::string::npos);
    }
}
