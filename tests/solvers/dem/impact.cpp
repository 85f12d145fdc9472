// SPDX-License-Identifier: MIT
// Single contacts against their analytic solutions.
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/dem/bed.hpp>

#include "solvers/dem/balls.hpp"
#include "support/random.hpp"

namespace {

using namespace hearth_test;

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
          doctest::Approx(2.868265 *
                          std::pow(mass * mass / 4 / (0.005 * exact.effective_modulus * exact.effective_modulus), 0.2))
              .epsilon(1e-6));
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
            for (hearth::dem::index i = 0; i < 2; ++i) {
                const motion& m = b.motions()[i];
                sum.first += b.mass(i) * m.velocity;
                sum.second += cross(b.spheres()[i].centre, b.mass(i) * m.velocity) + (1 / m.inverse_inertia) * m.spin;
            }
            return sum;
        };
        const auto before = momentum();
        double scale = 0, linear_scale = 0;
        for (hearth::dem::index i = 0; i < 2; ++i) {
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
        for (hearth::dem::index i = 0; i < 2; ++i) {
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
