// SPDX-License-Identifier: MIT
//
// Cost of the gas solver on one core: a bed under a free region, flow from below.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

using namespace hearth::gas;

namespace {

struct column {
    explicit column(int n) : grid(box(graded(0.3, n), graded(0.3, n), graded(0.6, n))), gas(grid, air(), settings()) {
        for (const char* side : {"x_min", "x_max", "y_min", "y_max"}) gas.set(side, wall());
        gas.set("z_min", mass_flow_inlet(0.1, {300}));
        gas.set("z_max", pressure_outlet(101325));
        for (int c = 0; c < grid.cells(); ++c) {
            const vector3& x = grid.centre[c];
            const double ripple = 0.05 * std::sin(40 * x.x) * std::sin(40 * x.y) * std::sin(40 * x.z);
            gas.bed.void_fraction[c] = x.z < 0.3 ? 0.42 + ripple : 1;
            gas.bed.diameter[c] = 0.014;
        }
        gas.initialise(300);
        gas.level_zero();
    }
    static std::shared_ptr<simple_gas> air() { return std::make_shared<simple_gas>(); }
    static solver_settings settings() {
        solver_settings s;
        s.energy = s.turbulence = false;
        return s;
    }
    mesh grid;
    solver gas;
};

/// One steady outer iteration: three momentum components and the pressure.
void outer_iteration(benchmark::State& state) {
    column c(static_cast<int>(state.range(0)));
    for (int i = 0; i < 10; ++i) c.gas.iterate();
    report last;
    for (auto _ : state) last = c.gas.iterate();
    state.counters["us_per_cell"] = benchmark::Counter(
        1e-6 * c.grid.cells(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["error"] = last.flow.mass_imbalance;
    state.counters["pressure_iterations"] = last.flow.pressure.iterations;
}
BENCHMARK(outer_iteration)->Arg(46)->Arg(100)->Unit(benchmark::kMillisecond)->MinTime(2);

}  // namespace
