// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <vector>

#include <sys/resource.h>

#include <benchmark/benchmark.h>

/// What a benchmark tells beside its time.  report.py reads these counters by their names.
namespace bench {

/// Largest or rms error of the result against a better one; say which in the benchmark's file.
/// Relative to the exact value, or in the unit that the family's label names.
inline void set_error(benchmark::State& state, double error) { state.counters["error"] = error; }

/// Time per item of work [s]: a cell, a pair, a particle and step.
inline void set_items(benchmark::State& state, double items_per_iteration) {
    state.counters["per_item"] =
        benchmark::Counter(items_per_iteration * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Processor time of this process [s].
inline double processor_seconds() {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Most memory that this process has had in use [bytes].
inline double peak_bytes() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return 1024.0 * static_cast<double>(used.ru_maxrss);
}

/// Bandwidth of a = b + s * c over arrays far larger than any cache [B/s], best of five, counted as STREAM does:
/// 24 bytes an element.  Measured once per process, so that ratios to it belong to the same run.
inline double stream_bandwidth() {
    static const double measured = [] {
        const std::size_t n = std::size_t{1} << 24;
        std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
        double best = 0;
        for (int repetition = 0; repetition < 5; ++repetition) {
            const auto begin = std::chrono::steady_clock::now();
            for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
            benchmark::DoNotOptimize(a.data());
            benchmark::ClobberMemory();
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
            best = std::max(best, 24.0 * static_cast<double>(n) / seconds.count());
        }
        return best;
    }();
    return measured;
}

/// Time over the time in which STREAM would move the bytes that must move: each array that the algorithm cannot avoid
/// to read or write, counted once.  1 is as fast as memory allows.
inline void set_compulsory_bytes(benchmark::State& state, double bytes_per_iteration) {
    state.counters["over_stream"] = benchmark::Counter(
        bytes_per_iteration * static_cast<double>(state.iterations()) / stream_bandwidth(),
        benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace bench
