// SPDX-License-Identifier: MIT
// A settled bed of spheres of 16 to 19.5 mm in a cylinder of 0.85 m, Hertz with history, skin of a tenth of a diameter: time
// per particle and step of the motion, with lists rebuilt every ten steps, with conduction, and of radiation to 2.5 diameters;
// beside it LAMMPS and LIGGGHTS with the same bed, contact law, step and skin, where they are installed;
// rest_speed is what particles at rest still have, root mean square over sqrt(g d).  And the error of a bounce over the steps
// spent on it.  HEARTH_LARGE in the environment adds the bed of 1.8 million, for itself with --benchmark_filter=1800000: some
// twenty minutes, with its build, steps and time to settle, and the peak memory of the process (peak_bytes).
#include <hearth/dem/thermal_bed.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>

#include "dem/lammps.hpp"
#include "dem/settled_bed.hpp"
#include "support/counters.hpp"

namespace {

using namespace hearth::dem;

/// So many spheres: layers on top of one another, settled again where they meet.
bed& settled(int count) {
    static std::map<int, std::unique_ptr<bed>> beds;
    std::unique_ptr<bed>& b = beds[count];
    if (b) return *b;
    b = std::make_unique<bed>(count == 20000 ? bench::settled_layer() : bench::settled_layers(settled(20000), count / 20000));
    return *b;
}

const double fall_speed = std::sqrt(9.81 * 0.0178);  // [m/s]

void move(benchmark::State& state, int count, bool rebuild) {
    bed& b = settled(count);
    b.advance(10);
    for (auto _ : state) {
        if (rebuild) b.expire_lists();
        b.advance(10);
    }
    bench::set_items(state, 10.0 * b.size());
    state.counters["bytes_per_particle"] = static_cast<double>(b.memory()) / b.size();
    state.counters["rest_speed"] = bench::speed_of(b) / fall_speed;
}

/// Nine settled beds of 200 000 on top of one another: built, settled until they rest or for 4000 steps, stepped.  At rest:
/// slower than after a fall by a thousandth of a radius, root mean square, and floor and cylinder carry the weight within a
/// hundredth.
void move_large(benchmark::State& state) {
    bed b = [&] {
        bed& layer = settled(200000);
        const double began = bench::processor_seconds();
        bed stacked = bench::stacked_layers(layer, 9);
        stacked.advance(1);  // with its lists
        state.counters["build_seconds"] = bench::processor_seconds() - began;
        return stacked;
    }();
    const double began = bench::processor_seconds();
    const auto at_rest = [&] {
        return bench::speed_of(b) < std::sqrt(2e-3 * 9.81 * 0.0089) && bench::weight_not_carried(b) < 0.01;
    };
    // The weight of fifteen metres goes down as a wave, a second of motion or 40 000 steps long.  What is left of it after
    // fewer is told beside the time: rest_speed, weight_not_carried.
    constexpr int most_steps = 4000;
    while (!at_rest() && b.steps() < most_steps) b.advance(250);
    state.counters["settle_seconds"] = bench::processor_seconds() - began;
    state.counters["settle_steps"] = static_cast<double>(b.steps());
    for (auto _ : state) b.advance(10);
    bench::set_items(state, 10.0 * b.size());
    state.counters["particles"] = b.size();
    state.counters["bytes_per_particle"] = static_cast<double>(b.memory()) / b.size();
    state.counters["rest_speed"] = bench::speed_of(b) / fall_speed;
    state.counters["weight_not_carried"] = bench::weight_not_carried(b);
    state.counters["peak_bytes"] = bench::peak_bytes();
}

enum class rival_run { settled, rebuild, conduct };

void move_rival(benchmark::State& state, rivals::lammps::kind which, int count, rival_run how) {
    static std::map<std::pair<rivals::lammps::kind, int>, std::unique_ptr<rivals::lammps>> started;
    auto& rival = started[{which, count}];
    if (!rival) {
        rival = std::make_unique<rivals::lammps>(which);
        rival->take(settled(count), 0.425, 3580);
        rival->advance(200);  // springs of contacts build up anew
    }
    rival->rebuild_every(how == rival_run::rebuild ? 10 : 0);
    static std::set<int> conducting;
    if (how == rival_run::conduct && conducting.insert(count).second) rival->conduct();
    rival->advance(10);
    for (auto _ : state) rival->advance(10);
    bench::set_items(state, 10.0 * settled(count).size());
    state.counters["rest_speed"] = rival->speed() / fall_speed;
}

void conduct(benchmark::State& state, int count) {
    bed& b = settled(count);
    thermal_bed warm(b, {800, 4, 1});
    const hearth::scene conducts{hearth::conduction{hearth::closure::zhang::constriction{}}};
    auto links = conducts.links(warm, warm);
    std::vector<double> heat(static_cast<std::size_t>(b.size()));
    for (auto _ : state) {
        b.advance(1);
        conducts.links(warm, warm, hearth::no_gas{}, links);
        std::fill(heat.begin(), heat.end(), 0.0);
        hearth::accumulate(links, b.temperatures(), [&](int patch) { return b.patch_temperature(patch); }, heat);
    }
    bench::set_items(state, b.size());
}

enum class part { rates, links, list };

void radiate(benchmark::State& state, int count, part what) {
    bed& b = settled(count);
    thermal_bed warm(b, {800, 4, 1});
    const hearth::scene shines{hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}}};
    auto links = shines.links(warm, warm);
    std::vector<double> heat(static_cast<std::size_t>(b.size()));
    const std::vector<char> saved = what == part::list ? b.state() : std::vector<char>();
    for (auto _ : state) {
        if (what == part::rates) {
            std::fill(heat.begin(), heat.end(), 0.0);
            hearth::accumulate(links, b.temperatures(), [&](int patch) { return b.patch_temperature(patch); }, heat);
        } else if (what == part::links) {
            shines.links(warm, warm, hearth::no_gas{}, links);
        } else {
            state.PauseTiming();
            b.restore(saved);  // which knows of no list
            state.ResumeTiming();
            benchmark::DoNotOptimize(b.near_pairs(2.5).second.data());
        }
    }
    bench::set_items(state, b.size());
    state.counters["neighbours"] = 2.0 * static_cast<double>(links.pairs.size()) / b.size();
}

/// Error of the coefficient of restitution.
void bounce(benchmark::State& state, int steps_per_contact) {
    double error = 0;
    for (auto _ : state) {
        bed_settings s;
        s.gravity = {};
        s.contact.damping = 0.12;
        bed b(s);
        particle p;
        p.radius = 0.01;
        p.density = 3580;
        p.position = {-0.01, 0, 0};
        p.velocity = {0.5, 0, 0};
        particle q = p;
        q.position.x = 0.01 + 1e-9;
        q.velocity.x = -0.5;
        b.insert({p, q});
        bed_settings fine = s;
        fine.step = b.advised_step(1.0, steps_per_contact);
        bed c(fine);
        c.insert({p, q});
        c.advance(2 * steps_per_contact);
        error = std::fabs(std::fabs(c.motions()[0].velocity.x) / 0.5 - restitution_of_damping(0.12));
    }
    bench::set_error(state, error);
}

const bool registered = [] {
    using benchmark::RegisterBenchmark;
    for (const int count : {20000, 200000}) {
        const std::string size = "/particles:" + std::to_string(count);
        RegisterBenchmark(("motion of a settled bed/settled" + size).c_str(), move, count, false)->Unit(benchmark::kMillisecond);
        RegisterBenchmark(("motion of a settled bed/lists every 10 steps" + size).c_str(), move, count, true)->Unit(benchmark::kMillisecond);
        for (const auto which : {rivals::lammps::kind::lammps, rivals::lammps::kind::liggghts}) {
            if (!rivals::lammps::installed(which)) continue;
            const std::string rival = std::string("motion of a settled bed/") + rivals::lammps::name(which);
            RegisterBenchmark((rival + size).c_str(), move_rival, which, count, rival_run::settled)->Unit(benchmark::kMillisecond);
            RegisterBenchmark((rival + ", lists every 10 steps" + size).c_str(), move_rival, which, count, rival_run::rebuild)->Unit(benchmark::kMillisecond);
            if (which == rivals::lammps::kind::liggghts)  // the last: it cannot be switched off
                RegisterBenchmark((rival + ", with conduction" + size).c_str(), move_rival, which, count, rival_run::conduct)->Unit(benchmark::kMillisecond);
        }
        RegisterBenchmark(("motion of a settled bed/with conduction" + size).c_str(), conduct, count)->Unit(benchmark::kMillisecond);
        RegisterBenchmark(("radiation of a settled bed/rates" + size).c_str(), radiate, count, part::rates)->Unit(benchmark::kMillisecond);
        RegisterBenchmark(("radiation of a settled bed/links" + size).c_str(), radiate, count, part::links)->Unit(benchmark::kMillisecond);
        RegisterBenchmark(("radiation of a settled bed/list" + size).c_str(), radiate, count, part::list)->Unit(benchmark::kMillisecond);
    }
    if (std::getenv("HEARTH_LARGE") != nullptr) {
        RegisterBenchmark("motion of a settled bed/settled/particles:1800000", move_large)->Iterations(10)->Unit(benchmark::kMillisecond);
    }
    for (const int steps : {10, 20, 50, 100, 1000, 10000}) {
        RegisterBenchmark(("bounce/ours/steps:" + std::to_string(steps)).c_str(), bounce, steps)->Unit(benchmark::kMicrosecond);
    }
    return true;
}();

}  // namespace
