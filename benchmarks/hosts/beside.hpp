// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

#include <benchmark/benchmark.h>

namespace bench {

/// Runs the same work on the host's data and on the library's own arrays by turns.  Reports the host's time, and as
/// counter over_own the least processor time of the one over that of the other: 1.02 is the bar for an adapter.
template <class OnHost, class OnOwn>
void beside(benchmark::State& state, OnHost&& on_host, OnOwn&& on_own) {
    const auto seconds = [](auto& body) {
        const std::clock_t start = std::clock();
        body();
        return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    };
    double host = std::numeric_limits<double>::infinity(), own = host;
    for (auto _ : state) {
        const double taken = seconds(on_host);
        state.SetIterationTime(taken);
        host = std::min(host, taken);
        own = std::min(own, seconds(on_own));
    }
    state.counters["over_own"] = host / own;
}

}  // namespace bench
