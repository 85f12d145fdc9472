// SPDX-License-Identifier: MIT
// Every closure by kind of number: families "closure NAME", curves `plain` (a loop over plain numbers, as a host writes
// it) and `lanes` (Eigen arrays as wide as a register of 64 bytes), points by the bits of the significand.
// error: largest relative difference from the same inputs in long double.
// over_plain (lanes): time of the plain loop over that of the lanes, both timed alternately in this benchmark.
// Bars with AVX-512: 3 for closures with powers, 0.95 for those that the compiler vectorises by itself.
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 takes the undefined register in its own AVX-512 intrinsics for a mistake of ours (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include <hearth/eigen.hpp>

#include "support/closure_condition.hpp"
#include "support/closure_probes.hpp"
#include "support/counters.hpp"

namespace {

constexpr std::size_t count = 512;  // inputs and outputs stay in the first cache

template <class Real>
using lanes_of = Eigen::Array<Real, 64 / static_cast<int>(sizeof(Real)), 1>;

template <class Probe>
constexpr std::size_t inputs_of = Probe::about().inputs.size();

/// Inputs of one probe, one array each, and room for the outputs.
template <class Probe, class Real>
struct batch {
    std::array<std::vector<Real>, inputs_of<Probe>> in;
    std::vector<Real> out = std::vector<Real>(count);

    batch() {
        hearth_test::seeded random(1);
        for (auto& column : in) column.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::vector<double> x = hearth_test::draw<Probe>(random);
            for (std::size_t k = 0; k < x.size(); ++k) in[k][i] = static_cast<Real>(x[k]);
        }
    }

    std::array<const Real*, inputs_of<Probe>> columns() const {
        std::array<const Real*, inputs_of<Probe>> pointers;
        for (std::size_t k = 0; k < pointers.size(); ++k) pointers[k] = in[k].data();
        return pointers;
    }

    double error(const Probe& probe) const {
        double largest = 0;
        for (std::size_t i = 0; i < count; ++i) {
            std::array<long double, inputs_of<Probe>> x;
            for (std::size_t k = 0; k < x.size(); ++k) x[k] = static_cast<long double>(in[k][i]);
            largest = std::max(largest, hearth_test::relative_error(out[i], probe(x.data())));
        }
        return largest;
    }
};

template <class Probe, class Real>
void run_plain(Probe probe, batch<Probe, Real>& data) {
    Real* const out = data.out.data();
    const auto in = data.columns();
    for (std::size_t i = 0; i < count; ++i) {
        Real x[inputs_of<Probe>];
        for (std::size_t k = 0; k < in.size(); ++k) x[k] = in[k][i];
        out[i] = probe(x);
    }
    benchmark::DoNotOptimize(out);
    benchmark::ClobberMemory();
}

template <class Probe, class Real>
void run_lanes(Probe probe, batch<Probe, Real>& data) {
    using lanes = lanes_of<Real>;
    Real* const out = data.out.data();
    const auto in = data.columns();
    for (std::size_t i = 0; i < count; i += lanes::SizeAtCompileTime) {
        lanes x[inputs_of<Probe>];
        for (std::size_t k = 0; k < inputs_of<Probe>; ++k) x[k] = lanes::Map(in[k] + i);
        lanes::Map(out + i) = probe(x);
    }
    benchmark::DoNotOptimize(out);
    benchmark::ClobberMemory();
}

/// Time of the plain loop over that of the lanes: best of many, in turns, so that both meet the same machine.
template <class Probe, class Real>
double plain_over_lanes(const Probe& probe) {
    batch<Probe, Real> data;
    const auto time = [](auto&& run) {
        const auto begin = std::chrono::steady_clock::now();
        for (int repetition = 0; repetition < 32; ++repetition) run();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    double plain = std::numeric_limits<double>::infinity(), lanes = plain;
    for (int round = 0; round < 50; ++round) {
        plain = std::min(plain, time([&] { run_plain(probe, data); }));
        lanes = std::min(lanes, time([&] { run_lanes(probe, data); }));
    }

    return plain / lanes;
}

template <class Real, class Probe>
void register_kinds(const Probe& probe) {
    const std::string family = std::string("closure ") + Probe::about().name;
    const std::string bits = "/bits:" + std::to_string(std::numeric_limits<Real>::digits);
    benchmark::RegisterBenchmark((family + "/plain" + bits).c_str(), [probe](benchmark::State& state) {
        batch<Probe, Real> data;
        for (auto _ : state) run_plain(probe, data);
        bench::set_error(state, data.error(probe));
        bench::set_items(state, count);
    });
    if constexpr (!std::is_same_v<Real, long double>) {
        benchmark::RegisterBenchmark((family + "/lanes" + bits).c_str(), [probe](benchmark::State& state) {
            batch<Probe, Real> data;
            for (auto _ : state) run_lanes(probe, data);
            bench::set_error(state, data.error(probe));
            bench::set_items(state, count);
            state.counters["over_plain"] = plain_over_lanes<Probe, Real>(probe);
        });
    }
}

const bool registered = [] {
    hearth_test::for_each_closure([](const auto& probe) {
        register_kinds<float>(probe);
        register_kinds<double>(probe);
        register_kinds<long double>(probe);
    });
    return true;
}();

}  // namespace
