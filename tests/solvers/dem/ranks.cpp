// SPDX-License-Identifier: MIT
// Every rank runs the bed alone as well, and compares what it owns of the shared bed with that.
#include <hearth/dem/ranks.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include <hearth/core/error.hpp>
#include <hearth/mpi/communicator.hpp>

#include "solvers/dem/balls.hpp"
#include "solvers/dem/packed.hpp"
#include "support/random.hpp"

using namespace hearth::dem;
using hearth_test::feed_into;
using hearth_test::soft_settings;
using hearth_test::wall_of;

namespace {

constexpr double d = 0.018;

decomposition shared_by_all(int axis = 2) {
    decomposition spread;
    spread.among = over(hearth::mpi::communicator());
    spread.axis = axis;
    return spread;
}

bed_settings rough() {
    bed_settings s = soft_settings(0.5, 0.3);
    s.contact.rolling_friction = 0.02;
    return s;
}

/// A tube with a stirrer, fed on top and emptied below: everything that moves or has a state.
struct plant {
    bed b;
    feed source;
    outflow sink;

    explicit plant(const decomposition& spread, outflow::rule how = outflow::rule::driven)
        : b(rough(), spread), source(feed_into({{0, 0, 5 * d}, 3 * d, 5 * d}, 3580, 0.8 * d, d, 3.0)), sink(leaving(how)) {
        b.add_wall(wall_of(b.settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
        b.add_wall(wall_of(b.settings(), shape::cylinder({0, 0, -1}, {0, 0, 2}, 4 * d)));
        wall stirrer = wall_of(b.settings(), shape::box({-3 * d, -0.3 * d, 2 * d}, {3 * d, 0.3 * d, 3 * d}), 3);
        stirrer.motion.spin = {0, 0, 3};
        b.add_wall(stirrer);
        source.fill(b);
    }
    static outflow::settings leaving(outflow::rule how) {
        outflow::settings s;
        s.mass_flow = 4.0;
        s.how = how;
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

std::map<std::int64_t, std::int32_t> by_id(const bed& b) {
    std::map<std::int64_t, std::int32_t> found;
    for (std::int32_t i = 0; i < b.size(); ++i) found[b.ids()[i]] = i;
    return found;
}

bool same(const vector3& a, const vector3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// How many particles of this rank are not, to the last bit, those of the bed of one rank.
int differing(const bed& mine, const bed& alone) {
    const auto there = by_id(alone);
    int count = 0;
    for (std::int32_t i = 0; i < mine.size(); ++i) {
        const auto found = there.find(mine.ids()[i]);
        if (found == there.end()) {
            ++count;
            continue;
        }
        const std::int32_t j = found->second;
        count += !same(mine.spheres()[i].centre, alone.spheres()[j].centre) ||
                 !same(mine.motions()[i].velocity, alone.motions()[j].velocity) ||
                 !same(mine.motions()[i].spin, alone.motions()[j].spin) ||
                 !same(mine.loads()[i].force, alone.loads()[j].force) ||
                 !same(mine.loads()[i].torque, alone.loads()[j].torque) || mine.in_flight(i) != alone.in_flight(j) ||
                 mine.temperatures()[i] != alone.temperatures()[j];
    }
    return count;
}

}  // namespace

TEST_CASE("ranks: fed, stirred and emptied, a bed has the bits of one rank; balanced as it moves") {
    for (const auto& [axis, how] : {std::pair{2, outflow::rule::driven}, std::pair{0, outflow::rule::paper}}) {
        CAPTURE(axis);
        plant mine(shared_by_all(axis), how), alone(decomposition{}, how);
        for (int part = 0; part < 3; ++part) {
            mine.run(600);
            alone.run(600);
            CAPTURE(part);
            CHECK(mine.b.size_over_ranks() == alone.b.size());
            CHECK(mine.b.among().sum(static_cast<std::int64_t>(mine.b.size())) == alone.b.size());
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
    }
}
