// SPDX-License-Identifier: MIT
// A bed under free gas on several ranks against the same on one of them, in turns within one run, a few outer
// iterations at a time: a machine that does other things meanwhile spoils most of them, not all, and the best count.
//     speedup   wall time of one rank over that of all
//     bound     the same of processor time outside of messages, the busiest rank's; those of hypre are not told apart
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include <hearth/gas/mpi_ranks.hpp>
#include <hearth/gas/partition.hpp>

#include "gas/bed_case.hpp"
#include "support/counters.hpp"
#include "support/ranks.hpp"

namespace {

using namespace hearth::gas;
using hearth::mpi::communicator;
using clock = std::chrono::steady_clock;

/// The ranks of the program, which count the processor time that they spend in messages.
class timed_ranks final : public parallel {
  public:
    explicit timed_ranks(const mesh& share) : to_(share, communicator()) {}
    int ranks() const override { return to_.ranks(); }
    int rank() const override { return to_.rank(); }
    void gather(double* field, int width) const override {
        timed([&] { to_.gather(field, width); });
    }
    using parallel::sum;
    void sum(double* values, int count) const override {
        timed([&] { to_.sum(values, count); });
    }
    double max(double value) const override {
        timed([&] { value = to_.max(value); });
        return value;
    }
    std::unique_ptr<preconditioner> make_preconditioner(const pattern& p) const override {
        return to_.make_preconditioner(p);
    }

    mutable double in_messages = 0;  ///< [s]

  private:
    template <class Call>
    void timed(Call&& call) const {
        const double begin = bench::processor_seconds();
        call();
        in_messages += bench::processor_seconds() - begin;
    }
    mpi_ranks to_;
};

void outer_iteration(benchmark::State& state, int n) {
    const communicator world;
    const bench::bed_case c;
    const mesh whole(c.shape(n)), share(whole, partition(whole, world.size()), world.rank());
    const timed_ranks ranks(share);
    const auto together = c.make(share, {}, ranks);
    std::unique_ptr<solver> single;
    if (world.rank() == 0) single = c.make(whole);
    constexpr double never = 1e300;
    double all = never, work = never, one = never, one_work = never;
    int round = 0;
    for (auto _ : state) {
        ranks.max(0.0);  // all are awake
        ranks.in_messages = 0;
        const auto begin = clock::now();
        const double processor_begin = bench::processor_seconds();
        together->iterate();
        const double mine = ranks.max(bench::processor_seconds() - processor_begin - ranks.in_messages);
        const double seconds = ranks.max(std::chrono::duration<double>(clock::now() - begin).count());
        const bool started = ++round > 5;  // the first ones build the levels of the multigrid
        if (started) all = std::min(all, seconds);
        if (started) work = std::min(work, mine);
        bench::alone(world.rank(), [&] {
            const auto begin_alone = clock::now();
            const double processor_alone = bench::processor_seconds();
            single->iterate();
            if (started) one_work = std::min(one_work, bench::processor_seconds() - processor_alone);
            if (started) one = std::min(one, std::chrono::duration<double>(clock::now() - begin_alone).count());
        });
        state.SetIterationTime(seconds);
    }
    state.counters["speedup"] = one / all;
    state.counters["bound"] = one_work / work;
    state.counters["best_per_item"] = all / whole.cells();
    bench::set_items(state, whole.cells());
    // of the pressure drop of all ranks from that of one
    const double drop = together->mean_pressure("z_min") - c.pressure;
    double expected = world.rank() == 0 ? single->mean_pressure("z_min") - c.pressure : 0;
    bench::set_error(state, std::abs(drop / ranks.parallel::sum(expected) - 1));
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    {
        const communicator world;
        for (const int n : {32, 46})
            benchmark::RegisterBenchmark(("outer iteration of the gas on ranks/" + std::to_string(n * n * n) +
                                          " cells/ranks:" + std::to_string(world.size()))
                                             .c_str(),
                                         outer_iteration, n)
                ->UseManualTime()
                ->Iterations(25)
                ->Unit(benchmark::kMillisecond);
        bench::run_on_ranks(world.rank(), argc, argv);
    }
    MPI_Finalize();
}
