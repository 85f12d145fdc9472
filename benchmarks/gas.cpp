// SPDX-License-Identifier: MIT
//
// Cost of the gas solver on one core: an outer iteration of a bed under a free region, and the pressure solve alone.
// us_per_cell is printed with the unit s: read it as microseconds.
#include <benchmark/benchmark.h>
#include <malloc.h>

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

double allocated_bytes() {
    const auto heap = mallinfo2();
    return static_cast<double>(heap.uordblks) + static_cast<double>(heap.hblkhd);
}

/// One steady outer iteration: three momentum components and the pressure.
void outer_iteration(benchmark::State& state) {
    const double before = allocated_bytes();
    column c(static_cast<int>(state.range(0)));
    for (int i = 0; i < 10; ++i) c.gas.iterate();
    report last;
    for (auto _ : state) last = c.gas.iterate();
    state.counters["us_per_cell"] = benchmark::Counter(
        1e-6 * c.grid.cells(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["bytes_per_cell"] = (allocated_bytes() - before) / c.grid.cells();
    state.counters["mass_imbalance"] = last.flow.mass_imbalance;  // of as many iterations as were timed
    state.counters["pressure_iterations"] = last.flow.pressure.iterations;
}
BENCHMARK(outer_iteration)->Arg(46)->Arg(100)->Unit(benchmark::kMillisecond);

/// A pressure equation solved to 1e-9 with a hierarchy that is kept: iterations should not grow with the cells.
void pressure_solve(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0));
    const mesh m(box(graded(1, n), graded(1, n), graded(2, n, 5.0)));
    const pattern p(m);
    const parallel one;
    matrix a(p);
    for (int f = 0; f < m.internal_faces(); ++f) {
        const double g = m.conductance[f] * (m.face_centre[f].z < 1 ? 1.0 : 1e3);  // bed below, free gas above
        a.entry[p.owner_entry[f]] = a.entry[p.neighbour_entry[f]] = -g;
        a.diagonal[m.owner[f]] += g;
        a.diagonal[m.neighbour[f]] += g;
    }
    const patch& top = m.find_patch("z_max");
    for (int f = top.first; f < top.first + top.count; ++f) a.diagonal[m.owner[f]] += 1e3 * m.conductance[f];
    array<double> b(m.cells()), x(m.cells());
    for (int c = 0; c < m.cells(); ++c) b[c] = m.volume[c] * std::sin(7 * m.centre[c].x) * std::cos(5 * m.centre[c].z);
    workspace work(p);
    symmetric_solver solver(make_multigrid(p), one, work);
    solve_report last = solver.solve(a, b.data(), x.data(), {1e-9, 0, 200});  // builds the hierarchy
    for (auto _ : state) {
        std::fill(x.begin(), x.end(), 0.0);
        last = solver.solve(a, b.data(), x.data(), {1e-9, 0, 200});
    }
    state.counters["us_per_cell"] = benchmark::Counter(
        1e-6 * m.cells(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["iterations"] = last.iterations;
    state.counters["error"] = last.last / last.first;
}
BENCHMARK(pressure_solve)->Arg(25)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
