// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <algorithm>
#include <cmath>

#include <hearth/closure/air.hpp>
#include <hearth/combustion/equilibrium.hpp>

namespace hearth::furnace {

using combustion::per_species;

per_species air() {
    per_species parts{};
    parts[combustion::O2] = 0.21;
    parts[combustion::N2] = 0.79;
    return combustion::amounts_from_moles(parts);
}

per_species premix(double equivalence_ratio) {
    per_species parts{};
    parts[combustion::CH4] = equivalence_ratio;
    parts[combustion::O2] = 2;
    parts[combustion::N2] = 2 * 0.79 / 0.21;
    return combustion::amounts_from_moles(parts);
}

namespace {

per_species blend(const per_species& a, const per_species& b, double share) {
    per_species n{};
    for (std::size_t k = 0; k < combustion::species_count; ++k) n[k] = (1 - share) * a[k] + share * b[k];
    return n;
}

/// All methane that finds oxygen is CO2 and H2O.
per_species completely(per_species n) {
    const double fuel = std::min(n[combustion::CH4], 0.5 * n[combustion::O2]);
    n[combustion::CH4] -= fuel;
    n[combustion::O2] -= 2 * fuel;
    n[combustion::CO2] += fuel;
    n[combustion::H2O] += 2 * fuel;
    return n;
}

}  // namespace

mixture::mixture(const per_species& first, const per_species& second, burning how, double pressure)
    : streams_{first, second}, how_(how), pressure_(pressure) {
    for (int s = 0; s < shares; ++s) {
        for (int t = 0; t < temperatures; ++t) {
            const double temperature = coldest + spacing * t;
            const per_species n = burnt(s / (shares - 1.0), temperature);
            enthalpy_.push_back(combustion::combine(n).enthalpy(temperature));
            moles_.push_back(combustion::sum(n));
        }
    }
}

per_species mixture::burnt(double share, double temperature) const {
    const per_species n = blend(streams_[0], streams_[1], share);
    // Below 1000 K the equilibrium of lean gas is complete to 1e-8.
    if (how_ == burning::mixed_is_burnt || (temperature < 1000 && n[combustion::O2] > 2 * n[combustion::CH4])) return completely(n);
    return combustion::equilibrium_at(n, temperature, pressure_);
}

double mixture::cold_enthalpy(int stream, double temperature) const {
    return combustion::combine(streams_[stream]).enthalpy(temperature);
}

double mixture::heating_value() const {
    return cold_enthalpy(1, 298.15) - combustion::combine(completely(streams_[1])).enthalpy(298.15);
}

mixture::place mixture::find(double temperature, const double* y) {
    const double s = std::clamp(y[1], 0.0, 1.0) * (shares - 1), t = std::max(0.0, (temperature - coldest) / spacing);
    const int i = std::min(static_cast<int>(s), shares - 2), j = std::min(static_cast<int>(t), temperatures - 2);
    return {static_cast<std::size_t>(i * temperatures + j), s - i, (temperature - coldest) / spacing - j};
}

double mixture::mix(const std::vector<double>& table, const place& p) {
    const double* low = &table[p.at];
    const double* high = low + temperatures;
    const double a = low[0] + p.part * (low[1] - low[0]), b = high[0] + p.part * (high[1] - high[0]);
    return a + p.share * (b - a);
}

double mixture::density(double pressure, double temperature, const double* y) const {
    return pressure / (combustion::gas_constant * temperature * mix(moles_, find(temperature, y)));
}

double mixture::enthalpy(double temperature, const double* y) const { return mix(enthalpy_, find(temperature, y)); }

double mixture::specific_heat(double temperature, const double* y) const {
    place p = find(temperature, y);
    p.part = 1;
    const double above = mix(enthalpy_, p);
    p.part = 0;
    return (above - mix(enthalpy_, p)) / spacing;
}

double mixture::viscosity(double t, const double*) const { return closure::air::viscosity(t); }

double mixture::conductivity(double t, const double* y) const { return viscosity(t, y) * specific_heat(t, y) / 0.71; }

}  // namespace hearth::furnace
