// SPDX-License-Identifier: MIT
//
// Error against run time of the gas solver: pressure drop and outlet temperature of a bed of hot spheres by mesh size,
// by outer iterations and by tolerance.  The mesh's error is that against the exact solution of bed_case; the other two
// against the same mesh, solved until nothing changes.
#include <cmath>
#include <functional>
#include <string>

#include "gas/bed_case.hpp"
#include "support/counters.hpp"

using namespace hearth::gas;
using bench::bed_case;

namespace {

struct result {
    double drop, temperature;
};

constexpr int coarse = 16;

bed_case hot() {
    bed_case c;
    c.heat_exchange = 3000;
    return c;
}

result result_of(const solver& gas) {
    return {gas.mean_pressure("z_min") - bed_case::pressure, gas.mean_temperature("z_max")};
}

result solved(int n, double tolerance) {
    const bed_case c = hot();
    const mesh m(c.shape(n));
    solver_settings settings;
    settings.tolerance = tolerance;
    const auto gas = c.make(m, settings);
    gas->steady();
    return result_of(*gas);
}

result iterated(int iterations) {
    const bed_case c = hot();
    const mesh m(c.shape(coarse));
    const auto gas = c.make(m);
    for (int i = 0; i < iterations; ++i) gas->iterate();
    return result_of(*gas);
}

const result& settled() {
    static const result r = solved(coarse, 1e-10);
    return r;
}

const result& exact() {
    static const result r{hot().drop_from(0), hot().temperature_at(bed_case::height)};
    return r;
}

/// Two benchmarks of one run each: the drop's error and the temperature's, over the range of the gas's temperatures.
void add(const std::string& family, const std::string& parameter, const std::function<result()>& run,
         const result& (*best)()) {
    for (const bool of_drop : {true, false})
        benchmark::RegisterBenchmark(
            (family + (of_drop ? "/pressure drop/" : "/outlet temperature/") + parameter).c_str(),
            [=](benchmark::State& state) {
                const result wanted = best();
                result r{};
                for (auto _ : state) r = run();
                const double range = bed_case::particle_temperature - bed_case::temperature;
                bench::set_error(state, of_drop ? std::abs(r.drop / wanted.drop - 1)
                                                : std::abs(r.temperature - wanted.temperature) / range);
            })
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
    for (const int n : {8, 12, 16, 24, 32})
        add(
            "hot bed by mesh", "cells:" + std::to_string(n * n * n), [n] { return solved(n, 1e-5); }, exact);
    for (const int n : {1, 2, 4, 6, 8, 12, 16})
        add(
            "hot bed by outer iterations", "outer:" + std::to_string(n), [n] { return iterated(n); }, settled);
    for (const char* t : {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6"})
        add(
            "hot bed by tolerance", std::string("tolerance:") + t,
            [t] { return solved(coarse, std::strtod(t, nullptr)); }, settled);
    return true;
}();

}  // namespace
