// SPDX-License-Identifier: MIT
// A scene beside the same loop by hand.  Error: largest difference of the forces over the largest force.
#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/cost/cold_loop.cpp"
#include "support/counters.hpp"
#include "support/random.hpp"

namespace {

struct arrays {
    static constexpr std::size_t count = 100000;
    using vectors = std::vector<std::array<double, 3>>;
    std::vector<double> radius, void_fraction, density, viscosity;
    vectors velocity, wind, gradient, force, reaction;

    arrays() : density(count, 1.2), viscosity(count, 1.8e-5), force(count), reaction(count) {
        hearth_test::seeded random(1);
        for (std::size_t i = 0; i < count; ++i) {
            radius.push_back(random.uniform(0.004, 0.01));
            void_fraction.push_back(random.uniform(0.35, 0.5));
            velocity.push_back({random.uniform(-1, 1), 0, random.uniform(-1, 1)});
            wind.push_back({random.uniform(-2, 2), 0, random.uniform(-2, 2)});
            gradient.push_back({0, 0, random.uniform(-1000, 1000)});
        }
    }
    template <class Loop>
    void run(Loop loop) {
        cost::bed bed{static_cast<std::ptrdiff_t>(count), radius.data(), velocity.data(), force.data()};
        cost::gas gas{void_fraction.data(), density.data(),  viscosity.data(),
                      wind.data(),          gradient.data(), reaction.data()};
        std::array<double, 6> ledger;
        loop(bed, gas, ledger);
        benchmark::DoNotOptimize(ledger);
    }
};

template <class Loop>
void cold_bed(benchmark::State& state, Loop loop) {
    arrays once, exact, many;
    once.run(loop);
    exact.run(cost::by_hand);
    double error = 0, largest = 0;
    for (std::size_t i = 0; i < arrays::count; ++i)
        for (std::size_t a = 0; a < 3; ++a) {
            error = std::max(error, std::fabs(once.force[i][a] - exact.force[i][a]));
            largest = std::max(largest, std::fabs(exact.force[i][a]));
        }
    for (auto _ : state) many.run(loop);
    bench::set_error(state, error / largest);
    bench::set_items(state, static_cast<double>(arrays::count));
}

const bool registered = [] {
    benchmark::RegisterBenchmark("cold bed/scene", cold_bed<decltype(&cost::by_scene)>, &cost::by_scene);
    benchmark::RegisterBenchmark("cold bed/by hand", cold_bed<decltype(&cost::by_hand)>, &cost::by_hand);
    return true;
}();

}  // namespace
