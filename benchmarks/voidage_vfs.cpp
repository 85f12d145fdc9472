// SPDX-License-Identifier: MIT
// The Volume Fraction Smoother alone, in a bed of 60 % solid on 6 million cells: the paper's wave as scans of the whole
// field, the same with a queue, and the wave completed.  Error: solid left above the threshold plus the change of the
// solid volume, over the solid volume.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <hearth/core/lattice.hpp>
#include <hearth/voidage/vfs.hpp>

#include "support/counters.hpp"
#include "support/random.hpp"

namespace {

using namespace hearth;

constexpr int side = 182;
constexpr double mean_fraction = 0.6;
constexpr double pi = 3.14159265358979323846;

/// Particles on a jittered cubic grid, each put into the cell of its centre.  One bed is kept.
struct bed {
    lattice mesh{{{side, side, side}}};
    cell_graph<> graph{mesh};
    double particle = 0;  // volume in cells
    std::vector<double> field;

    void fill(double diameter) {
        particle = pi / 6 * diameter * diameter * diameter;
        field.assign(static_cast<std::size_t>(mesh.count()), 0.0);
        hearth_test::seeded random(1);
        const double pitch = std::cbrt(particle / mean_fraction);
        const auto count = static_cast<int>(side / pitch);
        const auto place = [&](int k) { return (k + 0.5 + random.uniform(-0.25, 0.25)) * pitch; };
        for (int k = 0; k < count * count * count; ++k) {
            const point x{place(k % count), place(k / count % count), place(k / count / count)};
            field[static_cast<std::size_t>(mesh_traits<lattice>::find_cell(mesh, x))] += particle;
        }
    }
};
bed& shared_bed(double diameter) {
    static bed one;
    static double filled = 0;
    if (filled != diameter) one.fill(filled = diameter);
    return one;
}

/// What a user would write after reading the paper: marks, and scans of all cells until nothing moves.
int full_scans(const cell_graph<>& graph, double threshold, std::vector<double>& fraction) {
    std::vector<char> smoothed(fraction.size(), 0);
    std::vector<double> share(fraction.size(), 0.0);
    const auto at = [](std::int32_t c) { return static_cast<std::size_t>(c); };
    for (int sweeps = 0;; ++sweeps) {
        bool moved = false;
        for (std::int32_t c = 0; c < graph.cell_count(); ++c) {
            if (smoothed[at(c)] == 0 && fraction[at(c)] > threshold) smoothed[at(c)] = 2;
        }
        for (std::int32_t c = 0; c < graph.cell_count(); ++c) {
            if (smoothed[at(c)] != 2) continue;
            double receivers = 0;
            graph.for_each_neighbour(c, [&](std::int32_t n) {
                if (smoothed[at(n)] == 0) receivers += graph.volume(n);
            });
            if (receivers > 0) {
                share[at(c)] = (fraction[at(c)] - threshold) * graph.volume(c) / receivers;
                fraction[at(c)] = threshold;
                moved = true;
            }
        }
        for (std::int32_t c = 0; c < graph.cell_count(); ++c) {
            if (smoothed[at(c)] != 2) continue;
            graph.for_each_neighbour(c, [&](std::int32_t n) {
                if (smoothed[at(n)] == 0) fraction[at(n)] += share[at(c)];
            });
            smoothed[at(c)] = 1;
        }
        if (!moved) return sweeps;
    }
}

double error_of(const bed& input, const std::vector<double>& field, double threshold) {
    long double before = 0, change = 0, above = 0;
    for (std::size_t c = 0; c < field.size(); ++c) {
        before += static_cast<long double>(input.field[c]);
        change += static_cast<long double>(field[c]) - static_cast<long double>(input.field[c]);
        above += static_cast<long double>(std::max(0.0, field[c] - threshold));
    }
    return static_cast<double>((std::abs(change) + above) / before);
}

void scans(benchmark::State& state, double diameter, double threshold) {
    const bed& input = shared_bed(diameter);
    std::vector<double> field;
    for (auto _ : state) {
        state.PauseTiming();
        field = input.field;
        state.ResumeTiming();
        state.counters["sweeps"] = full_scans(input.graph, threshold, field);
    }
    bench::set_error(state, error_of(input, field, threshold));
    bench::set_items(state, static_cast<double>(field.size()));
}

void smoother(benchmark::State& state, double diameter, double threshold, vfs_variant variant) {
    const bed& input = shared_bed(diameter);
    volume_fraction_smoother<cell_graph<>> smooth(input.graph, {threshold, variant});
    std::vector<double> field = input.field;
    vfs_report report = smooth.smooth(field);  // the buffers grow to their size
    for (auto _ : state) {
        state.PauseTiming();
        field = input.field;
        state.ResumeTiming();
        report = smooth.smooth(field);
    }
    const auto cells = static_cast<double>(field.size());
    bench::set_error(state, error_of(input, field, threshold));
    bench::set_items(state, cells);
    // The field is read and written once; a cell that gives needs its row: two bounds and six neighbours.
    bench::set_compulsory_bytes(state, 16 * cells + 32 * static_cast<double>(report.smoothed_cells));
    state.counters["sweeps"] = report.sweeps;
    state.counters["rings"] = report.rings;
    state.counters["touched"] = static_cast<double>(report.touched_cells) / cells;
    state.counters["log_bytes_per_touched"] =
        static_cast<double>(smooth.log_memory()) / static_cast<double>(report.touched_cells);
}

/// One particle dropped into the mesh, named by its cell.
void one_particle(benchmark::State& state, double diameter) {
    const bed& input = shared_bed(diameter);
    volume_fraction_smoother<cell_graph<>> smooth(input.graph, {0.9});
    std::vector<double> field(input.field.size(), 0.0);
    hearth_test::seeded random(2);
    std::vector<std::int32_t> touched(1);
    double worst = 0;
    for (auto _ : state) {
        state.PauseTiming();
        touched[0] = static_cast<std::int32_t>(random.index(field.size()));
        field[static_cast<std::size_t>(touched[0])] += input.particle;
        state.ResumeTiming();
        worst = std::max(worst, smooth.smooth(field, touched).maximum - 0.9);
    }
    bench::set_error(state, worst);
    bench::set_items(state, 1);
}

const bool registered = [] {
    for (const double diameter : {1.8, 4.0}) {
        for (const double threshold : {0.9, 0.74}) {
            const auto name = [&](const std::string& method) {
                return "smoothing a bed on 6 million cells/" + method + "/threshold " + (threshold > 0.8 ? "0.9" : "0.74") +
                       "/d_dx:" + (diameter < 2 ? "1.8" : "4");
            };
            benchmark::RegisterBenchmark(name("paper, full scans").c_str(), scans, diameter, threshold);
            benchmark::RegisterBenchmark(name("paper, queue").c_str(), smoother, diameter, threshold, vfs_variant::paper);
            benchmark::RegisterBenchmark(name("completed").c_str(), smoother, diameter, threshold, vfs_variant::completed);
        }
    }
    benchmark::RegisterBenchmark("one particle in 6 million cells/completed/d_dx:1.8", one_particle, 1.8);
    return true;
}();

}  // namespace
