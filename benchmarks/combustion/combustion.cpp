// SPDX-License-Identifier: MIT
//
// Chemistry of single cells against CVODE on the same rates, and what the other models of a cell cost.
//
// Three kinds of cells, 32 of each, over 1e-4 s: burnt gas that has met up to a tenth of fresh gas; fresh gas at 1000
// K, which reacts slowly; igniting cells, half of them preheated fresh gas at 1200 to 1800 K, half of them burnt and
// fresh gas mixed.  The error is the root mean square over the cells of the deviation from CVODE at 1e-11: of the
// temperature, relative, or of a mass fraction, relative or of a thousandth for traces, whichever is largest.
#include <array>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <hearth/combustion/chemistry.hpp>
#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/transport.hpp>

#include "combustion/ensembles.hpp"
#include "support/counters.hpp"

using namespace hearth::combustion;

namespace {

template <class Method>
void run(benchmark::State& state, const ensemble& cells, const Method& method) {
    for (auto _ : state)
        for (const oracle::state& s : cells.start) benchmark::DoNotOptimize(method(s));
    bench::set_error(state, cells.error(method));
    bench::set_items(state, static_cast<double>(cells.start.size()));
}

/// The least gain over CVODE at a relative tolerance of 1e-4, over the absolute tolerances with which its error stays
/// below a hundredth: each against the cheapest of our tolerances that has no larger error.  The `error` is ours there.
void times_faster(benchmark::State& state, const ensemble& cells) {
    struct point {
        double error, seconds;
    };
    std::vector<point> ours;
    for (const double relative : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5})
        for (const double absolute : {1e-1, 3e-2, 1e-2, 3e-3, 1e-3}) {
            const auto method = [&](const oracle::state& s) { return by_hearth(s, {relative, relative * absolute}); };
            ours.push_back({cells.error(method), cells.seconds(method)});
        }
    oracle::cvode cvode({});
    double least = std::numeric_limits<double>::infinity(), error = 0, theirs = 0;
    for (const double absolute : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
        const auto method = [&](const oracle::state& s) { return cvode.run(s, duration, 1e-4, absolute); };
        const double allowed = cells.error(method);
        if (!(allowed < 1e-2)) continue;
        const double seconds = cells.seconds(method);
        point best{0, std::numeric_limits<double>::infinity()};
        for (const point& p : ours)
            if (p.error <= allowed && p.seconds < best.seconds) best = p;
        if (seconds / best.seconds < least) {
            least = seconds / best.seconds;
            error = best.error;
            theirs = allowed;
        }
    }
    for (auto _ : state) benchmark::DoNotOptimize(least);
    state.counters["times_faster"] = least;
    state.counters["error_cvode"] = theirs;
    bench::set_error(state, error);
}

/// A hundred thousand cells that cannot react, of each kind in turn.
void inert(benchmark::State& state) {
    const std::size_t count = 100000;
    const std::array<per_species, 3> mixtures{methane_air(1.0), amounts_from_moles({0, 0.21, 0.79, 0, 0, 0, 0}),
                                              amounts_from_moles({0, 0.02, 0.7, 0, 0.1, 0, 0.18})};
    const std::array<double, 3> temperatures{300, 2300, 700};
    std::vector<double> p(count, pressure), t(count);
    std::array<std::vector<double>, species_count> y;
    cell_arrays cells{count, p.data(), t.data(), {}, 1, nullptr};
    for (std::size_t k = 0; k < species_count; ++k) {
        y[k].resize(count);
        cells.mass_fraction[k] = y[k].data();
    }
    for (std::size_t i = 0; i < count; ++i) {
        const per_species fractions = mass_fractions(mixtures[i % 3]);
        t[i] = temperatures[i % 3];
        for (std::size_t k = 0; k < species_count; ++k) y[k][i] = fractions[k];
    }
    std::size_t reacting = 0;
    for (auto _ : state) reacting += advance({}, duration, cells).reacting;
    state.counters["reacting"] = static_cast<double>(reacting);
    bench::set_items(state, static_cast<double>(count));
}

template <class Function>
void per_call(benchmark::State& state, const Function& function) {
    double i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(function(i += 1e-6));
    bench::set_items(state, 1);
}

const bool registered = [] {
    const auto name = [](const std::string& family, const std::string& method, double relative) {
        char value[32];
        std::snprintf(value, sizeof value, "%g", relative);
        return family + "/" + method + "/relative:" + value;
    };
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const std::string family = std::string("chemistry of ") + kinds[i];
        for (const double relative : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
            for (const double absolute : {1e-2, 1e-3})
                benchmark::RegisterBenchmark(
                    name(family, absolute > 5e-3 ? "Rodas4 in extents" : "Rodas4 in extents, absolute 1e-3 of it",
                         relative)
                        .c_str(),
                    [=](benchmark::State& state) {
                        run(state, ensembles()[i], [&](const oracle::state& s) {
                            return by_hearth(s, {relative, relative * absolute});
                        });
                    })
                    ->Unit(benchmark::kMicrosecond);
        for (const double relative : {1e-3, 1e-4, 1e-5, 1e-6})
            for (const double absolute : {1e-4, 1e-6})
                benchmark::RegisterBenchmark(
                    name(family, absolute > 5e-5 ? "CVODE, absolute 1e-4 of it" : "CVODE, absolute 1e-6 of it",
                         relative)
                        .c_str(),
                    [=](benchmark::State& state) {
                        oracle::cvode cvode({});
                        run(state, ensembles()[i], [&](const oracle::state& s) {
                            return cvode.run(s, duration, relative, relative * absolute);
                        });
                    })
                    ->Unit(benchmark::kMicrosecond);
        benchmark::RegisterBenchmark((std::string("chemistry against CVODE at 1e-4/") + kinds[i]).c_str(),
                                     [=](benchmark::State& state) { times_faster(state, ensembles()[i]); })
            ->Iterations(1);
    }
    benchmark::RegisterBenchmark("chemistry of other cells/cannot react", inert)->Unit(benchmark::kMicrosecond);
    const per_species n = methane_air(1.0), x = mole_fractions(n);
    const double h = combine(n).enthalpy(300);
    benchmark::RegisterBenchmark("chemistry of other cells/equilibrium", [=](benchmark::State& state) {
        per_call(state, [&](double i) { return equilibrium(n, h + i, pressure, 2200); });
    });
    benchmark::RegisterBenchmark("chemistry of other cells/mixed is burnt", [=](benchmark::State& state) {
        per_call(state, [&](double i) { return burn(n, h + i); });
    });
    benchmark::RegisterBenchmark("properties of a cell/temperature from enthalpy", [=](benchmark::State& state) {
        per_call(state, [&](double i) { return combine(n).temperature(h + 1e6 + 1e3 * i, 1200); });
    });
    benchmark::RegisterBenchmark(
        "properties of a cell/viscosity, conductivity, diffusivities",
        [=](benchmark::State& state) { per_call(state, [&](double i) { return transport(1200 + i, pressure, x); }); });
    return true;
}();

}  // namespace
