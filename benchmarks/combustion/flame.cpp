// SPDX-License-Identifier: MIT
//
// Error against run time of a flame inside a bed: burn-out and peak temperature by the step along the flow and by the
// tolerance of the chemistry.  Cold premixed methane and air flow into spheres of 1800 K; reaction and exchange of heat
// are split after Strang, PaSR with the bed's mixing time.  The reference has the finest of both.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <hearth/combustion/chemistry.hpp>
#include <hearth/combustion/mixing.hpp>

#include "support/counters.hpp"

using namespace hearth::combustion;

namespace {

struct flame {
    double burnt_at, peak;
};  // [m], 99 % of the fuel gone; [K]

flame burn_in_bed(double step, double accuracy) {
    constexpr double void_fraction = 0.4, diameter = 0.01775, flux = 1.63, pressure = 1.05e5, spheres = 1800,
                     exchange = 1.2e6;
    const per_species fresh = amounts_from_moles({1, 2, 7.52, 0, 0, 0, 0});
    std::array<double, species_count> y = mass_fractions(fresh);
    double temperature = 300, mixing_time = 0, fuel = y[CH4];
    cell_arrays cell{1, &pressure, &temperature, {}, 1, &mixing_time};
    for (std::size_t k = 0; k < species_count; ++k) cell.mass_fraction[k] = &y[k];
    chemistry settings;
    settings.accuracy = {accuracy, 1e-2 * accuracy};
    flame found{0, 0};
    const double first = y[CH4];
    const int steps = static_cast<int>(std::lround(0.1 / step));
    for (int i = 0; i < steps; ++i) {
        const double density = pressure / (gas_constant * temperature * sum(amounts(y)));
        const double speed = flux / (density * void_fraction);
        mixing_time = mixing_model::bed_time(1 - void_fraction, diameter, speed);
        // exchange [W/(m^3 K)]: that of Gunn at these conditions, about
        bool done = advance(settings, 0.5 * step / speed, cell).failed == 0;
        const double units = exchange * step / (flux * combine(amounts(y)).heat_capacity(temperature));
        temperature += (spheres - temperature) * -std::expm1(-units);
        done = advance(settings, 0.5 * step / speed, cell).failed == 0 && done;
        if (!done) return {std::nan(""), std::nan("")};
        const double before = fuel / first, now = y[CH4] / first;
        if (now > 0.01)
            found.burnt_at = (i + 1) * step;
        else if (before > 0.01)
            found.burnt_at += step * std::log(before / 0.01) / std::log(before / std::max(now, 1e-300));
        fuel = y[CH4];
        found.peak = std::max(found.peak, temperature);
    }
    return found;
}

const flame& reference() {
    static const flame f = burn_in_bed(5e-6, 1e-7);
    return f;
}

void add(const std::string& family, const std::string& parameter, double step, double accuracy) {
    for (const bool of_length : {true, false})
        benchmark::RegisterBenchmark(
            (family + (of_length ? "/burn-out length/" : "/peak temperature/") + parameter).c_str(),
            [=](benchmark::State& state) {
                const flame best = reference();
                flame f{};
                for (auto _ : state) f = burn_in_bed(step, accuracy);
                bench::set_error(
                    state, of_length ? std::abs(f.burnt_at / best.burnt_at - 1) : std::abs(f.peak / best.peak - 1));
            })
            ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
    for (const char* s : {"1e-3", "5e-4", "2e-4", "1e-4", "5e-5"})
        add("flame in a bed by step", std::string("step:") + s, std::strtod(s, nullptr), 1e-5);
    for (const char* t : {"1e-1", "1e-2", "1e-3", "1e-4", "1e-5"})
        add("flame in a bed by chemistry tolerance", std::string("tolerance:") + t, 5e-6, std::strtod(t, nullptr));
    return true;
}();

}  // namespace
