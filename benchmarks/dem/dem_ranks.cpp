// SPDX-License-Identifier: MIT
// The settled bed on several ranks against the same bed on one of them, in turns within one run, in blocks of few steps:
// a machine that does other things meanwhile spoils most of them, not all, and the best count.
//     speedup   wall time of one rank over that of all
//     bound     the same of processor time outside of messages, the busiest rank's: what a free network would give
//     ghosts    copies of other ranks' particles over owned ones
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <hearth/mpi/communicator.hpp>

#include "dem/settled_bed.hpp"
#include "support/counters.hpp"
#include "support/ranks.hpp"

namespace {

using namespace hearth::dem;
using clock = std::chrono::steady_clock;

double seconds_since(clock::time_point begin) { return std::chrono::duration<double>(clock::now() - begin).count(); }
/// Ranks that count the processor time they spend in messages.
class timed_ranks final : public ranks {
  public:
    int rank() const override { return to_->rank(); }
    int size() const override { return to_->size(); }
    double max(double mine) const override {
        return timed([&] { return to_->max(mine); });
    }
    std::int64_t max(std::int64_t mine) const override { return to_->max(mine); }
    void sum(std::int64_t* values, std::size_t count) const override { to_->sum(values, count); }
    std::vector<hearth::parcel<char>> exchange(std::vector<hearth::parcel<char>> outgoing) const override {
        return to_->exchange(std::move(outgoing));
    }
    void begin(const char* outgoing, const std::vector<hearth::link>& exports, char* incoming,
               const std::vector<hearth::link>& imports) override {
        timed([&] { to_->begin(outgoing, exports, incoming, imports); return 0; });
    }
    void end() override {
        timed([&] { to_->end(); return 0; });
    }
    mutable double in_messages = 0;  ///< processor time [s]

  private:
    template <class Call>
    auto timed(Call&& call) const -> decltype(call()) {
        const double begin = bench::processor_seconds();
        const auto result = call();
        in_messages += bench::processor_seconds() - begin;
        return result;
    }
    std::shared_ptr<ranks> to_ = over(hearth::mpi::communicator());
};

/// The bed on rank 0, and the same on all.
struct fixture {
    std::shared_ptr<timed_ranks> among = std::make_shared<timed_ranks>();
    bed single = bench::empty_cylinder(), together;

    fixture(int layers, int axis) : together(bench::empty_cylinder({among, axis, 0})) {
        std::vector<std::vector<char>> parts;
        bench::alone(among->rank(), [&] {
            single = bench::settled_layer();
            if (layers > 1) single = bench::settled_layers(single, layers);
            parts.push_back(single.state());
        });
        together.restore_parts(parts);
    }
};

void settled(benchmark::State& state, int layers, int axis) {
    constexpr int steps = 2;
    constexpr double never = 1e300;
    fixture f(layers, axis);
    double together = never, work = never, single = never, single_work = never;
    for (auto _ : state) {
        f.among->max(0.0);  // all are awake
        f.among->in_messages = 0;
        const auto begin = clock::now();
        const double processor_begin = bench::processor_seconds();
        f.together.advance(steps);
        const double mine = bench::processor_seconds() - processor_begin - f.among->in_messages;
        const double seconds = f.among->max(seconds_since(begin));
        together = std::min(together, seconds);
        work = std::min(work, f.among->max(mine));
        bench::alone(f.among->rank(), [&] {
            const auto begin_alone = clock::now();
            const double processor_alone = bench::processor_seconds();
            f.single.advance(steps);
            single_work = std::min(single_work, bench::processor_seconds() - processor_alone);
            single = std::min(single, seconds_since(begin_alone));
        });
        state.SetIterationTime(seconds);
    }
    const double items = static_cast<double>(f.together.size_over_ranks()) * steps;
    state.counters["speedup"] = single / together;
    state.counters["bound"] = single_work / work;
    state.counters["best_per_item"] = together / items;
    state.counters["ghosts"] = static_cast<double>(f.together.ghost_count()) / f.together.size();
    bench::set_items(state, items);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    {
        const hearth::mpi::communicator ranks;
        const std::string suffix = "/ranks:" + std::to_string(ranks.size());
        const auto add = [&](const std::string& name, int layers, int axis, int iterations) {
            benchmark::RegisterBenchmark(("motion on ranks/" + name + suffix).c_str(), settled, layers, axis)
                ->UseManualTime()->Iterations(iterations)->Unit(benchmark::kMillisecond);
        };
        add("across the axis/particles:20000", 1, 2, 500);
        add("along the axis/particles:20000", 1, 0, 500);
        add("across the axis/particles:200000", 10, 2, 100);
        bench::run_on_ranks(ranks.rank(), argc, argv);
    }
    MPI_Finalize();
}
