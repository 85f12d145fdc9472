// SPDX-License-Identifier: MIT
// What several ranks cost: the exchange of ghosts, and smoothers whose work per rank stays the same (weak scaling).
// error: of the exchange, the largest difference between a ghost and its owner; of the smoothers, the relative change
// of the volume that they keep.  Both are exact up to round-off on any number of ranks.
#include <benchmark/benchmark.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <hearth/core/cell_graph.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/mpi/communicator.hpp>
#include <hearth/voidage/kernel_smoother.hpp>
#include <hearth/voidage/vfs.hpp>

#include "support/counters.hpp"
#include "support/ranks.hpp"

namespace {

/// A lattice cut into slabs along z, one of the same size per rank.
struct slab {
    hearth::lattice part;
    int rank = 0;
    int ranks = 1;
};

}  // namespace

template <>
struct hearth::mesh_traits<slab> {
    using local = mesh_traits<lattice>;
    using index = std::int32_t;
    using scalar = double;
    static index cell_count(const slab& m) { return local::cell_count(m.part); }
    static scalar volume(const slab& m, index c) { return local::volume(m.part, c); }
    static std::int64_t global_index(const slab& m, index c) { return m.part.count() * m.rank + c; }
    template <class Visit>
    static void for_each_face(const slab& m, Visit&& visit) { local::for_each_face(m.part, visit); }
    template <class Visit>
    static void for_each_remote_face(const slab& m, Visit&& visit) {
        const auto count = static_cast<index>(m.part.count());
        const index layer = m.part.cells[0] * m.part.cells[1];
        for (index c = 0; c < layer; ++c) {
            if (m.rank > 0) visit(c, m.rank - 1, global_index(m, c) - layer, 1.0, 1.0);
            if (m.rank + 1 < m.ranks) visit(count - layer + c, m.rank + 1, global_index(m, count - layer + c) + layer, 1.0, 1.0);
        }
    }
};

namespace {

constexpr int width = 100;  // cells along each edge of a slab: a million a rank

struct fixture {
    hearth::mpi::communicator ranks;
    slab mesh{{{{width, width, width}, {1, 1, 1}, {false, false, false}, {0, 0, 0}}}, ranks.rank(), ranks.size()};
    hearth::cell_graph<hearth::mpi::communicator> graph{mesh, ranks};

    /// A bed that the smoother has work with: a fifth of the cells hold three times their volume.
    std::vector<double> field() const {
        std::mt19937_64 random(static_cast<std::uint64_t>(ranks.rank()));
        std::vector<double> values(static_cast<std::size_t>(graph.total_count()));
        for (double& value : values) value = random() % 5 == 0 ? 3.0 : 0.0;
        return values;
    }

    /// Summed without rounding: a plain sum of a million 0.9 is off by 1e-11.
    double sum(const std::vector<double>& values) const {
        hearth::reproducible_sum total(3.0, std::int64_t{width} * width * width * ranks.size());
        for (std::int32_t c = 0; c < graph.cell_count(); ++c) total.add(values[static_cast<std::size_t>(c)]);
        ranks.sum(total.limbs(), total.limb_count());
        return total.value();
    }
};

/// Times `work` on all ranks; the slowest counts.
template <class Prepare, class Work>
void time_ranks(benchmark::State& state, Prepare&& prepare, Work&& work) {
    for (auto _ : state) {
        prepare();
        MPI_Barrier(MPI_COMM_WORLD);
        double seconds = -MPI_Wtime();
        work();
        seconds += MPI_Wtime();
        MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        state.SetIterationTime(seconds);
    }
}

void gather(benchmark::State& state, const fixture& f) {
    std::vector<double> ids(static_cast<std::size_t>(f.graph.total_count()));
    for (std::int32_t c = 0; c < f.graph.cell_count(); ++c) {
        ids[static_cast<std::size_t>(c)] = static_cast<double>(f.graph.global_index(c));
    }
    time_ranks(state, [] {}, [&] { f.graph.halo().gather(ids.data()); });
    double error = 0;
    for (std::int32_t c = f.graph.cell_count(); c < f.graph.total_count(); ++c) {
        error = std::max(error, std::abs(ids[static_cast<std::size_t>(c)] - static_cast<double>(f.graph.global_index(c))));
    }
    bench::set_error(state, f.ranks.max(error));
    bench::set_items(state, std::max(1, f.graph.total_count() - f.graph.cell_count()));
}

template <class Smooth>
void weak_scaling(benchmark::State& state, const fixture& f, Smooth&& smooth) {
    const std::vector<double> start = f.field();
    std::vector<double> values;
    time_ranks(state, [&] { values = start; }, [&] { smooth(values); });
    const double before = f.sum(start);
    bench::set_error(state, std::abs(f.sum(values) - before) / before);
    bench::set_items(state, f.graph.cell_count());
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    {
        const fixture f;
        hearth::kernel_smoother kernel(f.graph, 1.0);
        hearth::volume_fraction_smoother vfs(f.graph, hearth::vfs_settings{0.9});
        const std::string ranks = "/ranks:" + std::to_string(f.ranks.size());
        const auto add = [&](const std::string& name, int iterations, auto&& body) {
            benchmark::RegisterBenchmark((name + ranks).c_str(), body)->UseManualTime()->Iterations(iterations)->Unit(benchmark::kMillisecond);
        };
        add("halo/gather", 200, [&](benchmark::State& state) { gather(state, f); });
        add("weak scaling/kernel smoother", 10, [&](benchmark::State& state) {
            weak_scaling(state, f, [&](auto& values) { kernel.smooth(values); });
        });
        add("weak scaling/VFS completed", 10, [&](benchmark::State& state) {
            weak_scaling(state, f, [&](auto& values) { benchmark::DoNotOptimize(vfs.smooth(values)); });
        });
        bench::run_on_ranks(f.ranks.rank(), argc, argv);
    }
    MPI_Finalize();
}
