// SPDX-License-Identifier: MIT
// Single contacts against their analytic solutions.
#include <hearth/dem/bed.hpp>

#include <cmath>

#include <doctest/doctest.h>

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>

#include "support/random.hpp"

namespace {

using namespace hearth::dem;
constexpr double pi = hearth::constants<double>::pi();

bed_settings settings_of(double step, double damping, double friction, vector3 gravity = {}) {
    bed_settings s;
    s.step = step;
    s.gravity = gravity;
    s.contact.damping = damping;
    s.contact.friction = friction;
    return s;
}

wall floor_of(const bed_settings& s) {
    wall w;
    w.facets = shape::plane({0, 0, 0}, {0, 0, 1});
    w.body = s.body;
    w.contact = s.contact;
    return w;
}

particle ball(vector3 position, vector3 velocity, vector3 spin = {}, double radius = 0.01) {
    particle p;
    p.position = position;
    p.velocity = velocity;
    p.spin = spin;
    p.radius = radius;
    p.density = 3580;
    return p;
}

struct impact {
    double restitution, duration, deepest;
};

/// Head-on impact of two equal balls at 1 m/s, with so many steps per contact.
impact collide(double damping, double steps_per_contact) {
    const double radius = 0.01, speed = 1.0;
    const double mass = 3580 * 4.0 / 3.0 * pi * radius * radius * radius;
    bed_settings s = settings_of(1e-6, damping, 0.0);
    const contact_law law = contact_law::between_particles(s.body, s.contact);
    const double duration = hertz_impact{radius / 2, mass / 2, law.effective_modulus, speed}.duration();
    s.step = duration / steps_per_contact;
    bed b(s);
    const double gap = 0.37 * speed * s.step;  // so that the first touch falls between two steps
    b.insert({ball({-radius - gap / 2, 0, 0}, {speed / 2, 0, 0}), ball({radius + gap / 2, 0, 0}, {-speed / 2, 0, 0})});
    impact result{0, 0, 0};
    double began = -1;
    for (int k = 0; k < static_cast<int>(5 * steps_per_contact); ++k) {
        b.advance(1);
        const double overlap = 2 * radius - std::fabs(b.spheres()[0].centre.x - b.spheres()[1].centre.x);
        const double relative = std::fabs(b.motions()[0].velocity.x - b.motions()[1].velocity.x);
        if (overlap > 0) {
            if (began < 0) began = b.time() - overlap / relative;  // before, they flew at constant speed
            result.deepest = std::fmax(result.deepest, overlap);
        } else if (began > 0) {
            result.restitution = relative / speed;
            result.duration = b.time() + overlap / relative - began;
            break;
        }
    }
    return result;
}

}  // namespace

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

TEST_CASE("restitution: that of Tsuji's dashpot, to 1e-3 at 100 steps a contact and to 1e-6 in the limit") {
    for (const double damping : {0.02, 0.12, 0.3, 0.7, 1.2}) {
        CAPTURE(damping);
        const double exact = restitution_of_damping(damping);
        CHECK(std::fabs(collide(damping, 100).restitution - exact) < 1e-3);
        CHECK(std::fabs(collide(damping, 50000).restitution - exact) < 1e-6);
    }
    CHECK(restitution_of_damping(0.12) == doctest::Approx(0.8446450).epsilon(1e-7));
    CHECK(restitution_of_damping(0.3) == doctest::Approx(0.6535513).epsilon(1e-7));
    for (const double e : {0.05, 0.5, 0.9, 1.0}) {
        CHECK(restitution_of_damping(damping_of_restitution(e)) == doctest::Approx(e).epsilon(1e-14));
    }
}

TEST_CASE("Hertz impact: contact time and largest overlap") {
    const impact found = collide(0.0, 20000);
    const double mass = 3580 * 4.0 / 3.0 * pi * 1e-6;
    const bed_settings s = settings_of(1e-6, 0, 0);
    const hertz_impact exact{0.005, mass / 2, contact_law::between_particles(s.body, s.contact).effective_modulus, 1.0};
    CHECK(found.duration == doctest::Approx(exact.duration()).epsilon(1e-5));
    CHECK(found.deepest == doctest::Approx(exact.largest_overlap()).epsilon(1e-6));
    CHECK(found.restitution == doctest::Approx(1.0).epsilon(1e-7));
    CHECK(exact.duration() ==
          doctest::Approx(2.868265 * std::pow(mass * mass / 4 / (0.005 * exact.effective_modulus * exact.effective_modulus),
                                              0.2)).epsilon(1e-6));
}

TEST_CASE("order: the state of a smooth contact converges with the square of the step, with and without damping") {
    for (const double damping : {0.0, 0.3}) {
        CAPTURE(damping);
        const auto run = [&](int steps) {  // begins in contact, so that the force is smooth over the whole time
            bed b(settings_of(2e-4 / steps, damping, 0.0));
            b.insert({ball({-0.0099, 0, 0}, {0.5, 0, 0}), ball({0.0099, 0, 0}, {-0.5, 0, 0})});
            b.advance(steps);
            return b.spheres()[0].centre.x;
        };
        const double coarse = run(200), middle = run(400), fine = run(800);
        const double order = std::log2(std::fabs((coarse - middle) / (middle - fine)));
        CAPTURE(order);
        CHECK(order > 1.8);
        CHECK(order < 2.3);
    }
}

TEST_CASE("oblique impact with sliding all through: tangential velocity changes by mu (1 + e) v_n, spin by 5/2 of it") {
    const double mu = 0.1, radius = 0.01, vn = 1.0, vt = 3.0;
    bed_settings s = settings_of(1e-7, 0.3, mu);
    bed b(s);
    b.add_wall(floor_of(s));
    b.insert({ball({0, 0, radius + 1e-5}, {vt, 0, -vn})});
    for (int k = 0; k < 200 && b.motions()[0].velocity.z <= 0; ++k) b.advance(100);
    b.advance(20000);
    const motion& m = b.motions()[0];
    const double e = restitution_of_damping(0.3);
    CHECK(m.velocity.z == doctest::Approx(e * vn).epsilon(1e-4));
    // The dashpot pulls at the very end: |normal force| then counts for friction, 2 % of the impulse.
    CHECK(m.velocity.x == doctest::Approx(vt - mu * (1 + e) * vn).epsilon(2e-3));
    // Levers end at the contact point: 1 % overlap, 1 % less spin.
    CHECK(m.spin.y * radius == doctest::Approx(2.5 * mu * (1 + e) * vn).epsilon(0.04));
}

TEST_CASE("angular and linear momentum of a pair are kept to 1e-12 through oblique impacts with friction") {
    hearth_test::seeded random(11);
    for (int trial = 0; trial < 20; ++trial) {
        CAPTURE(trial);
        bed_settings s = settings_of(2e-6, 0.3, 0.6);
        s.contact.rolling_friction = trial % 2 == 0 ? 0.0 : 0.1;
        bed b(s);
        const auto any = [&](double size) {
            return vector3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
        };
        const double r1 = random.uniform(0.003, 0.01), r2 = random.uniform(0.003, 0.02);
        particle one = ball({0, 0, 0}, any(0.5), any(50), r1);
        particle two = ball({0.9 * (r1 + r2), 0.4 * (r1 + r2), 0.3 * (r1 + r2)}, any(0.5), any(50), r2);
        two.velocity.x -= 2;
        b.insert({one, two});
        const auto momentum = [&] {
            std::pair<vector3, vector3> sum;
            for (index i = 0; i < 2; ++i) {
                const motion& m = b.motions()[i];
                sum.first += b.mass(i) * m.velocity;
                sum.second += cross(b.spheres()[i].centre, b.mass(i) * m.velocity) + (1 / m.inverse_inertia) * m.spin;
            }
            return sum;
        };
        const auto before = momentum();
        double scale = 0, linear_scale = 0;
        for (index i = 0; i < 2; ++i) {
            const motion& m = b.motions()[i];
            linear_scale += b.mass(i) * norm(m.velocity);
            scale += b.mass(i) * norm(m.velocity) * (r1 + r2) + norm(m.spin) / m.inverse_inertia;
        }
        b.advance(3000);
        const auto after = momentum();
        CHECK(norm(after.first - before.first) < 1e-12 * linear_scale);
        CHECK(norm(after.second - before.second) < 1e-12 * scale);
    }
}

TEST_CASE("the paper's levers of half a diameter do not keep angular momentum") {
    bed_settings s = settings_of(2e-6, 0.3, 0.6);
    s.contact.rule = slip_rule::paper;
    bed b(s);
    b.insert({ball({0, 0, 0}, {0, 0, 0}), ball({0.0201, 0.005, 0}, {-1, 0, 0})});
    const auto momentum = [&] {
        vector3 sum;
        for (index i = 0; i < 2; ++i) {
            const motion& m = b.motions()[i];
            sum += cross(b.spheres()[i].centre, b.mass(i) * m.velocity) + (1 / m.inverse_inertia) * m.spin;
        }
        return sum.z;
    };
    const double before = momentum();
    b.advance(3000);
    const double change = std::fabs(momentum() / before - 1);
    CHECK(change > 1e-5);
    CHECK(change < 1e-2);
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
        for (index i = 0; i < b.size(); ++i) sum += 0.5 * b.mass(i) * dot(b.motions()[i].velocity, b.motions()[i].velocity);
        b.for_each_contact([&](index, index, double force, double overlap, const vector3&) { sum += 0.4 * force * overlap; });
        b.for_each_wall_contact([&](index, int, double force, double overlap, const vector3&) { sum += 0.4 * force * overlap; });
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
    b.for_each_contact([&](index, index, double force, double, const vector3&) {
        CHECK(force == doctest::Approx(weight + above).epsilon(1e-9));
    });
    for (index i = 0; i < 2; ++i) CHECK(norm(b.motions()[i].velocity) < 1e-12);
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
    const index driven = b.ids()[0] == 0 ? 0 : 1;
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
    CHECK_THROWS_AS(b.insert({ball({0, 0, 0.021}, {})}), motion_error);            // on top of another
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
