// SPDX-License-Identifier: MIT
// Beds that a rule moves: by the record of a short DEM run, as a plug, or not at all.
#include <hearth/dem/recording.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>

#include "solvers/dem/packed.hpp"

using namespace hearth::dem;
using hearth_test::feed_into;
using hearth_test::soft_settings;
using hearth_test::tube_on_floor;

namespace {

constexpr double pi = hearth::constants<double>::pi();
constexpr double d = 0.018, radius = 5 * d, level = 12 * d, flow = 2.0;
const zone shaft{{0, 0, 0}, radius, level};

/// A tube that is fed as much as it discharges.
struct running_tube {
    bed particles = tube_on_floor(soft_settings(0.5, 0.3), radius, 2);
    feed source = feed_into({{0, 0, level + 2 * d}, radius, 6 * d}, 3580, 0.016, 0.0195);
    outflow sink = outflow({0, 0, flow});

    running_tube() {
        fill_to_level(particles, source, shaft, level, 50000);
        hearth_test::settle(particles, 20000);
        source.set_mass_flow(flow);
        run(0.5, [] {});
    }
    template <class See>
    void run(double seconds, See&& see) {
        constexpr int steps = 400;
        const double each = steps * particles.settings().step;
        for (double t = 0; t < seconds; t += each) {
            for (int k = 0; k < 4; ++k) {
                particles.advance(steps / 4);
                source.update(particles, each / 4);
                sink.update(particles, each / 4);
            }
            see();
        }
    }
};

/// Share of a ball that is void: the rest are the lenses and spheres that lie in it.
double void_in_ball(const sphere* all, std::int32_t count, const vector3& centre, double ball) {
    double solid = 0;
    for (std::int32_t i = 0; i < count; ++i) {
        const double r = all[i].radius, gap = norm(all[i].centre - centre);
        if (gap >= ball + r) continue;
        if (gap <= ball - r) {
            solid += 4.0 / 3.0 * pi * r * r * r;
        } else {
            const double s = ball + r - gap;
            solid += pi * s * s * (gap * gap + 2 * gap * (ball + r) - 3 * (ball - r) * (ball - r)) / (12 * gap);
        }
    }
    return 1 - solid / (4.0 / 3.0 * pi * ball * ball * ball);
}

/// Void fractions in balls of 3 d inside the bed: their mean in space, and the mean in time of each.
struct ball_voids {
    std::vector<vector3> centres;
    std::vector<double> sum;
    double samples = 0;

    ball_voids() {
        for (double z = 3 * d; z < level - 2.5 * d; z += d)
            for (double y = -3.5 * d; y <= 3.5 * d; y += d)
                for (double x = -3.5 * d; x <= 3.5 * d; x += d)
                    if (std::hypot(x, y) <= radius - 1.5 * d) centres.push_back({x, y, z});
        sum.assign(centres.size(), 0.0);
    }
    void see(const sphere* all, std::int32_t count, double weight = 1) {
        for (std::size_t k = 0; k < centres.size(); ++k) sum[k] += weight * void_in_ball(all, count, centres[k], 1.5 * d);
        samples += weight;
    }
    double mean() const {
        double total = 0;
        for (const double s : sum) total += s;
        return total / (samples * static_cast<double>(sum.size()));
    }
};

double deepest(const bed& b) {
    double overlap = 0;
    b.for_each_contact([&](std::int32_t, std::int32_t, double, double o, const vector3&) { overlap = std::fmax(overlap, o); });
    return overlap;
}
double deepest(const moving_bed& b) {
    double overlap = 0;
    b.for_each_contact([&](std::int32_t, std::int32_t, double, double o, const vector3&) { overlap = std::fmax(overlap, o); });
    return overlap;
}

/// One DEM run for all tests: recorded over one second, then watched for another one.
struct recorded_tube {
    running_tube dem;
    std::shared_ptr<const recording> record;
    ball_voids later;
    double deepest_overlap = 0;

    recorded_tube() {
        recorder watch({shaft, 5, 6});
        dem.run(1.0, [&] {
            watch.observe(dem.particles);
            deepest_overlap = std::fmax(deepest_overlap, deepest(dem.particles));
        });
        record = std::make_shared<const recording>(watch.finish());
        dem.run(1.0, [&] { later.see(dem.particles.spheres(), dem.particles.size()); });
    }
    recorded_bed repeat(double mass_flow) const {
        return recorded_bed(record, surroundings::of(dem.particles), mass_flow);
    }
};

const recorded_tube& tube() {
    static const recorded_tube made;
    return made;
}

}  // namespace

TEST_CASE("recorded motion: the packing stays that of the DEM run, however long and fast it is repeated") {
    recorded_bed b = tube().repeat(1000 * flow);  // Gamma a thousand times that of the run
    ball_voids seen;
    double overlap = 0;
    for (int k = 0; k < 400; ++k) {
        b.advance(0.4173e-3);  // some 160 turns of the record; no multiple of its frames
        overlap = std::fmax(overlap, deepest(b));
        if (k % 10 == 0) seen.see(b.spheres().data(), b.size());
    }
    CHECK(overlap <= tube().deepest_overlap);
    const recording::seam& seam = tube().record->joint();
    MESSAGE("void fraction in balls of 3 d: repeated " << seen.mean() << ", DEM afterwards " << tube().later.mean()
                                                       << "; step at the seam " << seam.mean_step / d << " d, longest "
                                                       << seam.longest_step / d << " d");
    CHECK(std::fabs(seen.mean() - tube().later.mean()) < 0.01);
    CHECK(seam.mean_step < d);
    CHECK(seam.longest_step < 4 * d);
}

TEST_CASE("recorded motion: mass flow is exact over time, nobody is lost, nobody leaves twice") {
    REQUIRE(tube().record->frames().size() > 10);
    for (const double step : {1e-3, 0.37, 11.0, 500.0}) {
        CAPTURE(step);
        recorded_bed b = tube().repeat(flow);
        const double held = b.total_mass();
        std::set<std::int64_t> gone;
        double in = 0, out = 0, time = 0;
        const int moves = step < 0.1 ? 1000 : step < 100 ? 60 : 3;
        for (int k = 0; k < moves; ++k) {
            const std::vector<std::int64_t> before = b.ids();
            const passage p = b.advance(step);
            time += step;
            in += p.mass_in;
            out += p.mass_out;
            CHECK(p.origin.size() == static_cast<std::size_t>(b.size()));
            double left = 0;
            for (const passage::leaver& l : p.left) {
                CHECK(gone.insert(l.id).second);
                if (l.from != passage::fed) CHECK(before[static_cast<std::size_t>(l.from)] == l.id);
                left += l.mass;
            }
            CHECK(left == doctest::Approx(p.mass_out).epsilon(1e-12));
            std::size_t stayed = 0, same = 0;
            for (std::size_t i = 0; i < p.origin.size(); ++i) {
                if (p.origin[i] == passage::fed) continue;
                ++stayed;
                same += before[static_cast<std::size_t>(p.origin[i])] == b.ids()[i];
            }
            CHECK(same == stayed);
            std::size_t left_of_before = 0;
            for (const passage::leaver& l : p.left) left_of_before += l.from != passage::fed;
            CHECK(stayed + left_of_before == before.size());
            const std::set<std::int64_t> alive(b.ids().begin(), b.ids().end());
            CHECK(alive.size() == b.ids().size());
            CHECK(b.now().due >= 0);
            CHECK(b.now().due < 0.05 * held);  // what leaves between two frames, at most
        }
        CHECK(out + b.now().due == doctest::Approx(flow * time).epsilon(1e-12));
        CHECK(std::fabs(in - out - (b.total_mass() - held)) < 1e-12 * (held + in));
        CHECK(std::fabs(b.total_mass() / held - 1) < 0.05);  // the run's own changes of level
        for (const auto id : b.ids()) CHECK(gone.count(id) == 0);
    }
}

TEST_CASE("recorded motion: in a turn the same mass is fed, however it is cut into steps") {
    const double turn = tube().record->mass_of_turn();
    for (const int steps : {7, 1000}) {
        recorded_bed b = tube().repeat(flow);
        double in = 0;
        std::size_t turns = 0, place = 0;
        while (turns < 3) {
            in += b.advance(turn / flow / steps).mass_in;
            if (b.now().place < place) ++turns;
            place = b.now().place;
        }
        // Up to the frame that it stands at: what a few frames feed is what it can be ahead.
        CHECK(in / turn >= 3 - 1e-12);
        CHECK(in / turn < 3.5);
        if (steps == 1000) CHECK(in / turn == doctest::Approx(3).epsilon(0.05));
    }
}

TEST_CASE("recorded motion: particles sink from the surface to the bottom in mass over mass flow; what they carry comes along") {
    recorded_bed b = tube().repeat(flow);
    const double residence = b.total_mass() / flow;
    std::vector<double> fed_at(static_cast<std::size_t>(b.size()), -1e9), heat(static_cast<std::size_t>(b.size()), 400.0);
    double time = 0, sum = 0, squares = 0, weight = 0, kept = 0, in = 0, out = 0;
    for (std::size_t i = 0; i < heat.size(); ++i) kept += b.masses()[i] * heat[i];
    while (time < 8 * residence) {
        const passage p = b.advance(0.02);
        time += 0.02;
        for (const passage::leaver& l : p.left) {
            REQUIRE(l.from != passage::fed);  // no way through the bed within a move
            const double stay = time - fed_at[static_cast<std::size_t>(l.from)];
            out += l.mass * heat[static_cast<std::size_t>(l.from)];
            if (stay > 1e6) continue;  // there from the start
            sum += l.mass * stay;
            squares += l.mass * stay * stay;
            weight += l.mass;
        }
        in += p.mass_in * 300.0;
        p.carry(fed_at, time);
        p.carry(heat, 300.0);
    }
    double now = 0;
    for (std::size_t i = 0; i < heat.size(); ++i) now += b.masses()[i] * heat[i];
    CHECK(now == doctest::Approx(kept + in - out).epsilon(1e-12));
    const double mean = sum / weight, spread = std::sqrt(squares / weight - mean * mean);
    MESSAGE("residence " << mean << " s of " << residence << " s, spread " << spread << " s");
    CHECK(std::fabs(mean / residence - 1) < 0.05);
    // Steps at the seam are about 0.7 d every 2 d of way, 12 d in all: 1.7 d of 12 d, and slower rings at the wall add theirs.
    CHECK(spread < 0.3 * residence);
}

TEST_CASE("recorded motion: mean velocities carry the mass flow through every cross-section") {
    const motion_field& f = tube().record->field();
    const double ring = radius / f.rings;
    for (int layer = 1; layer + 1 < f.layers; ++layer) {
        double flux = 0;
        for (int r = 0; r < f.rings; ++r) {
            const auto& m = f.bins[static_cast<std::size_t>(layer * f.rings + r)];
            CHECK(m.axial < 0);
            CHECK(m.solid_fraction > 0.4);
            CHECK(m.solid_fraction < 0.7);
            flux -= m.axial * m.solid_fraction * 3580 * pi * ring * ring * (2 * r + 1);
        }
        CHECK(std::fabs(flux - 1) < 0.15);  // 30 frames of 200 particles, of 20 % scatter each
    }
    recorded_bed b = tube().repeat(3.0);
    double speed = 0;
    for (std::int32_t i = 0; i < b.size(); ++i) speed -= b.masses()[static_cast<std::size_t>(i)] * b.velocity(i).z;
    CHECK(std::fabs(speed / (3.0 * level) - 1) < 0.15);
}

TEST_CASE("moving beds go on from their state bit for bit; other states are refused and change nothing") {
    const auto bytes = tube().record->bytes();
    const auto again = std::make_shared<const recording>(recording::read(bytes));
    CHECK(again->bytes() == bytes);
    const surroundings around = surroundings::of(tube().dem.particles);
    recorded_bed b = tube().repeat(flow), other(again, around, 7.0);
    for (int k = 0; k < 40; ++k) b.advance(0.171);
    other.restore(b.state());
    for (int k = 0; k < 40; ++k) {
        b.advance(0.171);
        other.advance(0.171);
    }
    CHECK(b.state() == other.state());

    frozen_bed frozen(tube().dem.particles);
    const auto before = b.state();
    CHECK_THROWS_AS(b.restore(frozen.state()), state_error);
    auto damaged = before;
    damaged[damaged.size() / 2] ^= 1;
    CHECK_THROWS_AS(b.restore(damaged), state_error);
    CHECK_THROWS_AS(b.restore({}), state_error);
    CHECK(b.state() == before);
    auto cut = bytes;
    cut.resize(cut.size() / 2);
    CHECK_THROWS_AS(recording::read(cut), state_error);
    CHECK_THROWS_AS(recorded_bed(nullptr, around, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(b.advance(-1), hearth::bad_value);
    CHECK_THROWS_AS(b.advance(std::nan("")), hearth::bad_value);
    CHECK_THROWS_AS(b.set_mass_flow(-1), hearth::bad_value);
    CHECK(b.state() == before);
}

TEST_CASE("a recorder refuses a bed that nobody leaves, one that empties, and bad settings") {
    recorder idle({shaft, 5, 6});
    bed b = tube_on_floor(soft_settings(0.5, 0.3), radius, 2);
    CHECK(idle.observe(b));
    CHECK(!idle.observe(b));
    CHECK_THROWS_AS(idle.finish(), hearth::bad_value);

    running_tube empties;
    empties.source.set_mass_flow(0);
    recorder watch({shaft, 5, 6});
    empties.run(2.0, [&] { watch.observe(empties.particles); });
    CHECK_THROWS_AS(watch.finish(), hearth::bad_value);
    CHECK_THROWS_AS(recorder(recording::settings{{{0, 0, 0}, 0, 1}}), hearth::bad_value);
    CHECK_THROWS_AS(recorder(recording::settings{shaft, 0, 6}), hearth::bad_value);
    CHECK_THROWS_AS(recorder(recording::settings{shaft, 5, 6, -1.0}), hearth::bad_value);
}

TEST_CASE("frozen bed: stays, and has the contacts, forces and walls of the DEM bed it was made of") {
    const bed& b = tube().dem.particles;
    frozen_bed frozen(b);
    const passage p = frozen.advance(1e6);
    CHECK(p.left.empty());
    for (std::int32_t i = 0; i < frozen.size(); ++i) CHECK(p.origin[static_cast<std::size_t>(i)] == i);
    using found = std::map<std::pair<std::int32_t, std::int32_t>, double>;
    const auto pairs_of = [](const auto& any) {
        found all;
        any.for_each_contact([&](std::int32_t i, std::int32_t j, double force, double, const vector3&) {
            CHECK(all.emplace(std::minmax(i, j), force).second);
        });
        return all;
    };
    const found expected = pairs_of(b), got = pairs_of(frozen);
    REQUIRE(got.size() == expected.size());
    for (const auto& [pair, force] : expected) {
        const double here = got.count(pair) ? got.at(pair) : -1.0;
        CHECK(here == doctest::Approx(force).epsilon(1e-12));
    }
    // The open floor is no wall.
    std::vector<bed::touch> walls = frozen.wall_touches(), dem_walls = b.wall_touches();
    REQUIRE(walls.size() == dem_walls.size());
    const auto by_index = [](const bed::touch& x, const bed::touch& y) { return x.i < y.i; };
    std::sort(walls.begin(), walls.end(), by_index);
    std::sort(dem_walls.begin(), dem_walls.end(), by_index);
    for (std::size_t k = 0; k < walls.size(); ++k) {
        CHECK(walls[k].i == dem_walls[k].i);
        CHECK(walls[k].overlap == doctest::Approx(dem_walls[k].overlap).epsilon(1e-12));
    }
    std::size_t near = 0, near_dem = 0, wall_near = 0, wall_near_dem = 0;
    frozen.for_each_near(2.5, [&](std::int32_t, std::int32_t, double) { ++near; });
    b.for_each_near(2.5, [&](std::int32_t, std::int32_t, double) { ++near_dem; });
    CHECK(near == near_dem);
    // Between two heights: every pair with one centre there, and none that is far from it.
    double low = std::numeric_limits<double>::infinity(), high = -low, largest = 0;
    for (const sphere& s : frozen.spheres()) {
        low = std::min(low, s.centre.z);
        high = std::max(high, s.centre.z);
        largest = std::max(largest, s.radius);
    }
    const double from = low + 0.4 * (high - low), to = low + 0.5 * (high - low);
    const auto between = [&](std::int32_t i) {
        const double z = frozen.spheres()[static_cast<std::size_t>(i)].centre.z;
        return z >= from && z <= to;
    };
    std::set<std::pair<std::int32_t, std::int32_t>> wanted, seen;
    frozen.for_each_near(1.5, [&](std::int32_t i, std::int32_t j, double) {
        if (between(i) || between(j)) wanted.insert(std::minmax(i, j));
    });
    frozen.look_between(from, to);
    frozen.for_each_near(1.5, [&](std::int32_t i, std::int32_t j, double) {
        for (const std::int32_t k : {i, j}) {
            const double z = frozen.spheres()[static_cast<std::size_t>(k)].centre.z;
            CHECK(z >= from - 3 * largest);
            CHECK(z <= to + 3 * largest);
        }
        if (between(i) || between(j)) CHECK(seen.insert(std::minmax(i, j)).second);
    });
    CHECK(wanted.size() > 10);
    CHECK(seen == wanted);
    CHECK_THROWS_AS(frozen.look_between(1, 0), hearth::bad_value);
    frozen.for_each_near_wall(1.0, [&](std::int32_t, int, double) { ++wall_near; });
    b.for_each_near_wall(1.0, [&](std::int32_t, int, double) { ++wall_near_dem; });
    CHECK(wall_near == wall_near_dem);
    frozen.set_patch_temperature(1, 900);
    CHECK(frozen.patch_temperature(1) == 900);
    CHECK_THROWS_AS(frozen.set_patch_temperature(5, 900), hearth::bad_value);
}

TEST_CASE("plug: sinks as a body, exact in mass over whole turns, for steps short or longer than the shaft") {
    const auto lattice = [](double mass_flow) {
        std::vector<sphere> spheres;
        std::vector<double> masses;
        for (int k = 0; k < 10; ++k)
            for (int i = 0; i < 7; ++i) {
                spheres.push_back({{0.02 * i, 0.001 * k, 0.01 + 0.02 * k}, 0.009});
                masses.push_back(0.01 + 0.001 * i);
            }
        return plug_bed(spheres, masses, {{0, 0, 0}, 0.2, 0.2}, surroundings{}, mass_flow);
    };
    plug_bed b = lattice(0.5);
    const double held = b.total_mass();
    for (const double step : {0.003, 0.3, 40.0}) {
        double time = 0;
        plug_bed moved = lattice(0.5);
        for (int k = 0; k < 50; ++k) {
            moved.advance(step);
            time += step;
            CHECK(std::fabs(moved.now().out + moved.now().due - 0.5 * time) < 1e-12 * (1 + 0.5 * time));
            CHECK(moved.now().out == doctest::Approx(moved.now().in).epsilon(1e-12));
            CHECK(std::fabs(moved.now().due) <= 0.1 * held * (1 + 1e-9));  // one of ten layers
            CHECK(moved.total_mass() == doctest::Approx(held).epsilon(1e-12));
            for (const sphere& s : moved.spheres()) CHECK((s.centre.z >= 0 && s.centre.z <= 0.2 * (1 + 1e-12)));
        }
    }
    const passage turn = b.advance(3 * held / 0.5);
    CHECK(turn.left.size() == 3 * 70);
    CHECK(std::count_if(turn.left.begin(), turn.left.end(), [](const auto& l) { return l.from == passage::fed; }) == 2 * 70);
    CHECK(b.velocity(0).z == doctest::Approx(-0.5 * 0.2 / held));
    plug_bed copy = lattice(0.1);
    copy.restore(b.state());
    CHECK(copy.state() == b.state());
    CHECK_THROWS_AS(plug_bed({{{0, 0, 3}, 0.01}}, {1.0}, {{0, 0, 0}, 0.2, 0.2}, surroundings{}, 1), hearth::bad_value);
    CHECK_THROWS_AS(plug_bed({{{0, 0, 0.1}, 0.01}}, {}, {{0, 0, 0}, 0.2, 0.2}, surroundings{}, 1), hearth::bad_value);
    CHECK_THROWS_AS(plug_bed({{{0, 0, 0.1}, -0.01}}, {1.0}, {{0, 0, 0}, 0.2, 0.2}, surroundings{}, 1), hearth::bad_value);
}
