// SPDX-License-Identifier: MIT
#include <hearth/dem/ranks.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include <hearth/core/error.hpp>

#include "solvers/dem/balls.hpp"
#include "solvers/dem/shared.hpp"
#include "support/random.hpp"

using namespace hearth::dem;
using hearth_test::ball;
using hearth_test::differing;
using hearth_test::plant;
using hearth_test::seeded;
using hearth_test::shared_by_all;
using hearth_test::soft_settings;
using hearth_test::wall_of;

namespace {

constexpr double d = 0.018;

/// Spheres on a loose lattice with random velocities and sizes.
std::vector<particle> cloud(int nx, int ny, int nz, std::uint64_t seed) {
    seeded random(seed);
    std::vector<particle> balls;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const auto speed = [&] { return random.uniform(-1.0, 1.0); };
                balls.push_back(ball({1.05 * d * i, 1.05 * d * j, 1.05 * d * k + 0.6 * d}, {speed(), speed(), speed()},
                                     {20 * speed(), 20 * speed(), 20 * speed()}, random.uniform(0.4 * d, 0.5 * d)));
            }
    return balls;
}

/// Sum over the particles of all ranks in the order of their ids.
template <class Term>
vector3 total(const bed& b, Term&& term) {
    struct part {
        std::int64_t id;
        vector3 value;
    };
    std::vector<part> mine;
    for (std::int32_t i = 0; i < b.size(); ++i) mine.push_back({b.ids()[i], term(i)});
    std::vector<part> all = b.among().gather(mine);
    std::sort(all.begin(), all.end(), [](const part& one, const part& other) { return one.id < other.id; });
    vector3 sum;
    for (const part& p : all) sum += p.value;
    return sum;
}

}  // namespace

TEST_CASE("ranks: fed, stirred and emptied, a bed has the bits of one rank; balanced as it moves") {
    for (const auto how : {outflow::rule::driven, outflow::rule::paper}) {
        const int axis = how == outflow::rule::driven ? 2 : 0;
        CAPTURE(axis);
        plant mine(shared_by_all(axis), how), alone(decomposition{}, how);
        for (int part = 0; part < 3; ++part) {
            mine.run(600);
            alone.run(600);
            CAPTURE(part);
            CHECK(differing(mine.b, alone.b) == 0);
            CHECK(mine.b.rebuilds() == alone.b.rebuilds());
            CHECK(mine.source.now().brought == alone.source.now().brought);
            CHECK(mine.source.now().due == alone.source.now().due);
            CHECK(mine.source.now().random.state == alone.source.now().random.state);
            CHECK(mine.sink.now().taken == alone.sink.now().taken);
            CHECK(mine.sink.now().mass_temperature == alone.sink.now().mass_temperature);
            CHECK(surface_level(mine.b, {{0, 0, 0}, 3 * d, 1}) == surface_level(alone.b, {{0, 0, 0}, 3 * d, 1}));
        }
        CHECK(alone.sink.now().particles > 0);
        // Balanced to a fiftieth and a particle when the lists were made; a few may have left since.
        const double share = static_cast<double>(alone.b.size()) / mine.b.among().size();
        CHECK(mine.b.size() <= 1.02 * share + 1 + 2);
        // Each rank adds its part of the force on the floor: round-off.
        const vector3 force = mine.b.force_on_wall(1), wanted = alone.b.force_on_wall(1);
        CHECK(norm(force - wanted) <= 1e-12 * (1 + norm(wanted)));
    }
}

TEST_CASE("ranks: what falls and piles up is cut anew, with the bits of one rank") {
    bed mine(soft_settings(0.3, 0.3), shared_by_all()), alone(soft_settings(0.3, 0.3));
    for (bed* b : {&mine, &alone}) {
        b->add_wall(wall_of(b->settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
        std::vector<particle> balls = cloud(3, 3, 12, 5);
        for (particle& p : balls) p.velocity.z -= 20 * p.position.z;  // squeezed to a third of its height on the way down
        b->insert(balls);
    }
    for (int part = 0; part < 4; ++part) {
        mine.advance(300);
        alone.advance(300);
        CHECK(differing(mine, alone) == 0);
        const double share = static_cast<double>(alone.size()) / mine.among().size();
        CHECK(mine.size() <= 1.02 * share + 1 + 2);
    }
}

TEST_CASE("ranks: momentum and angular momentum of a free cloud with friction stay, mass to the bit") {
    bed_settings s = soft_settings(0.4, 0.3);
    s.gravity = {};
    bed mine(s, shared_by_all());
    std::vector<particle> balls = cloud(4, 4, 8, 9);
    for (particle& p : balls) p.velocity -= 8.0 * (p.position - vector3{1.6 * d, 1.6 * d, 4.3 * d});  // towards the middle
    mine.insert(balls);
    const auto mass = [&](std::int32_t i) { return vector3{mine.mass(i), 0, 0}; };
    const auto momentum = [&](std::int32_t i) { return mine.mass(i) * mine.motions()[i].velocity; };
    const auto angular = [&](std::int32_t i) {
        const double r = mine.spheres()[i].radius;
        return mine.mass(i) * cross(mine.spheres()[i].centre, mine.motions()[i].velocity) +
               (0.4 * mine.mass(i) * r * r) * mine.motions()[i].spin;
    };
    const vector3 mass_before = total(mine, mass), momentum_before = total(mine, momentum), angular_before = total(mine, angular);
    double scale = 0;
    std::int64_t contacts = 0;
    for (int part = 0; part < 6; ++part) {
        mine.advance(100);
        for (const int c : mine.contact_counts()) contacts += c;
        scale = total(mine, [&](std::int32_t i) { return vector3{norm(momentum(i)), norm(angular(i)), 0}; }).x;
        CHECK(total(mine, mass).x == mass_before.x);
        // Round-off of some 1e5 kicks of 128 particles, each within an ulp of a momentum.
        CHECK(norm(total(mine, momentum) - momentum_before) < 1e-13 * scale);
        CHECK(norm(total(mine, angular) - angular_before) < 1e-13 * scale);
    }
    CHECK(mine.among().sum(contacts) > 30);  // a contact lasts some 25 steps, so this saw a quarter of them
}

TEST_CASE("ranks: empty beds, fewer particles than ranks, one each, and one that is larger than all slabs") {
    for (const int count : {0, 1, 2, 3, 8}) {
        CAPTURE(count);
        bed mine(soft_settings(0.3, 0.3), shared_by_all()), alone(soft_settings(0.3, 0.3));
        for (bed* b : {&mine, &alone}) {
            b->add_wall(wall_of(b->settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
            std::vector<particle> column;
            for (int k = 0; k < count; ++k) column.push_back(ball({1e-4 * k, 0, (0.5 + k) * d}, {0, 0, -0.1}, {}, 0.5 * d));
            b->insert(column);
            b->advance(400);
        }
        CHECK(differing(mine, alone) == 0);
        CHECK(mine.rebuilds() == alone.rebuilds());
    }
    // Twenty times the radius of the small ones; no slab is as thick as it.
    bed mine(soft_settings(0.3, 0.3), shared_by_all()), alone(soft_settings(0.3, 0.3));
    for (bed* b : {&mine, &alone}) {
        b->add_wall(wall_of(b->settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
        std::vector<particle> balls;
        for (int j = -3; j <= 3; ++j)
            for (int i = -3; i <= 3; ++i) balls.push_back(ball({0.01 * i, 0.01 * j, 0.0025 + 1e-3 * (i + 3)}, {}, {}, 0.0025));
        balls.push_back(ball({0, 0, 0.062}, {0, 0, -0.3}, {}, 0.05));
        balls.back().density = 10;  // lest it crush the others
        b->insert(balls);
        b->advance(600);
    }
    CHECK(differing(mine, alone) == 0);
}

TEST_CASE("ranks: a fault on one rank is an error on all, and what was refused has changed nothing") {
    bed mine(soft_settings(0.3, 0.3), shared_by_all());
    mine.add_wall(wall_of(mine.settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
    mine.insert(cloud(2, 2, 10, 3));
    mine.advance(20);
    bed alone(soft_settings(0.3, 0.3));
    alone.add_wall(wall_of(alone.settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
    alone.insert(cloud(2, 2, 10, 3));
    alone.advance(20);
    const int last = mine.among().size() - 1;

    CHECK_THROWS_AS(mine.insert({ball({0, 0, 5 * d}, {}, {}, 0.5 * d)}), motion_error);  // in another
    CHECK_THROWS_AS(mine.insert({ball({5, 0, 0.1 * d}, {}, {}, 0.5 * d), ball({5, 0, 20 * d}, {}, {}, 0.5 * d)}), motion_error);
    CHECK_THROWS_AS(mine.remove(mine.among().rank() == last ? std::vector<std::int32_t>{-1} : std::vector<std::int32_t>{}),
                    hearth::bad_value);
    if (last > 0) {
        const double place = mine.among().rank() == 0 ? 50 * d : 51 * d;
        CHECK_THROWS_AS(mine.insert({ball({0, 0, place}, {})}), hearth::bad_value);  // not the same everywhere
        CHECK_THROWS_AS(mine.near_pairs(2.5), hearth::bad_value);                    // not what the ghosts are there for
    }
    CHECK(differing(mine, alone) == 0);

    decomposition slanted = shared_by_all();
    slanted.axis = 3;
    CHECK_THROWS_AS(bed(soft_settings(0.3, 0.3), slanted), hearth::bad_value);

    // One particle that is too fast, on one rank: all hear of it, by its id.
    for (std::int32_t i = 0; i < mine.size(); ++i)
        if (mine.ids()[i] == 37) mine.set_velocity(i, {0, 0, 1e4}, {});
    try {
        mine.advance(10);
        FAIL("must not get here");
    } catch (const motion_error& e) {
        CHECK(e.id == 37);
        CHECK(std::string(e.what()).find("particle 37 moves at 10000") != std::string::npos);
    }
}
