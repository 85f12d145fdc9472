// SPDX-License-Identifier: MIT
// What is read from the books of past couplings: balances, drifts, and when a run has ended.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "parts.hpp"

namespace hearth::furnace {

double recent_mean(const std::vector<double>& values, std::size_t count, std::size_t back) {
    if (values.size() <= back || count == 0) return 0;
    const std::size_t end = values.size() - back, begin = end > count ? end - count : 0;
    return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(begin), values.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
           static_cast<double>(end - begin);
}

std::size_t furnace::parts::window() const {
    const auto least = static_cast<std::size_t>(std::max(10.0, std::ceil(0.1 * residence_time / process_step))), turn = couplings_of_turn();
    return (least + turn - 1) / turn * turn;
}

double furnace::parts::imbalance(std::size_t back) const {
    return -(recent_mean(past.gas_out, window(), back) + recent_mean(past.solids_out, window(), back) + recent_mean(past.wall, window(), back));
}

/// Elements go with their streams, air and burner gas: what a stream lacks, over what it brings.
double furnace::parts::element_imbalance() const {
    if (gas_report.species.empty()) return 0;
    const auto missing = [](const gas::balance& b) { return b.in + b.source - b.out; };
    const double of_air = missing(gas_report.species[0]), of_burners = missing(gas_report.mass) - of_air;
    const auto over = [](double rest, double flow) { return flow > 0 ? std::abs(rest) / flow : 0.0; };
    return std::max(over(of_air, shaft.air_flow()), over(of_burners, shaft.burner_flow()));
}

double furnace::parts::outlet_temperature(std::size_t back) const {
    const double mass = recent_mean(past.product, window(), back), enthalpy = recent_mean(past.product_enthalpy, window(), back);
    return mass > 0 ? spinel::temperature(enthalpy / mass) : 0;
}

/// Steady: heat that comes leaves, and the outlets stand still.  The peak settles long before (it is not asked).
void furnace::parts::judge() {
    const std::size_t w = window();
    const double scale = std::max(shaft.fuel_power(), 1e3), drift = 500 * scene.time.balance_tolerance;  // 5 K for one percent
    converged = past.gas_out.size() >= 2 * w && std::abs(imbalance()) < scene.time.balance_tolerance * scale &&
                std::abs(recent_mean(past.offgas, w) - recent_mean(past.offgas, w, w)) < drift &&
                std::abs(outlet_temperature() - outlet_temperature(w)) < drift;
    if (couplings < scene.time.couplings) return;
    now = converged || couplings >= 2 * scene.time.couplings ? phase::report : phase::converge;
}

timings furnace::parts::slowest() const {
    timings all = seconds;
    all.each([&](const char*, auto& time) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(time)>>) time = among.max(time);
        else for (double& t : time) t = among.max(t);
    });
    return all;
}

}  // namespace hearth::furnace
