// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include <benchmark/benchmark.h>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/reactor.hpp>

#include "solvers/combustion/cvode_oracle.hpp"
#include "solvers/combustion/states.hpp"

/// Cells of three kinds, what CVODE makes of them at 1e-11, and the error and time of a method over them.
namespace hearth::combustion {

inline constexpr double duration = 1e-4;  // [s]
inline constexpr double pressure = 101325;

inline oracle::state by_hearth(const oracle::state& start, const tolerance& tol) {
    per_species y;
    std::copy_n(start.begin(), species_count, y.begin());
    reactor gas({}, amounts(y), start[species_count], pressure);
    extents e{};
    benchmark::DoNotOptimize(integrate(gas, e, duration, tol));
    const per_species n = gas.amount(e);
    return oracle::state_of(n, combine(n).temperature(gas.enthalpy(), gas.temperature()));
}

struct ensemble {
    std::vector<oracle::state> start, exact;

    template <class Method>
    double error(const Method& method) const {
        double squares = 0;
        for (std::size_t i = 0; i < start.size(); ++i) {
            const double d = oracle::deviation(method(start[i]), exact[i]);
            squares += d * d;
        }
        return std::sqrt(squares / static_cast<double>(start.size()));
    }

    /// Processor time per cell, best of five [s].
    template <class Method>
    double seconds(const Method& method) const {
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 5; ++i) {
            const std::clock_t begin = std::clock();
            int passes = 0;
            do {
                for (const oracle::state& s : start) benchmark::DoNotOptimize(method(s));
                ++passes;
            } while (std::clock() - begin < CLOCKS_PER_SEC / 50);
            best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / passes);
        }
        return best / static_cast<double>(start.size());
    }
};

inline constexpr std::array kinds{"burnt cells", "cells at 1000 K", "igniting cells"};

inline const std::array<ensemble, kinds.size()>& ensembles() {
    static const std::array<ensemble, kinds.size()> all = [] {
        std::array<ensemble, kinds.size()> e;
        hearth_test::seeded random(7);
        for (int i = 0; i < 32; ++i) {
            const per_species fresh = methane_air(random.uniform(0.7, 1.3));
            const double h = combine(fresh).enthalpy(300);
            const per_species burnt = equilibrium(fresh, h, pressure).amount;
            const auto mixed = [&](double share) {
                per_species n;
                for (std::size_t k = 0; k < species_count; ++k) n[k] = burnt[k] + share * (fresh[k] - burnt[k]);
                return oracle::state_of(n, combine(n).temperature(h));
            };
            e[0].start.push_back(mixed(random.uniform(0, 0.1)));
            e[1].start.push_back(oracle::state_of(fresh, random.uniform(990, 1010)));
            e[2].start.push_back(i % 2 ? oracle::state_of(fresh, random.uniform(1200, 1800))
                                       : mixed(random.uniform(0.3, 0.6)));
        }
        oracle::cvode reference({});
        for (ensemble& one : e)
            for (const oracle::state& s : one.start) one.exact.push_back(reference.run(s, duration, 1e-11, 1e-16));
        return e;
    }();
    return all;
}

}  // namespace hearth::combustion
