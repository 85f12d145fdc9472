// SPDX-License-Identifier: MIT
// Conduction and radiation between particles with neighbours to 2.5 diameters: time per pair and step.
// Error: of the heat rates against T^4 differences in long double, over the largest rate; of a step, the largest
// difference in K from the same time in small steps of second order.  `imbalance` is the heat that a step does not
// account for, over what moved.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/limits.hpp>
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
        const double d = 0.016, spacing = d * std::cbrt(constants<double>::pi() / 6 / 0.6);
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

/// A bed and what it exchanges in a step: pairs, and baths of gas with 100 W/(m^2 K).
struct heated_bed {
    std::vector<double> temperature;
    std::vector<heat_bath<double>> baths;
    std::vector<double> mass, capacity;
    std::vector<linked_pair<thermal_link<double>>> pairs;

    heated_bed(std::vector<double> start, const std::vector<double>& gas) : temperature(std::move(start)) {
        const auto list = kiln().links(bed(), bed());
        const double d = 2 * bed().radius[0], volume = constants<double>::pi() / 6 * d * d * d;
        pairs = list.pairs;
        baths.resize(temperature.size());
        for (std::size_t i = 0; i < temperature.size(); ++i)
            baths[i].add(conductive_link<double>{100 * constants<double>::pi() * d * d}, gas[i]);
        mass.assign(temperature.size(), 3580 * volume);
        capacity.assign(temperature.size(), 3580 * volume * specific_heat);
    }
    static constexpr double specific_heat = 1000;

    double stable_step() const { return hearth::stable_step::network(pairs, baths, capacity, temperature); }

    void rates(const std::vector<double>& t, std::vector<double>& rate) const {
        rate.assign(t.size(), 0.0);
        for (const auto& pair : pairs) {
            const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
            const double q = pair.link.heat(t[a], t[b]);
            rate[a] += q;
            rate[b] -= q;
        }
        for (std::size_t i = 0; i < t.size(); ++i)
            rate[i] = (rate[i] + baths[i].conductance_times_t - baths[i].conductance * t[i]) / capacity[i];
    }

    /// Explicit, in stable steps; the midpoint rule where it is to be exact.
    std::vector<double> march(double time, double safety, bool midpoint) const {
        const int steps = static_cast<int>(std::ceil(time / (safety * stable_step())));
        const double step = time / steps;
        std::vector<double> t = temperature, rate, middle(t.size());
        for (int n = 0; n < steps; ++n) {
            rates(t, rate);
            if (midpoint) {
                for (std::size_t i = 0; i < t.size(); ++i) middle[i] = t[i] + 0.5 * step * rate[i];
                rates(middle, rate);
            }
            for (std::size_t i = 0; i < t.size(); ++i) t[i] += step * rate[i];
        }
        return t;
    }
};

/// Burning stones of 16 mm, 1500 to 2200 K from end to end, 30 K up and down from stone to stone, gas 100 K hotter.
const heated_bed& burning_bed() {
    static const heated_bed made = [] {
        seeded random(3);
        std::vector<double> start, gas;
        const double height = 22 * std::cbrt(constants<double>::pi() / 6 / 0.6) * 0.016;
        for (const point& x : bed().position) {
            start.push_back(1500 + 700 * x[2] / height + random.uniform(-30, 30));
            gas.push_back(1600 + 700 * x[2] / height);
        }
        return heated_bed(start, gas);
    }();
    return made;
}

/// The same stones thrown together at 300 to 2300 K.
const heated_bed& mixed_bed() {
    static const heated_bed made{bed().temperature, std::vector<double>(bed().temperature.size(), 1500.0)};
    return made;
}

/// Largest difference from the solution by the midpoint rule in eighths of the stable step [K].
double distance_to_exact(const heated_bed& heated, double time, const std::vector<double>& t) {
    static std::map<std::pair<const heated_bed*, double>, std::vector<double>> known;
    std::vector<double>& exact = known[{&heated, time}];
    if (exact.empty()) exact = heated.march(time, 0.125, true);
    double error = 0;
    for (std::size_t i = 0; i < t.size(); ++i) error = std::max(error, std::fabs(t[i] - exact[i]));
    return error;
}

void implicit_step(benchmark::State& state, const heated_bed& heated, int passes, double step) {
    const constant_specific_heat<> caloric{heated_bed::specific_heat};
    const auto caloric_of = [&](std::size_t) -> const auto& { return caloric; };
    thermal_network::params settings;
    settings.passes = passes;
    thermal_network solver(settings);
    thermal_network::report report;
    std::vector<particle_step<double>> taken;
    std::vector<double> t;
    for (auto _ : state) {
        t = heated.temperature;
        report = solver.advance(heated.pairs, heated.baths, heated.mass, caloric_of, unsplit{}, step, t, taken);
    }
    double left = 0, turnover = 0;
    for (const auto& one : taken) {
        left += one.heat - one.conducted - one.radiated;
        turnover += std::fabs(one.heat);
    }
    const auto pairs = static_cast<double>(heated.pairs.size());
    bench::set_error(state, distance_to_exact(heated, step, t));
    bench::set_items(state, pairs);
    // The list once, each pass's links and indices written, and both read by each of the two sweeps of an iteration.
    bench::set_compulsory_bytes(state, pairs * (24.0 + 12.0 * passes + 24.0 * report.iterations));
    state.counters["iterations"] = report.iterations;
    state.counters["imbalance"] = std::fabs(left) / turnover;
    state.SetLabel("K");
}

/// The rival: explicit steps at nine tenths of the largest stable one.
void explicit_steps(benchmark::State& state, const heated_bed& heated, double time) {
    std::vector<double> t;
    for (auto _ : state) {
        t = heated.march(time, 0.9, false);
        benchmark::DoNotOptimize(t.data());
    }
    bench::set_error(state, distance_to_exact(heated, time, t));
    bench::set_items(state, static_cast<double>(heated.pairs.size()));
    state.counters["iterations"] = std::ceil(time / (0.9 * heated.stable_step()));
    state.SetLabel("K");
}

const bool registered = [] {
    benchmark::RegisterBenchmark("pairs to 2.5 d/rates from a list", explicit_rates);
    benchmark::RegisterBenchmark("pairs to 2.5 d/list and rates", list_and_rates);
    benchmark::RegisterBenchmark("pairs to 2.5 d/loop by hand", by_hand);
    const auto implicit = [](const std::string& family, const heated_bed& heated, std::initializer_list<double> steps) {
        for (const double step : steps) {
            const std::string at = "/s:" + std::to_string(static_cast<int>(step));
            for (const int passes : {1, 2, 4})
                benchmark::RegisterBenchmark(
                    (family + "/implicit/passes " + std::to_string(passes) + at).c_str(),
                    [&heated, passes, step](benchmark::State& state) { implicit_step(state, heated, passes, step); });
            benchmark::RegisterBenchmark(
                (family + "/explicit, stable steps" + at).c_str(),
                [&heated, step](benchmark::State& state) { explicit_steps(state, heated, step); });
        }
    };
    implicit("a step of a burning bed", burning_bed(), {6.0, 20.0, 60.0, 150.0});
    implicit("a step of a mixed bed", mixed_bed(), {1.0, 10.0, 100.0});
    return true;
}();

}  // namespace
