// SPDX-License-Identifier: MIT
// Beds on several ranks that a rule moves: recorded from a bed on these ranks, as a plug, or not at all.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <doctest/doctest.h>

#include <hearth/core/error.hpp>
#include <hearth/dem/recording.hpp>

#include "solvers/dem/shared.hpp"

using namespace hearth::dem;
using hearth_test::feed_into;
using hearth_test::same;
using hearth_test::shared_by_all;
using hearth_test::soft_settings;
using hearth_test::wall_of;

namespace {

constexpr double d = 0.018, radius = 3.5 * d, level = 7 * d, flow = 0.8;
const zone shaft{{0, 0, 0}, radius, level};

/// A small tube that is fed as much as it discharges.
struct fed_tube {
    bed b;
    feed source = feed_into({{0, 0, level + 2 * d}, radius, 6 * d}, 3580, 0.016, 0.0195);
    outflow sink = outflow({0, 0, flow});

    explicit fed_tube(const decomposition& spread) : b(soft_settings(0.5, 0.3), spread) {
        b.add_wall(wall_of(b.settings(), shape::plane({0, 0, 0}, {0, 0, 1}), 0));
        b.add_wall(wall_of(b.settings(), shape::cylinder({0, 0, -1}, {0, 0, 2}, radius), 1));
    }
    void fill() {
        fill_to_level(b, source, shaft, level, 50000);
        hearth_test::settle(b, 10000);
        source.set_mass_flow(flow);
        run(4000, [] {});
    }
    /// Goes on as another one, which is on one rank.
    void take_over(const fed_tube& other) {
        b.restore_parts(b.among().rank() == 0 ? std::vector<std::vector<char>>{other.b.state()}
                                              : std::vector<std::vector<char>>{});
        source.restore(other.source.now());
        source.set_mass_flow(flow);
        sink.restore(other.sink.now());
    }
    template <class See>
    void run(int steps, See&& see) {
        for (int k = 0; k < steps; k += 50) {
            b.advance(50);
            source.update(b, 50 * b.settings().step);
            sink.update(b, 50 * b.settings().step);
            see();
        }
    }
};

/// The tube on one rank and on all, each recorded over the same steps.
struct recorded_twice {
    fed_tube alone{decomposition{}}, mine{shared_by_all()};
    std::shared_ptr<const recording> record, record_of_all;
    int differing_observations = 0;
    bool same_state = false;
    double left = 0, left_of_all = 0;

    recorded_twice() {
        alone.fill();
        mine.take_over(alone);
        recorder watch({shaft, 3, 4}), watch_of_all({shaft, 3, 4});
        std::vector<bool> kept, kept_of_all;
        alone.run(2000, [&] { kept.push_back(watch.observe(alone.b)); });
        mine.run(2000, [&] { kept_of_all.push_back(watch_of_all.observe(mine.b)); });
        for (std::size_t k = 0; k < kept.size(); ++k) differing_observations += kept[k] != kept_of_all[k];
        same_state = watch.state() == watch_of_all.state();
        left = watch.mass_left();
        left_of_all = watch_of_all.mass_left();
        record = std::make_shared<const recording>(watch.finish());
        record_of_all = std::make_shared<const recording>(watch_of_all.finish());
    }
};

const recorded_twice& tubes() {
    static const recorded_twice made;
    return made;
}

/// How many of this rank's particles are not those of the bed of one rank, or sit somewhere else.
int differing(const moving_bed& mine, const moving_bed& alone) {
    std::map<std::int64_t, std::size_t> there;
    for (std::size_t i = 0; i < alone.ids().size(); ++i) there[alone.ids()[i]] = i;
    int count = 0;
    for (std::size_t i = 0; i < mine.ids().size(); ++i) {  // ghosts, too
        const auto found = there.find(mine.ids()[i]);
        count += found == there.end() || !same(mine.spheres()[i].centre, alone.spheres()[found->second].centre) ||
                 mine.spheres()[i].radius != alone.spheres()[found->second].radius ||
                 mine.masses()[i] != alone.masses()[found->second];
    }
    return count;
}

/// Neighbours, contacts and walls of each particle.
std::map<std::int64_t, std::vector<int>> company(const moving_bed& b) {
    std::map<std::int64_t, std::vector<int>> found;
    for (std::int32_t i = 0; i < b.size(); ++i) found[b.ids()[static_cast<std::size_t>(i)]] = {0, 0, 0, 0};
    const auto count = [&](std::int32_t i, std::size_t what) {
        if (i < b.size()) ++found.at(b.ids()[static_cast<std::size_t>(i)])[what];
    };
    b.for_each_near(2.5, [&](std::int32_t i, std::int32_t j, double) { count(i, 0), count(j, 0); });
    b.for_each_contact(
        [&](std::int32_t i, std::int32_t j, double, double, const vector3&) { count(i, 1), count(j, 1); });
    for (const bed::touch& t : b.wall_touches()) count(t.i, 2);
    b.for_each_near_wall(1.0, [&](std::int32_t i, int, double) { count(i, 3); });
    return found;
}

/// One explicit step of conduction through contacts; temperatures of this rank's particles.
void conduct(const moving_bed& b, std::vector<double>& temperature, double seconds) {
    const hearth::particle_halo<hearth::mpi::communicator> halo(
        hearth::mpi::communicator(), {b.ids().begin(), b.ids().begin() + b.size()}, ghosts_of(b));
    temperature.resize(b.ids().size());
    halo.gather(temperature);
    std::vector<double> heat(temperature.size(), 0.0);
    b.for_each_contact([&](std::int32_t i, std::int32_t j, double force, double, const vector3&) {
        const auto at = static_cast<std::size_t>(i), other = static_cast<std::size_t>(j);
        const double q = 0.1 * std::cbrt(force) * (temperature[other] - temperature[at]);
        heat[at] += q;
        heat[other] -= q;
    });
    temperature.resize(static_cast<std::size_t>(b.size()));
    for (std::size_t i = 0; i < temperature.size(); ++i) temperature[i] += seconds * heat[i] / (800 * b.masses()[i]);
}

double sum_over_ranks(const moving_bed& b, double mine) {
    double sum = 0;
    for (const double part : b.among().gather(std::vector<double>{mine})) sum += part;
    return sum;
}

double content(const moving_bed& b, const std::vector<double>& temperature) {
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.size()); ++i) sum += b.masses()[i] * temperature[i];
    return sum;
}

/// Moves both beds on, with what their particles carry, and compares them after each move.
void travel_together(moving_bed& mine, moving_bed& alone, const std::vector<double>& moves) {
    const auto marks_of = [](const moving_bed& b) {
        return std::vector<std::int64_t>(b.ids().begin(), b.ids().begin() + b.size());
    };
    std::vector<std::int64_t> marks = marks_of(mine);
    std::vector<double> warmth, warmth_alone;
    for (const auto id : mine.ids()) warmth.push_back(300 + static_cast<double>(id % 97));
    for (const auto id : alone.ids()) warmth_alone.push_back(300 + static_cast<double>(id % 97));
    warmth.resize(static_cast<std::size_t>(mine.size()));
    std::int64_t crossed = 0, left = 0;
    for (const double seconds : moves) {
        const passage p = mine.advance(seconds), q = alone.advance(seconds);
        CHECK(differing(mine, alone) == 0);
        CHECK(mine.among().sum(std::int64_t{mine.size()}) == alone.size());
        CHECK(mine.size() <= alone.size() / mine.among().size() + 1);
        CHECK(p.mass_in == q.mass_in);
        CHECK(p.mass_out == q.mass_out);
        CHECK(mine.now().due == alone.now().due);
        CHECK(mine.now().out == alone.now().out);
        CHECK(mine.now().next_id == alone.now().next_id);
        CHECK(mine.state() == alone.state());
        CHECK(company(mine) == [&] {
            auto all = company(alone);
            decltype(all) owned;
            for (const auto id : marks_of(mine)) owned[id] = all.at(id);
            return owned;
        }());

        // Who left, each on one rank, and with what it carried.
        std::vector<std::int64_t> gone, gone_alone;
        double out = 0, out_alone = 0;
        for (const auto& l : p.left) {
            gone.push_back(l.id);
            if (l.from == passage::fed) continue;
            CHECK(marks[static_cast<std::size_t>(l.from)] == l.id);
            out += l.mass * warmth[static_cast<std::size_t>(l.from)];
        }
        for (const auto& l : q.left) {
            gone_alone.push_back(l.id);
            if (l.from != passage::fed) out_alone += l.mass * warmth_alone[static_cast<std::size_t>(l.from)];
        }
        gone = mine.among().gather(gone);
        std::sort(gone.begin(), gone.end());
        std::sort(gone_alone.begin(), gone_alone.end());
        CHECK(gone == gone_alone);
        left += static_cast<std::int64_t>(gone.size());
        CHECK(std::fabs(sum_over_ranks(mine, out) - out_alone) <= 1e-12 * out_alone);

        for (const std::int32_t o : p.origin) crossed += o == passage::from_another_rank ? 1 : 0;
        p.carry(marks, std::int64_t{-1});
        int wrong = 0;
        for (std::size_t i = 0; i < marks.size(); ++i)
            wrong += marks[i] != mine.ids()[i] && p.origin[i] != passage::fed;
        CHECK(wrong == 0);
        marks = marks_of(mine);
        p.carry(warmth, 1500.0);
        q.carry(warmth_alone, 1500.0);
        std::map<std::int64_t, double> there;
        const double before = sum_over_ranks(mine, content(mine, warmth));
        conduct(mine, warmth, 0.02);
        CHECK(std::fabs(sum_over_ranks(mine, content(mine, warmth)) / before - 1) < 1e-12);
        {  // the same on one rank, without a halo
            std::vector<double> heat(warmth_alone.size(), 0.0);
            alone.for_each_contact([&](std::int32_t i, std::int32_t j, double force, double, const vector3&) {
                const auto at = static_cast<std::size_t>(i), other = static_cast<std::size_t>(j);
                const double flux = 0.1 * std::cbrt(force) * (warmth_alone[other] - warmth_alone[at]);
                heat[at] += flux;
                heat[other] -= flux;
            });
            for (std::size_t i = 0; i < heat.size(); ++i) warmth_alone[i] += 0.02 * heat[i] / (800 * alone.masses()[i]);
        }
        for (std::size_t i = 0; i < warmth_alone.size(); ++i) there[alone.ids()[i]] = warmth_alone[i];
        double apart = 0;
        for (std::size_t i = 0; i < warmth.size(); ++i)
            apart = std::fmax(apart, std::fabs(warmth[i] / there.at(marks[i]) - 1));
        // Sums of some eight contacts in another order, at each of the moves.
        CHECK(apart < static_cast<double>(moves.size()) * 8 * 2.3e-16);
    }
    CHECK(left > 0);
    if (mine.among().size() > 1) CHECK(mine.among().sum(crossed) > 0);
}

const std::vector<double> some_moves{0.013, 0.029, 0.05, 0.0, 0.11, 0.7, 0.013, 40.0, 0.05, 0.3, 0.3, 0.3};

}  // namespace

TEST_CASE("ranks: a bed is recorded to the bits of one rank") {
    CHECK(hearth_test::differing(tubes().mine.b, tubes().alone.b) == 0);
    CHECK(tubes().differing_observations == 0);
    CHECK(tubes().same_state);
    CHECK(tubes().left > 0.05);
    CHECK(tubes().left_of_all == tubes().left);
    CHECK(tubes().record->frames().size() > 5);
    CHECK(tubes().record_of_all->bytes() == tubes().record->bytes());
}

TEST_CASE("ranks: recorded motion has the bits of one rank; all that particles carry goes along, each to one rank") {
    const surroundings around = surroundings::of(tubes().mine.b);
    for (const int axis : {2, 0}) {
        recorded_bed mine(tubes().record, around, flow, shared_by_all(axis, 2.5)), alone(tubes().record, around, flow);
        travel_together(mine, alone, some_moves);
        recorded_bed again(tubes().record, around, 9.0);  // from these ranks to one, and back
        again.restore(mine.state());
        mine.restore(again.state());
        travel_together(mine, alone, {0.05, 0.2});
    }
}

TEST_CASE("ranks: a plug and a frozen bed have the bits of one rank") {
    const bed& packed = tubes().alone.b;
    std::vector<sphere> spheres;
    std::vector<double> masses;
    for (std::int32_t i = 0; i < packed.size(); ++i) {
        if (packed.spheres()[i].centre.z < 0 || packed.spheres()[i].centre.z > level) continue;
        spheres.push_back(packed.spheres()[i]);
        masses.push_back(packed.mass(i));
    }
    const surroundings around = surroundings::of(packed);
    plug_bed mine(spheres, masses, shaft, around, flow, shared_by_all(2, 2.5)),
        alone(spheres, masses, shaft, around, flow);
    travel_together(mine, alone, some_moves);

    const frozen_bed here(tubes().mine.b, shared_by_all(1, 2.5)), there(packed);
    CHECK(differing(here, there) == 0);
    CHECK(here.among().sum(std::int64_t{here.size()}) == there.size());
    auto all = company(there);
    for (const auto& [id, found] : company(here)) CHECK(found == all.at(id));
}

TEST_CASE("ranks: what differs from rank to rank is refused on all, and changes nothing") {
    const surroundings around = surroundings::of(tubes().alone.b);
    recorded_bed mine(tubes().record, around, flow, shared_by_all(2, 1.5));
    const auto before = mine.state();
    const int rank = mine.among().rank();
    CHECK_THROWS_AS(mine.advance(rank == 0 ? std::nan("") : 1.0), hearth::bad_value);
    if (mine.is_shared()) {
        CHECK_THROWS_AS(mine.advance(0.5 + rank), hearth::bad_value);
        CHECK_THROWS_AS(mine.for_each_near(2.5, [](std::int32_t, std::int32_t, double) {}), hearth::bad_value);
        CHECK_THROWS_AS(frozen_bed({{{0, 0, 0}, 0.01 + 0.001 * rank}}, {1.0}, around, shared_by_all()),
                        hearth::bad_value);
        std::vector<std::string> names(static_cast<std::size_t>(mine.size()));
        CHECK_THROWS_AS(mine.advance(0.0).carry(names, std::string()), std::invalid_argument);
    }
    decomposition slanted = shared_by_all();
    slanted.axis = 3;
    CHECK_THROWS_AS(recorded_bed(tubes().record, around, flow, slanted), hearth::bad_value);
    CHECK(mine.state() == before);
    const frozen_bed nobody({}, {}, around, shared_by_all());
    CHECK(nobody.size() == 0);
}
