// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/constants.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>

#include "support/random.hpp"

using namespace hearth;
using hearth_test::seeded;

namespace {

constexpr double sigma = constants<double>::stefan_boltzmann();

struct network {
    std::vector<thermal_pair> pairs;
    std::vector<heat_bath<double>> baths;
    std::vector<double> mass, temperature, factor;
    double low = 1e300, high = 0;

    explicit network(std::size_t count)
        : baths(count), mass(count, 1.0), temperature(count, 300.0), factor(count, 1.0) {}
    void bath(std::size_t i, const thermal_link<double>& link, double t) {
        baths[i].add(link, t);
        low = std::min(low, t);
        high = std::max(high, t);
    }
    void range() {
        for (const double t : temperature) low = std::min(low, t), high = std::max(high, t);
    }
};

network random_network(std::uint64_t seed, bool closed) {
    seeded random(seed);
    const auto count = static_cast<std::size_t>(random.log_uniform(2, 400));
    network n(count);
    // A chain, or a tree with random extra links, in one to three islands.
    const std::size_t islands = 1 + random.index(3);
    const bool chain = random.uniform(0, 1) < 0.3;
    const auto link = [&] {
        return thermal_link<double>{random.uniform(0, 1) < 0.6 ? random.log_uniform(1e-4, 1) : 0.0,
                                    random.log_uniform(1e-13, 1e-10)};
    };
    for (std::size_t i = islands; i < count; ++i) {
        const std::size_t same = i % islands;
        const std::size_t up = chain ? i - islands : same + islands * random.index((i - same) / islands);
        n.pairs.push_back({static_cast<std::int32_t>(up), static_cast<std::int32_t>(i), link()});
        for (int extra = chain ? 0 : 3; extra > 0 && i >= 2 * islands; --extra) {
            const std::size_t other = same + islands * random.index((i - same) / islands);
            n.pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(other), link()});
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        n.mass[i] = random.log_uniform(1e-3, 1e-1);
        n.temperature[i] = random.uniform(280, 2500);
        n.factor[i] = random.uniform(0, 1) < 0.2 ? 1.0 : 678.0;
        if (!closed && random.uniform(0, 1) < 0.2) n.bath(i, link(), random.uniform(280, 2500));
    }
    n.range();
    return n;
}

/// What the step left unaccounted for, over what it moved: the sum over particles of heat / Gamma less what the baths
/// gave.
template <class CaloricOf>
double imbalance(const network& before, const std::vector<particle_step<double>>& taken, const CaloricOf& caloric_of) {
    double gained = 0, given = 0, turnover = 0, rounding = 0;
    for (std::size_t i = 0; i < taken.size(); ++i) {
        const double f = before.factor[i];
        gained += taken[i].heat / f;
        given += (taken[i].conducted + taken[i].radiated) / f;
        turnover += (std::fabs(taken[i].heat) + std::fabs(taken[i].conducted) + std::fabs(taken[i].radiated)) / f;
        rounding += before.mass[i] * std::fabs(caloric_of(i).enthalpy(before.temperature[i])) / f;
    }
    // Temperatures are doubles: at tiny steps the enthalpy change is known to some round-offs of the enthalpy only, and
    // 1e-12 of a hundredth of it is 45 of them.
    return std::fabs(gained - given) / (turnover + 1e-2 * rounding);
}

template <class CaloricOf>
void bounds_and_energy(const CaloricOf& caloric_of) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        CAPTURE(seed);
        network n = random_network(seed, seed % 2 == 0);
        const double step = seeded(seed + 1000).log_uniform(1e-9, 1e9);
        CAPTURE(step);
        std::vector<double> t = n.temperature;
        std::vector<particle_step<double>> taken;
        thermal_network solver;
        const auto report =
            solver.advance(n.pairs, n.baths, n.mass, caloric_of, tssm_per_particle(678.0, n.factor), step, t, taken);
        REQUIRE(report.converged);
        const double room = 1e-9 * (n.high - n.low);
        for (const double value : t) {
            REQUIRE(value >= n.low - room);
            REQUIRE(value <= n.high + room);
        }
        REQUIRE(imbalance(n, taken, caloric_of) <= 1e-12);
    }
}

TEST_CASE("thermal network: no temperature leaves the bounds and no joule is lost, for steps of 1e-9 to 1e9 s") {
    const constant_specific_heat<> plain{1000};
    bounds_and_energy([&](std::size_t) { return plain; });
}

TEST_CASE("thermal network: the same with a specific heat that bends") {
    const polynomial_specific_heat<2> bent{{950.0, 0.28}, -1.3e7};
    bounds_and_energy([&](std::size_t) { return bent; });
}

TEST_CASE("thermal network: two spheres meet at the mean of their heat, each at its own Gamma") {
    const constant_specific_heat<> caloric{500};
    const auto caloric_of = [&](std::size_t) { return caloric; };
    const std::vector<thermal_pair> pairs{{0, 1, {0.02, 0.0}}};
    const std::vector<double> mass{2e-3, 6e-3};
    const std::vector<heat_bath<double>> baths(2);
    std::vector<particle_step<double>> taken;
    const auto meet = [&](std::vector<double> factor) {
        std::vector<double> t{400.0, 1200.0};
        thermal_network().advance(pairs, baths, mass, caloric_of, tssm_per_particle(678.0, factor), 1e9, t, taken);
        return t;
    };
    // Backward Euler leaves 1/(1 + rate step) of the gap of 800 K; rate step is at least 0.02 (1/1 + 678/3) 1e9
    // = 4.5e9. m c / Gamma weighs: (2*400 + 6*1200)/8 = 1000, and (2/1*400 + 6/678*1200)/(2/1 + 6/678).
    for (const double t : meet({678.0, 678.0})) CHECK(t == doctest::Approx(1000).epsilon(1e-9));
    for (const double t : meet({1.0, 678.0}))
        CHECK(t == doctest::Approx((2 * 400 + 6.0 / 678 * 1200) / (2 + 6.0 / 678)).epsilon(1e-9));

    // A short step is the explicit rate: relative error of half the rate times the step, 2e-5.
    std::vector<double> t{400.0, 1200.0};
    thermal_network().advance(pairs, baths, mass, caloric_of, tssm(678.0), 1e-6, t, taken);
    CHECK(t[0] - 400 == doctest::Approx(678 * 0.02 * 800 / (2e-3 * 500) * 1e-6).epsilon(2e-5));
}

TEST_CASE("thermal network: one pass satisfies the linear equations of a chain") {
    const constant_specific_heat<> caloric{1000};
    network n(40);
    for (int i = 0; i + 1 < 40; ++i) n.pairs.push_back({i, i + 1, {0.05 + 0.01 * i, 0.0}});
    for (std::size_t i = 0; i < 40; ++i) n.temperature[i] = 300 + 50 * static_cast<double>(i % 7);
    n.bath(0, {0.3, 0.0}, 1500);
    const double step = 30;
    std::vector<double> t = n.temperature;
    std::vector<particle_step<double>> taken;
    thermal_network::params to_round_off;
    to_round_off.tolerance = 1e-16;
    const auto report =
        thermal_network(to_round_off)
            .advance(
                n.pairs, n.baths, n.mass, [&](std::size_t) { return caloric; }, tssm(200.0), step, t, taken);
    CHECK(report.converged);
    for (std::size_t i = 0; i < 40; ++i) {
        double rate = i == 0 ? 0.3 * (1500 - t[0]) : 0.0, size = 0.3 * 1500;
        for (const auto& pair : n.pairs) {
            const double flow = pair.link.conductance *
                                (t[static_cast<std::size_t>(pair.second)] - t[static_cast<std::size_t>(pair.first)]);
            if (pair.first == static_cast<int>(i)) rate += flow;
            if (pair.second == static_cast<int>(i)) rate -= flow;
        }
        size += 1000 / (200.0 * step) * t[i];
        CHECK(std::fabs(1000 / (200.0 * step) * (t[i] - n.temperature[i]) - rate) <= 1e-12 * size);
    }
}

// 50 spheres of 18 mm in a row, the first before a wall at 2500 K; exchange areas of pi d^2 / 8, the rest at 300 K.
network wall_chain() {
    network n(50);
    const double area = 3.14159265358979 * 0.018 * 0.018, mass = 3580 * area * 0.018 / 6;
    const thermal_link<double> link{0.0, sigma * area / 8};
    for (int i = 0; i + 1 < 50; ++i) n.pairs.push_back({i, i + 1, link});
    n.mass.assign(50, mass);
    n.bath(0, link, 2500);
    n.range();
    return n;
}

std::vector<double> march(const network& n, double time, double step, int passes) {
    const constant_specific_heat<> caloric{1000};
    thermal_network::params settings;
    settings.passes = passes;
    thermal_network solver(settings);
    std::vector<double> t = n.temperature;
    std::vector<particle_step<double>> taken;
    for (int k = 0; k < static_cast<int>(time / step + 0.5); ++k)
        solver.advance(
            n.pairs, n.baths, n.mass, [&](std::size_t) { return caloric; }, unsplit{}, step, t, taken);
    return t;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double d = 0;
    for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, std::fabs(a[i] - b[i]));
    return d;
}

TEST_CASE("thermal network: two passes are backward Euler for radiation, one pass lags") {
    const network n = wall_chain();
    for (const double step : {1.0, 10.0}) {
        CAPTURE(step);
        const auto converged = march(n, 1000, step, 60);
        const double one = distance(march(n, 1000, step, 1), converged);
        const double two = distance(march(n, 1000, step, 2), converged);
        const double first_order = distance(converged, march(n, 1000, step / 16, 2));
        CAPTURE(one);
        CAPTURE(two);
        CAPTURE(first_order);
        // The second pass leaves less than the time step does; one pass leaves more than that.
        CHECK(two < 0.5 * first_order);
        CHECK(one > 3 * two);
    }
}

TEST_CASE("thermal network: the error that it reports bounds the distance to the solution") {
    const constant_specific_heat<> caloric{1000};
    const auto caloric_of = [&](std::size_t) { return caloric; };
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        const network n = random_network(seed, false);
        const double step = seeded(seed + 2000).log_uniform(1e-3, 1e3);
        CAPTURE(step);
        // One pass each, so that both solve the same equations.
        const auto solve = [&](double tolerance) {
            thermal_network::params settings;
            settings.passes = 1;
            settings.tolerance = tolerance;
            std::vector<double> t = n.temperature;
            std::vector<particle_step<double>> taken;
            const auto report = thermal_network(settings).advance(n.pairs, n.baths, n.mass, caloric_of,
                                                                  tssm_per_particle(678.0, n.factor), step, t, taken);
            REQUIRE(report.converged);
            CHECK(imbalance(n, taken, caloric_of) <= 1e-12);
            return std::pair(t, report.error);
        };
        const auto exact = solve(1e-16).first;
        for (const double tolerance : {1e-2, 1e-5, 4e-10}) {
            CAPTURE(tolerance);
            const auto [t, error] = solve(tolerance);
            // In the stiffest of them round-off of the residuals holds the bound above the tightest tolerance; it stays a bound.
            CHECK(error <= (tolerance > 1e-9 ? 1 : 4) * tolerance * (n.high - n.low));
            // The shift that closes the energy moves a whole island by no more than the bound; round-off of 2500 K.
            CHECK(distance(t, exact) <= 2 * error + 1e-10);
        }
    }
}

TEST_CASE("thermal network: the order of the list does not matter, nor which of a pair comes first") {
    const constant_specific_heat<> caloric{1000};
    const auto caloric_of = [&](std::size_t) { return caloric; };
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        const network n = random_network(seed, seed % 2 == 0);
        const double step = seeded(seed + 3000).log_uniform(1e-3, 1e3);
        CAPTURE(step);
        std::vector<thermal_pair> shuffled = n.pairs;
        seeded random(seed + 4000);
        for (std::size_t k = shuffled.size(); k > 1; --k) {
            std::swap(shuffled[k - 1], shuffled[random.index(k)]);
            if (random.uniform(0, 1) < 0.5) std::swap(shuffled[k - 1].first, shuffled[k - 1].second);
        }
        thermal_network::params settings;
        settings.passes = 1;  // two differ by what the rough first one leaves
        const auto solve = [&](const std::vector<thermal_pair>& pairs) {
            std::vector<double> t = n.temperature;
            std::vector<particle_step<double>> taken;
            const auto report = thermal_network(settings).advance(pairs, n.baths, n.mass, caloric_of,
                                                                  tssm_per_particle(678.0, n.factor), step, t, taken);
            REQUIRE(report.converged);
            CHECK(imbalance(n, taken, caloric_of) <= 1e-12);
            return std::pair(t, report.error);
        };
        const auto [in_order, first_error] = solve(n.pairs);
        const auto [out_of_order, second_error] = solve(shuffled);
        // Each is as near the one solution as it says, and moved by its own error once more to close the energy;
        // round-off of 2500 K.
        CHECK(distance(in_order, out_of_order) <= 2 * (first_error + second_error) + 1e-10);
    }
}

TEST_CASE("thermal network: the same input gives the same bits, also from a used solver") {
    const network n = random_network(77, false);
    const constant_specific_heat<> caloric{900};
    const auto caloric_of = [&](std::size_t) { return caloric; };
    std::vector<particle_step<double>> taken;
    thermal_network fresh, used;
    std::vector<double> a = n.temperature, b = n.temperature, other(3, 400.0);
    used.advance(std::vector<thermal_pair>{{0, 2, {0.1, 0.0}}}, std::vector<heat_bath<double>>(3),
                 std::vector<double>(3, 1.0), caloric_of, unsplit{}, 1.0, other, taken);
    fresh.advance(n.pairs, n.baths, n.mass, caloric_of, tssm(50.0), 3.0, a, taken);
    used.advance(n.pairs, n.baths, n.mass, caloric_of, tssm(50.0), 3.0, b, taken);
    CHECK(a == b);
}

TEST_CASE("thermal network: nothing to do is done") {
    const constant_specific_heat<> caloric{900};
    const auto caloric_of = [&](std::size_t) { return caloric; };
    std::vector<particle_step<double>> taken;
    std::vector<double> none;
    thermal_network solver;
    CHECK(solver.advance(std::vector<thermal_pair>{}, {}, none, caloric_of, unsplit{}, 1.0, none, taken).converged);
    CHECK(taken.empty());
    // All at one temperature, and alone.
    std::vector<double> same(4, 333.25);
    const auto report = solver.advance(std::vector<thermal_pair>{{0, 1, {1.0, 0.0}}}, std::vector<heat_bath<double>>(4),
                                       std::vector<double>(4, 1.0), caloric_of, unsplit{}, 1.0, same, taken);
    CHECK(report.converged);
    for (const double t : same) CHECK(t == 333.25);
}

TEST_CASE("thermal network: bad input is named and changes nothing") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    struct input {
        std::vector<thermal_pair> pairs{{0, 1, {0.1, 1e-12}}};
        std::vector<heat_bath<double>> baths{2};
        std::vector<double> mass{1.0, 1.0}, temperature{300.0, 400.0}, factor{1.0, 1.0};
        double specific_heat = 900, step = 1;
    };
    const auto refused = [](const input& in, const char* place, std::int64_t index) {
        CAPTURE(place);
        input copy = in;
        std::vector<particle_step<double>> taken{{1, 2, 3, 4}};
        try {
            thermal_network().advance(
                copy.pairs, copy.baths, copy.mass,
                [&](std::size_t) { return constant_specific_heat<>{in.specific_heat}; },
                tssm_per_particle(1.0, copy.factor), copy.step, copy.temperature, taken);
            FAIL_CHECK("accepted");
        } catch (const bad_value& error) {
            CHECK(error.place == place);
            CHECK(error.index == index);
        }
        for (std::size_t i = 0; i < in.temperature.size(); ++i)
            CHECK((copy.temperature[i] == in.temperature[i] || std::isnan(in.temperature[i])));
        CHECK(taken.size() == 1);
        CHECK(taken[0].radiated == 4);
    };
    for (const double bad : {nan, infinite, 0.0, -1.0}) {
        input in;
        in.temperature[1] = bad;
        refused(in, "temperature of particle", 1);
        in = {};
        in.mass[0] = bad;
        refused(in, "mass of particle", 0);
        in = {};
        in.specific_heat = bad;
        refused(in, "specific_heat of particle", 0);
        in = {};
        in.step = bad;
        refused(in, "step", bad_value::no_index);
        in = {};
        in.factor[1] = bad;
        refused(in, "acceleration_factor", 1);
    }
    for (const double bad : {nan, infinite, -1.0}) {
        input in;
        in.pairs[0].link.conductance = bad;
        refused(in, "conductance of pair", 0);
        in = {};
        in.pairs[0].link.radiation = bad;
        refused(in, "radiation of pair", 0);
        in = {};
        in.baths[1].conductance = bad;
        refused(in, "bath conductance of particle", 1);
        in = {};
        in.baths[1].radiation_times_t4 = bad;
        refused(in, "bath radiation times T^4 of particle", 1);
    }
    for (const std::int32_t bad : {-1, 0, 2}) {
        input in;
        in.pairs[0].second = bad;
        refused(in, "second particle of pair", 0);
    }
    input in;
    in.baths.resize(3);
    refused(in, "number of baths", bad_value::no_index);
    in = {};
    in.mass.resize(1);
    refused(in, "number of masses", bad_value::no_index);
    in = {};
    in.factor[0] = 0.5;
    refused(in, "acceleration_factor", 0);

    const auto settings = [](auto set) {
        thermal_network::params p;
        set(p);
        return p;
    };
    CHECK_THROWS_AS(thermal_network(settings([](auto& p) { p.passes = 0; })), bad_value);
    CHECK_THROWS_AS(thermal_network(settings([](auto& p) { p.iterations = 0; })), bad_value);
    CHECK_THROWS_AS(thermal_network(settings([](auto& p) { p.tolerance = 0; })), bad_value);
    CHECK_THROWS_AS(thermal_network(settings([](auto& p) { p.caloric_passes = -1; })), bad_value);
}

}  // namespace
