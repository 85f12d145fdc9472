// SPDX-License-Identifier: MIT
// Time scale splitting against Schumann's bed, and integrators on stiff radiation.
// Errors: K of the 100 K step at 100 mm over 1600 s of process time; K after 6 s of radiation from 300 towards 2500 K;
// K on a chain of 50 spheres before a wall at 2500 K after 1000 s, all against the same in far smaller steps or
// exactly.
#include <cmath>
#include <string>
#include <vector>

#include <hearth/core/constants.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/time/tssm.hpp>

#include "support/counters.hpp"
#include "support/packed_column.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

template <class Clock>
void column(benchmark::State& state, const Clock& clock, double step, std::size_t cells, double at, double delay) {
    const glass_bed bed;
    const double error = largest_error(bed, clock, at, step, 1600, cells, delay);
    const auto steps = static_cast<int>(1600 / (clock.factor(std::size_t{0}) * step) + 0.5);
    for (auto _ : state) {
        packed_column<Clock> run(bed, clock, 0.15, cells);
        for (int n = 0; n < steps; ++n) run.advance(step);
        benchmark::DoNotOptimize(run.solid().data());
    }
    bench::set_error(state, error);
    bench::set_items(state, static_cast<double>(steps) * static_cast<double>(cells));
    state.SetLabel("K");
}

// The gas's own step stays at 1 ms, as a solver's Courant limit would have it, so Gamma buys fewer steps.
void splitting(benchmark::State& state, gas_storage form, double gamma, double step) {
    column(state, tssm(gamma, form), step, 150, 0.1, 0);
}
void shifted(benchmark::State& state, double gamma) {
    const double delay = tssm_delay(gamma, gas_storage::paper, 0.1, glass_bed{}.interstitial_velocity());
    column(state, tssm(gamma, gas_storage::paper), 1e-3, 150, 0.1, delay);
}

/// What users do without splitting: upwind gas and explicit exchange at the gas's step.
void explicit_upwind(benchmark::State& state, double gamma) {
    const glass_bed bed;
    const std::size_t cells = 150;
    const double dx = 0.15 / static_cast<double>(cells), dt = 0.8 * dx / bed.interstitial_velocity();
    const auto steps = static_cast<long>(1600 / (gamma * dt) + 0.5);
    std::vector<double> gas, solid;
    const auto step = [&] {
        double upstream = bed.hot;
        for (std::size_t i = 0; i < cells; ++i) {
            const double old = gas[i], q = bed.exchange * (solid[i] - old);
            gas[i] += dt / bed.gas_storage() * (bed.capacity_flow() / dx * (upstream - old) + q);
            solid[i] -= gamma * dt / bed.solid_storage() * q;
            upstream = old;
        }
    };
    double error = 0;
    const auto run = [&](bool measure) {
        gas.assign(cells, bed.cold);
        solid.assign(cells, bed.cold);
        for (long n = 1; n <= steps; ++n) {
            step();
            if (measure && n % std::max(1L, steps / 400) == 0)
                error = std::max(error, std::fabs((solid[99] + solid[100]) / 2 -
                                                  bed.solid(0.1, static_cast<double>(n) * gamma * dt)));
        }
    };
    run(true);
    for (auto _ : state) {
        run(false);
        benchmark::DoNotOptimize(solid.data());
    }
    bench::set_error(state, error);
    state.SetLabel("K");
}

const double sphere_area = constants<double>::pi() * 0.018 * 0.018;
const double sphere_mass = 3580 * sphere_area * 0.018 / 6;

template <class Scheme>
double radiated_to(int steps) {
    heat_bath<> bath;
    bath.add(radiative_link<double>{constants<double>::stefan_boltzmann() * sphere_area}, 2500.0);
    const constant_specific_heat<> caloric{1000};
    double t = 300;
    for (int n = 0; n < steps; ++n) t = Scheme::advance(t, sphere_mass, caloric, bath, 6.0 / steps).temperature;
    return t;
}

template <class Scheme>
void integrator(benchmark::State& state, int steps) {
    static const double exact = radiated_to<etd2_secant>(1 << 20);
    double t = 0;
    for (auto _ : state) benchmark::DoNotOptimize(t = radiated_to<Scheme>(steps));
    bench::set_error(state, std::fabs(t - exact));
    bench::set_items(state, steps);
    state.SetLabel("K");
}

std::vector<double> chain(double step, int passes) {
    std::vector<linked_pair<radiative_link<double>>> pairs;
    const radiative_link<double> link{constants<double>::stefan_boltzmann() * sphere_area / 8};
    for (int i = 0; i + 1 < 50; ++i) pairs.push_back({i, i + 1, link});
    std::vector<heat_bath<double>> baths(50);
    baths[0].add(link, 2500.0);
    const std::vector<double> mass(50, sphere_mass);
    std::vector<double> t(50, 300.0);
    std::vector<particle_step<double>> taken;
    const constant_specific_heat<> caloric{1000};
    thermal_network::params settings;
    settings.passes = passes;
    thermal_network solver(settings);
    for (int n = 0; n < static_cast<int>(1000 / step + 0.5); ++n)
        solver.advance(
            pairs, baths, mass, [&](std::size_t) { return caloric; }, unsplit{}, step, t, taken);
    return t;
}

void network(benchmark::State& state, int passes, double step) {
    static const std::vector<double> exact = chain(0.02, 2);
    std::vector<double> t;
    for (auto _ : state) {
        t = chain(step, passes);
        benchmark::DoNotOptimize(t.data());
    }
    double error = 0;
    for (std::size_t i = 0; i < t.size(); ++i) error = std::max(error, std::fabs(t[i] - exact[i]));
    bench::set_error(state, error);
    bench::set_items(state, 49 * 1000 / step);
    state.SetLabel("K");
}

const bool registered = [] {
    const auto number = [](double x) { return std::to_string(static_cast<int>(x)); };
    for (const double gamma : {10.0, 50.0, 200.0, 678.0, 2000.0}) {
        const std::string at = "/gamma:" + number(gamma);
        benchmark::RegisterBenchmark(("schumann bed/paper" + at).c_str(), splitting, gas_storage::paper, gamma, 1e-3);
        benchmark::RegisterBenchmark(("schumann bed/corrected" + at).c_str(), splitting, gas_storage::corrected, gamma,
                                     1e-3);
        benchmark::RegisterBenchmark(("schumann bed/quasi-steady" + at).c_str(), splitting, gas_storage::quasi_steady,
                                     gamma, 1e-3);
        benchmark::RegisterBenchmark(("schumann bed/paper, delay undone" + at).c_str(), shifted, gamma);
        benchmark::RegisterBenchmark(("schumann bed/paper, explicit upwind" + at).c_str(), explicit_upwind, gamma);
    }
    for (const double process_step : {1.0, 2.0, 5.0, 10.0, 20.0})
        benchmark::RegisterBenchmark(("schumann bed/quasi-steady, long steps/s:" + number(process_step)).c_str(),
                                     splitting, gas_storage::quasi_steady, 678.0, process_step / 678);
    for (const int steps : {1, 4, 16, 64, 256}) {
        const std::string at = "/steps:" + std::to_string(steps);
        benchmark::RegisterBenchmark(("radiation to 2500 K/explicit Euler" + at).c_str(), integrator<explicit_euler>,
                                     steps);
        benchmark::RegisterBenchmark(("radiation to 2500 K/backward Euler" + at).c_str(), integrator<backward_euler>,
                                     steps);
        benchmark::RegisterBenchmark(("radiation to 2500 K/ETD2 secant" + at).c_str(), integrator<etd2_secant>, steps);
    }
    for (const double step : {1.0, 10.0, 100.0})
        for (const int passes : {1, 2, 4})
            benchmark::RegisterBenchmark(
                ("radiating chain/passes " + std::to_string(passes) + "/s:" + number(step)).c_str(), network, passes,
                step);
    return true;
}();

}  // namespace
