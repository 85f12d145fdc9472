// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <hearth/mpi/communicator.hpp>

#include "solvers/dem/packed.hpp"

/// Beds that ranks share.  Every rank runs the bed alone as well, and compares what it owns of the shared one with that.
namespace hearth_test {

inline hearth::dem::decomposition shared_by_all(int axis = 2, double near_factor = 0) {
    return {hearth::dem::over(hearth::mpi::communicator()), axis, near_factor};
}

inline std::map<std::int64_t, std::int32_t> by_id(const bed& b) {
    std::map<std::int64_t, std::int32_t> found;
    for (std::int32_t i = 0; i < b.size(); ++i) found[b.ids()[i]] = i;
    return found;
}

inline bool same(const vector3& a, const vector3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// How many particles of this rank are not, to the last bit, those of a bed of one rank; all, if their numbers differ.
inline int differing(const bed& mine, const bed& alone) {
    if (mine.size_over_ranks() != alone.size() || mine.among().sum(std::int64_t{mine.size()}) != alone.size()) return alone.size() + 1;
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

/// A tube with a stirrer, fed on top and emptied below: everything that moves or has a state.
struct plant {
    static constexpr double d = 0.018;

    bed b;
    hearth::dem::feed source;
    hearth::dem::outflow sink;

    explicit plant(const hearth::dem::decomposition& spread,
                   hearth::dem::outflow::rule how = hearth::dem::outflow::rule::driven)
        : b(settings(), spread), source(feed_into({{0, 0, 5 * d}, 3 * d, 5 * d}, 3580, 0.8 * d, d, 3.0)), sink(leaving(how)) {
        using namespace hearth::dem;
        b.add_wall(wall_of(b.settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
        b.add_wall(wall_of(b.settings(), shape::cylinder({0, 0, -1}, {0, 0, 2}, 4 * d)));
        wall stirrer = wall_of(b.settings(), shape::box({-3 * d, -0.3 * d, 2 * d}, {3 * d, 0.3 * d, 3 * d}), 3);
        stirrer.motion.spin = {0, 0, 3};
        b.add_wall(stirrer);
        source.fill(b);
    }
    static bed_settings settings() {
        bed_settings s = soft_settings(0.5, 0.3);
        s.contact.rolling_friction = 0.02;
        return s;
    }
    static hearth::dem::outflow::settings leaving(hearth::dem::outflow::rule how) {
        hearth::dem::outflow::settings s;
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

}  // namespace hearth_test
