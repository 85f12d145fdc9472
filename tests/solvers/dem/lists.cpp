// SPDX-License-Identifier: MIT
// Neighbour lists against all pairs, and what must not depend on them.
#include <algorithm>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/dem/bed.hpp>

#include "support/random.hpp"

namespace {

using namespace hearth::dem;

bed_settings settings_of(double skin = 0.1) {
    bed_settings s;
    s.step = 1e-5;
    s.skin = skin;
    s.contact.damping = 0.3;
    return s;
}

wall container(const bed_settings& s, double half) {
    wall w;
    w.facets = shape::box({-half, -half, -half}, {half, half, half});
    w.contact = s.contact;
    w.body = s.body;
    return w;
}

/// Loose balls on a jittered lattice inside of a box from -half to half.
std::vector<particle> loose(double half, double smallest, double largest, std::uint64_t seed) {
    hearth_test::seeded random(seed);
    std::vector<particle> balls;
    const double a = 2.1 * largest;
    const int n = static_cast<int>((2 * half - 2 * largest) / a);
    for (int k = 0; k < n * n * n; ++k) {
        particle p;
        p.radius = random.uniform(smallest, largest);
        p.density = 2500;
        p.position = {(k % n - 0.5 * (n - 1)) * a, (k / n % n - 0.5 * (n - 1)) * a, (k / n / n - 0.5 * (n - 1)) * a};
        p.velocity = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        balls.push_back(p);
    }
    return balls;
}

using id_pair = std::pair<std::int64_t, std::int64_t>;

std::set<id_pair> touching(const bed& b, bool by_list) {
    std::set<id_pair> found;
    const auto name = [&](hearth::dem::index i, hearth::dem::index j) { return std::minmax(b.ids()[i], b.ids()[j]); };
    if (by_list) {
        b.for_each_contact([&](hearth::dem::index i, hearth::dem::index j, double, double, const vector3&) {
            found.insert(name(i, j));
        });
    } else {
        for (hearth::dem::index i = 0; i < b.size(); ++i)
            for (hearth::dem::index j = i + 1; j < b.size(); ++j)
                if (norm(b.spheres()[i].centre - b.spheres()[j].centre) < b.spheres()[i].radius + b.spheres()[j].radius)
                    found.insert(name(i, j));
    }
    return found;
}

/// Positions in the order of ids.
std::vector<vector3> by_id(const bed& b) {
    std::vector<vector3> x(static_cast<std::size_t>(b.size()));
    for (hearth::dem::index i = 0; i < b.size(); ++i) x[static_cast<std::size_t>(b.ids()[i])] = b.spheres()[i].centre;
    return x;
}

}  // namespace

TEST_CASE("lists: the contacts are those of all pairs, at every stage of a collapse, size ratios to 20") {
    for (const double ratio : {1.0, 1.25, 20.0}) {
        CAPTURE(ratio);
        bed b(settings_of());
        b.add_wall(container(b.settings(), 0.06));
        std::vector<particle> balls = loose(0.06, 0.008 / ratio, 0.008, 3);
        for (particle& p : balls) p.velocity = 0.2 * p.velocity;
        b.insert(balls);
        std::size_t most = 0;
        for (int k = 0; k < 40; ++k) {
            b.advance(ratio > 2 ? 60 : 700);
            const auto listed = touching(b, true);
            CHECK(listed == touching(b, false));
            most = std::max(most, listed.size());
        }
        if (ratio < 2) CHECK(most > balls.size());
    }
}

TEST_CASE("lists: strays far away neither get lost nor change what the others do") {
    const auto run = [](bool stray) {
        bed b(settings_of());
        b.add_wall(container(b.settings(), 0.06));
        b.insert(loose(0.06, 0.006, 0.008, 3));
        if (stray) {
            particle p;
            p.radius = 0.008;
            p.density = 2500;
            p.position = {1e6, -1e5, 1e7};
            b.insert({p});
        }
        b.advance(3000);
        return by_id(b);
    };
    const auto alone = run(false), with = run(true);
    // The same pairs in another order: sums of forces differ by rounding, which collisions let grow.
    for (std::size_t i = 0; i < alone.size(); ++i) CHECK(norm(alone[i] - with[i]) < 1e-6);
}

TEST_CASE("lists: the skin and the moment of a rebuild change the motion by no more than rounding") {
    const auto run = [](double skin, int rebuild_every) {
        bed b(settings_of(skin));
        b.add_wall(container(b.settings(), 0.06));
        b.insert(loose(0.06, 0.006, 0.008, 9));
        for (int k = 0; k < 3000; k += rebuild_every) {
            b.expire_lists();
            b.advance(rebuild_every);
        }
        return by_id(b);
    };
    const auto reference = run(0.1, 3000);
    for (const auto& other : {run(0.02, 3000), run(0.5, 3000), run(0.1, 10)}) {
        for (std::size_t i = 0; i < reference.size(); ++i) CHECK(norm(reference[i] - other[i]) < 1e-6);
    }
}

TEST_CASE("lists: a settled bed is not searched again") {
    bed b(settings_of());
    b.add_wall(container(b.settings(), 0.04));
    b.insert(loose(0.04, 0.007, 0.008, 4));
    b.advance(80000);
    const auto before = b.rebuilds();
    b.advance(20000);
    CHECK(b.rebuilds() <= before + 10);  // a few loose balls still roll; in motion there are some hundred
}

TEST_CASE("the same input gives the same bits, and N + N steps equal 2 N") {
    const auto run = [](int parts) {
        bed b(settings_of());
        b.add_wall(container(b.settings(), 0.05));
        b.insert(loose(0.05, 0.005, 0.008, 5));
        for (int k = 0; k < parts; ++k) b.advance(4000 / parts);
        return by_id(b);
    };
    const auto whole = run(1);
    for (const auto& other : {run(1), run(2), run(400)}) {
        bool equal = true;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            for (int a = 0; a < 3; ++a) equal = equal && whole[i][a] == other[i][a];
        }
        CHECK(equal);
    }
}

TEST_CASE("removing particles leaves the springs of the others alone") {
    bed_settings s = settings_of();
    s.gravity = {0.2, 0, -9.81};  // a slope below the angle of friction: springs hold the balls
    bed b(s);
    wall w;
    w.facets = shape::plane({0, 0, 0}, {0, 0, 1});
    w.contact = s.contact;
    b.add_wall(w);
    std::vector<particle> balls;
    for (int k = 0; k < 20; ++k) {
        particle p;
        p.radius = 0.008;
        p.density = 2500;
        p.position = {0.02 * k, 0, 0.008};
        balls.push_back(p);
    }
    // Wall and ball alone cannot hold a rolling ball; a neighbour behind each stops it.
    for (int k = 0; k < 20; ++k) {
        particle p = balls[static_cast<std::size_t>(k)];
        p.position.y = 0.0159;
        balls.push_back(p);
    }
    b.insert(balls);
    b.advance(1000);
    bed_settings same = s;
    bed control(same);
    control.add_wall(w);
    control.insert(balls);
    control.advance(1000);
    std::vector<hearth::dem::index> out;
    for (hearth::dem::index i = 0; i < b.size(); ++i)
        if (b.ids()[i] % 20 % 2 == 0) out.push_back(i);
    b.remove(out);
    CHECK(b.size() == 20);
    b.advance(1000);
    control.advance(1000);
    const auto expected = by_id(control);
    for (hearth::dem::index i = 0; i < b.size(); ++i) {
        CHECK(norm(b.spheres()[i].centre - expected[static_cast<std::size_t>(b.ids()[i])]) < 1e-12);
    }
}
