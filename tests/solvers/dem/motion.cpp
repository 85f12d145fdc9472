// SPDX-License-Identifier: MIT
// Few balls over a longer time: fall, rest, rolling, energy; and what is refused.
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/core/error.hpp>

#include "solvers/dem/balls.hpp"
#include "support/random.hpp"

using namespace hearth_test;

TEST_CASE("free fall: velocity Verlet is exact for a constant acceleration") {
    bed b(settings_of(1e-4, 0.1, 0.5, {0.5, 0, -9.81}));
    b.insert({ball({0, 0, 5}, {1, 2, 3})});
    b.advance(10000);
    const vector3 x = b.spheres()[0].centre, v = b.motions()[0].velocity;
    const double t = 1.0, tolerance = 10000 * 2.3e-16;  // one rounding a step
    CHECK(x.x == doctest::Approx(0 + 1 * t + 0.25 * t * t).epsilon(tolerance));
    CHECK(x.y == doctest::Approx(2 * t).epsilon(tolerance));
    CHECK(x.z == doctest::Approx(5 + 3 * t - 0.5 * 9.81 * t * t).epsilon(tolerance));
    CHECK(v.z == doctest::Approx(3 - 9.81 * t).epsilon(tolerance));
    CHECK(b.time() == doctest::Approx(1.0));
}

TEST_CASE("energy of a conservative system drifts by less than 1e-6 over a million steps") {
    bed_settings s = settings_of(5e-7, 0.0, 0.0);
    bed b(s);
    wall w = floor_of(s);
    w.facets = shape::box({-0.03, -0.03, -0.03}, {0.03, 0.03, 0.03});
    b.add_wall(w);
    hearth_test::seeded random(5);
    std::vector<particle> balls;
    for (int k = 0; k < 8; ++k) {
        const auto side = [&](int bit) { return (k >> bit & 1 ? 0.014 : -0.014) + random.uniform(-0.002, 0.002); };
        balls.push_back(ball({side(0), side(1), side(2)},
                             {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, {},
                             random.uniform(0.008, 0.011)));
    }
    b.insert(balls);
    const auto energy = [&] {
        double sum = 0;
        for (hearth::dem::index i = 0; i < b.size(); ++i)
            sum += 0.5 * b.mass(i) * dot(b.motions()[i].velocity, b.motions()[i].velocity);
        b.for_each_contact([&](hearth::dem::index, hearth::dem::index, double force, double overlap, const vector3&) {
            sum += 0.4 * force * overlap;
        });
        b.for_each_wall_contact([&](hearth::dem::index, int, double force, double overlap, const vector3&) {
            sum += 0.4 * force * overlap;
        });
        return sum;
    };
    // Averages over a while at the beginning and at the end: a symplectic step makes the energy swing, not drift.
    const auto average = [&] {
        double sum = 0;
        for (int k = 0; k < 2000; ++k) {
            b.advance(5);
            sum += energy();
        }
        return sum / 2000;
    };
    const double before = average();
    b.advance(1000000 - 20000);
    const double after = average();
    CAPTURE(before);
    CAPTURE(after);
    CHECK(std::fabs(after / before - 1) < 1e-6);
}

TEST_CASE("two stacked balls between floor and ceiling come to rest under their weights") {
    bed_settings s = settings_of(2e-6, 0.5, 0.3, {0, 0, -9.81});
    bed b(s);
    b.add_wall(floor_of(s));
    const double r = 0.01, gap = 4 * r - 2e-5;  // squeezed a little between the walls
    wall ceiling = floor_of(s);
    ceiling.facets = shape::plane({0, 0, gap}, {0, 0, -1});
    b.add_wall(ceiling);
    b.insert({ball({0, 0, r}, {}), ball({0, 0, gap - r}, {})});
    b.advance(200000);
    const double mass = b.mass(0), weight = mass * 9.81;
    const double below = b.force_on_wall(0).z, above = b.force_on_wall(1).z;
    CHECK(-below - above == doctest::Approx(2 * weight).epsilon(1e-9));
    // Between them the upper ball's weight and the ceiling's push.
    b.for_each_contact([&](hearth::dem::index, hearth::dem::index, double force, double, const vector3&) {
        CHECK(force == doctest::Approx(weight + above).epsilon(1e-9));
    });
    for (hearth::dem::index i = 0; i < 2; ++i) CHECK(norm(b.motions()[i].velocity) < 1e-12);
}

TEST_CASE("a sliding ball begins to roll after 2 v / (7 mu g), at 5/7 of its speed") {
    const double mu = 0.2, g = 9.81, r = 0.01, v0 = 0.5;
    for (const double step : {2e-6, 2e-5}) {  // sliding friction does not depend on the step
        CAPTURE(step);
        bed_settings s = settings_of(step, 0.3, mu, {0, 0, -g});
        bed b(s);
        b.add_wall(floor_of(s));
        const contact_law law = contact_law::with_wall(s.body, s.body, s.contact);
        const double weight = 3580 * 4.0 / 3.0 * pi * r * r * r * g;
        const double sunk = std::pow(weight / (law.normal_stiffness * std::sqrt(r)), 2.0 / 3.0);
        b.insert({ball({0, 0, r - sunk}, {v0, 0, 0})});
        const double t_roll = 2 * v0 / (7 * mu * g);
        b.advance(static_cast<int>(0.5 * t_roll / step));
        CHECK(b.motions()[0].velocity.x == doctest::Approx(v0 - mu * g * b.time()).epsilon(2e-3));
        double rolls_at = 0;
        while (rolls_at == 0 && b.time() < 2 * t_roll) {
            b.advance(1);
            const double slip = b.motions()[0].velocity.x - r * b.motions()[0].spin.y;
            if (slip < 0) rolls_at = b.time();
        }
        CHECK(rolls_at == doctest::Approx(t_roll).epsilon(5e-3));
        b.advance(static_cast<int>(0.05 / step));
        CHECK(b.motions()[0].velocity.x == doctest::Approx(5.0 / 7.0 * v0).epsilon(2e-3));
        CHECK(b.motions()[0].spin.y * r == doctest::Approx(5.0 / 7.0 * v0).epsilon(3e-3));
    }
}

TEST_CASE("sliding friction is mu N at any step; the paper's, whose spring ends with each slip, only at long ones") {
    const double mu = 0.2, g = 9.81, r = 0.01, v0 = 0.5;
    for (const double step : {1e-7, 2e-5}) {
        for (const slip_rule rule : {slip_rule::shorten, slip_rule::paper}) {
            CAPTURE(step);
            bed_settings s = settings_of(step, 0.0, mu, {0, 0, -g});
            s.contact.rule = rule;
            bed b(s);
            b.add_wall(floor_of(s));
            const contact_law law = contact_law::with_wall(s.body, s.body, s.contact);
            const double weight = 3580 * 4.0 / 3.0 * pi * r * r * r * g;
            const double sunk = std::pow(weight / (law.normal_stiffness * std::sqrt(r)), 2.0 / 3.0);
            b.insert({ball({0, 0, r - sunk}, {v0, 0, 0})});
            b.advance(static_cast<int>(2e-3 / step));
            const double found = (v0 - b.motions()[0].velocity.x) / (mu * g * b.time());
            const double steps_to_slip = mu * weight / (law.tangential_stiffness * std::sqrt(r * sunk) * v0 * step);
            if (rule == slip_rule::shorten || steps_to_slip < 1) {
                CHECK(found == doctest::Approx(1).epsilon(0.01));  // but for the first slip
            } else {  // a ramp from 0 to mu N over so many steps, again and again
                CHECK(found > 0.49);
                CHECK(found < 0.5 + 1 / steps_to_slip);
            }
        }
    }
}

TEST_CASE("a ball spinning about the normal keeps its spin; rolling friction brings a rolling one to rest") {
    const double r = 0.01, g = 9.81, mu_r = 0.05, v0 = 0.1;
    bed_settings s = settings_of(1e-5, 0.3, 0.5, {0, 0, -g});
    s.contact.rolling_friction = mu_r;
    bed b(s);
    b.add_wall(floor_of(s));
    b.insert({ball({0, 0, r - 1e-6}, {v0, 0, 0}, {0, v0 / r, 0})});
    // Torque mu_r r m g against 7/5 m r^2: the ball slows by 5/7 mu_r g.
    const double rest = v0 / (5.0 / 7.0 * mu_r * g);
    b.advance(static_cast<int>(0.5 * rest / 1e-5));
    CHECK(b.motions()[0].velocity.x == doctest::Approx(0.5 * v0).epsilon(0.02));
    b.advance(static_cast<int>(1.5 * rest / 1e-5));
    // The elastic part of rolling resistance swings about rest; the amplitude is that of the spring's last stretch.
    CHECK(std::fabs(b.motions()[0].velocity.x) < 0.02 * v0);
}

TEST_CASE("a driven ball keeps its velocity against gravity and contacts, and pushes others") {
    bed_settings s = settings_of(1e-5, 0.3, 0.5, {0, 0, -9.81});
    bed b(s);
    b.insert({ball({0, 0, 0}, {0, 0, 0.1}), ball({0, 0, 0.02}, {0, 0, 0.1})});
    b.set_driven(0, true);
    b.advance(2000);
    const hearth::dem::index driven = b.ids()[0] == 0 ? 0 : 1;
    CHECK(b.motions()[driven].velocity.z == 0.1);
    CHECK(b.motions()[1 - driven].velocity.z == doctest::Approx(0.1).epsilon(1e-3));
}

TEST_CASE("bad input is refused with the bed as it was") {
    bed_settings s = settings_of(1e-5, 0.3, 0.5);
    bed_settings bad = s;
    bad.step = 0;
    CHECK_THROWS_AS(bed{bad}, hearth::bad_value);
    bad = s;
    bad.body.youngs_modulus = -1;
    CHECK_THROWS_AS(bed{bad}, hearth::bad_value);
    bad = s;
    bad.contact.damping = 2.3;
    CHECK_THROWS_AS(bed{bad}, hearth::bad_value);
    bad = s;
    bad.skin = 0;
    CHECK_THROWS_AS(bed{bad}, hearth::bad_value);
    CHECK_THROWS_AS(damping_of_restitution(0.0), hearth::bad_value);

    bed b(s);
    b.add_wall(floor_of(s));
    b.insert({ball({0, 0, 0.02}, {})});
    particle p = ball({0, 0, 0.05}, {});
    p.radius = 0;
    CHECK_THROWS_AS(b.insert({p}), hearth::bad_value);
    p = ball({0, 0, 0.05}, {0, 0, std::nan("")});
    CHECK_THROWS_AS(b.insert({p}), hearth::bad_value);
    CHECK_THROWS_AS(b.insert({ball({0, 0, 0.021}, {})}), motion_error);                          // on top of another
    CHECK_THROWS_AS(b.insert({ball({1, 0, 0.02}, {}), ball({2, 0, 0.002}, {})}), motion_error);  // in the floor
    CHECK(b.size() == 1);
    CHECK(b.ids()[0] == 0);
    CHECK(b.insert({ball({1, 0, 0.02}, {})}) == 1);
    CHECK_THROWS_AS(b.remove({7}), hearth::bad_value);
    // A step that is far too long for the speed is an error that names the particle, not an explosion.
    b.insert({ball({0, 0, 3}, {0, 0, -1e4})});
    CHECK_THROWS_AS(b.advance(1), motion_error);
}

TEST_CASE("an empty bed and a single particle run") {
    bed_settings s = settings_of(1e-5, 0.3, 0.5, {0, 0, -9.81});
    bed b(s);
    b.advance(10);
    CHECK(b.size() == 0);
    b.add_wall(floor_of(s));
    b.advance(10);
    b.insert({ball({0, 0, 1}, {})});
    b.advance(100);
    b.remove({0});
    b.advance(10);
    CHECK(b.size() == 0);
    CHECK(b.steps() == 130);
}
