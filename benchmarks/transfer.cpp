// SPDX-License-Identifier: MIT
// Conduction and radiation between particles with neighbours to 2.5 diameters: time per pair and step.
// Error: of the heat rates against T^4 differences in long double, over the largest rate; of an implicit step, the heat
// that is not accounted for over what moved.
#include <cmath>
#include <vector>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>

#include "support/counters.hpp"
#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

/// 10 648 spheres on a shaken lattice of solid fraction 0.6, neighbours to 2.5 diameters.
const warm_bed& bed() {
    static const warm_bed made = [] {
        const int side = 22;
        const double d = 0.018, spacing = d * std::cbrt(constants<double>::pi() / 6 / 0.6);
        warm_bed b(static_cast<std::size_t>(side * side * side));
        seeded random(1);
        for (int i = 0; i < side * side * side; ++i) {
            const int place[3] = {i % side, i / side % side, i / side / side};
            for (std::size_t a = 0; a < 3; ++a)
                b.position[warm_bed::at(i)][a] = (place[a] + random.uniform(-0.1, 0.1)) * spacing;
            b.radius[warm_bed::at(i)] = d / 2;
            b.temperature[warm_bed::at(i)] = random.uniform(300, 2300);
        }
        for (int i = 0; i < side * side * side; ++i)
            for (int z = 0; z <= 3; ++z)
                for (int y = -3; y <= 3; ++y)
                    for (int x = -3; x <= 3; ++x) {
                        const int px = i % side + x, py = i / side % side + y, pz = i / side / side + z;
                        const int j = px + side * (py + side * pz);
                        if (px < 0 || px >= side || py < 0 || py >= side || pz >= side || j <= i) continue;
                        double square = 0;
                        for (std::size_t a = 0; a < 3; ++a)
                            square += std::pow(b.position[warm_bed::at(j)][a] - b.position[warm_bed::at(i)][a], 2);
                        if (square < 6.25 * d * d) b.near.push_back({i, j, std::sqrt(square)});
                    }
        return b;
    }();
    return made;
}

const auto& kiln() {
    static const scene made{conduction{closure::zhang::constriction{}},
                            radiation{closure::feng_han::monte_carlo_fit{}}};
    return made;
}
double no_wall(int) { return 300; }

double rate_error(const std::vector<double>& heat) {
    using exactly = long double;
    const auto list = kiln().links(bed(), bed());
    std::vector<exactly> exact(heat.size(), 0.0L);
    const std::vector<exactly> t(bed().temperature.begin(), bed().temperature.end());
    const auto fourth = [](exactly x) { return x * x * x * x; };
    for (const auto& pair : list.pairs) {
        const auto a = warm_bed::at(pair.first), b = warm_bed::at(pair.second);
        const exactly q = static_cast<exactly>(pair.link.conductance) * (t[b] - t[a]) +
                          static_cast<exactly>(pair.link.radiation) * (fourth(t[b]) - fourth(t[a]));
        exact[a] += q;
        exact[b] -= q;
    }
    for (const auto& open : list.surroundings)
        exact[warm_bed::at(open.particle)] +=
            static_cast<exactly>(open.link.radiation) *
            (fourth(static_cast<exactly>(open.temperature)) - fourth(t[warm_bed::at(open.particle)]));
    exactly error = 0, largest = 0;
    for (std::size_t i = 0; i < heat.size(); ++i) {
        error = std::fmax(error, std::fabs(static_cast<exactly>(heat[i]) - exact[i]));
        largest = std::fmax(largest, std::fabs(exact[i]));
    }
    return static_cast<double>(error / largest);
}

void explicit_rates(benchmark::State& state) {
    const auto list = kiln().links(bed(), bed());
    std::vector<double> heat;
    for (auto _ : state) {
        heat.assign(bed().radius.size(), 0.0);
        benchmark::DoNotOptimize(accumulate(list, bed().temperature, no_wall, heat));
    }
    bench::set_error(state, rate_error(heat));
    bench::set_items(state, static_cast<double>(list.pairs.size()));
}

void list_and_rates(benchmark::State& state) {
    std::vector<double> heat;
    auto list = kiln().links(bed(), bed());
    for (auto _ : state) {
        kiln().links(bed(), bed(), no_gas{}, list);
        heat.assign(bed().radius.size(), 0.0);
        benchmark::DoNotOptimize(accumulate(list, bed().temperature, no_wall, heat));
    }
    bench::set_error(state, rate_error(heat));
    bench::set_items(state, static_cast<double>(list.pairs.size()));
}

/// The rival: every pair by its formula in one loop, nothing kept.
void by_hand(benchmark::State& state) {
    const auto& b = bed();
    const closure::feng_han::monte_carlo_fit view_factor{};
    const double scale = 1 / bed_view::within(2.5, 0.6).carried;
    const double emission = constants<double>::stefan_boltzmann() * scale;
    const double modulus =
        closure::hertz::effective_modulus(contact_materials{}.particle, contact_materials{}.particle);
    std::vector<double> heat;
    for (auto _ : state) {
        heat.assign(b.radius.size(), 0.0);
        for (const auto& p : b.near) {
            const auto i = warm_bed::at(p.first), j = warm_bed::at(p.second);
            const double ri = b.radius[i], rj = b.radius[j];
            double link = emission * 4 * constants<double>::pi() * ri * rj *
                          view_factor.view_factor(p.distance / (ri + rj)) * (b.temperature[i] + b.temperature[j]) *
                          (b.temperature[i] * b.temperature[i] + b.temperature[j] * b.temperature[j]);
            const double overlap = ri + rj - p.distance;
            if (overlap > 0)
                link += closure::zhang::constriction::conductance(closure::contact_pair<double>{
                    closure::hertz::contact_radius(b.stiffness * overlap, ri * rj / (ri + rj), modulus),
                    b.stiffness * overlap, b.conductivity[i], b.conductivity[j], ri, rj});
            const double q = link * (b.temperature[j] - b.temperature[i]);
            heat[i] += q;
            heat[j] -= q;
        }
        benchmark::DoNotOptimize(heat.data());
    }
    bench::set_items(state, static_cast<double>(b.near.size()));
}

void implicit_step(benchmark::State& state, double step) {
    const auto list = kiln().links(bed(), bed());
    const auto baths = kiln().baths(bed(), bed(), no_gas{}, list);
    const std::vector<double> mass(bed().radius.size(), 3580 * 4.18879 * std::pow(0.009, 3));
    const constant_specific_heat<> caloric{1000};
    std::vector<particle_step<double>> taken;
    std::vector<double> t;
    thermal_network solver;
    double iterations = 0;
    for (auto _ : state) {
        t = bed().temperature;
        iterations = solver
                         .advance(
                             list.pairs, baths, mass, [&](std::size_t) { return caloric; }, unsplit{}, step, t, taken)
                         .iterations;
    }
    double gained = 0, turnover = 0;
    for (const auto& one : taken) {
        gained += one.heat - one.conducted - one.radiated;
        turnover += std::fabs(one.heat);
    }
    bench::set_error(state, std::fabs(gained) / turnover);
    bench::set_items(state, static_cast<double>(list.pairs.size()));
    state.counters["iterations"] = iterations;
}

const bool registered = [] {
    benchmark::RegisterBenchmark("pairs to 2.5 d/rates from a list", explicit_rates);
    benchmark::RegisterBenchmark("pairs to 2.5 d/list and rates", list_and_rates);
    benchmark::RegisterBenchmark("pairs to 2.5 d/loop by hand", by_hand);
    for (const double step : {1.0, 10.0, 100.0})
        benchmark::RegisterBenchmark(
            ("implicit pairs to 2.5 d/two passes/s:" + std::to_string(static_cast<int>(step))).c_str(), implicit_step,
            step);
    return true;
}();

}  // namespace
