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

double fuel_ratio(const settings& scene) {
    return scene.physics.combustion == burning::none ? 0 : scene.burners.equivalence_ratio;
}

namespace {

/// All methane that finds oxygen is CO2 and H2O.
per_species completely(per_species n) {
    const double fuel = std::min(n[combustion::CH4], 0.5 * n[combustion::O2]);
    n[combustion::CH4] -= fuel;
    n[combustion::O2] -= 2 * fuel;
    n[combustion::CO2] += fuel;
    n[combustion::H2O] += 2 * fuel;
    return n;
}

constexpr double pressure_of_start = 1e5;  // the equilibrium that a run starts from hardly feels it [Pa]

}  // namespace

per_species mixture::unburnt(double share) const {
    per_species n{};
    for (std::size_t k = 0; k < combustion::species_count; ++k)
        n[k] = (1 - share) * streams_[0][k] + share * streams_[1][k];
    return n;
}

double mixture::cold_enthalpy(int stream, double temperature) const {
    return combustion::combine(streams_[stream]).enthalpy(temperature);
}

double mixture::heating_value() const {
    per_species n = streams_[1];
    n[combustion::O2] = std::max(n[combustion::O2], 2 * n[combustion::CH4]);  // rich gas takes the rest from the air
    return combustion::combine(n).enthalpy(298.15) - combustion::combine(completely(n)).enthalpy(298.15);
}

double mixture::viscosity(double t, const double*) const { return closure::air::viscosity(t); }

double mixture::conductivity(double t, const double* y) const { return viscosity(t, y) * specific_heat(t, y) / 0.71; }

burnt_mixture::burnt_mixture(const per_species& first, const per_species& second, burning how, double pressure)
    : mixture(first, second), how_(how), pressure_(pressure), shares_(how == burning::none ? 1 : 65) {
    for (int s = 0; s < shares_; ++s) {
        for (int t = 0; t < temperatures; ++t) {
            const double temperature = coldest + spacing * t;
            const per_species n = burnt(shares_ > 1 ? s / (shares_ - 1.0) : 0, temperature);
            enthalpy_.push_back(combustion::combine(n).enthalpy(temperature));
            moles_.push_back(combustion::sum(n));
        }
    }
}

per_species burnt_mixture::burnt(double share, double temperature) const {
    const per_species n = unburnt(share);
    if (how_ == burning::none) return n;
    // Below 1000 K the equilibrium of lean gas is complete to 1e-8.
    if (how_ == burning::mixed_is_burnt || (temperature < 1000 && n[combustion::O2] > 2 * n[combustion::CH4]))
        return completely(n);
    return combustion::equilibrium_at(n, temperature, pressure_);
}

double burnt_mixture::burner_share(const double* y) const {
    return how_ == burning::none ? 0 : std::clamp(y[1], 0.0, 1.0);
}

per_species burnt_mixture::composition(double temperature, const double* y) const {
    return burnt(burner_share(y), temperature);
}

gas::array<double> burnt_mixture::carried(double share, double, bool) const {
    if (how_ == burning::none) return {1};
    return {1 - share, share};
}

burnt_mixture::place burnt_mixture::find(double temperature, const double* y) const {
    const double t = std::max(0.0, (temperature - coldest) / spacing);
    const int j = std::min(static_cast<int>(t), temperatures - 2);
    const double part = (temperature - coldest) / spacing - j;
    if (shares_ == 1) return {static_cast<std::size_t>(j), 0, part};
    const double s = burner_share(y) * (shares_ - 1);
    const int i = std::min(static_cast<int>(s), shares_ - 2);
    return {static_cast<std::size_t>(i * temperatures + j), s - i, part};
}

double burnt_mixture::mix(const std::vector<double>& table, const place& p) const {
    const double* low = &table[p.at];
    const double* high = shares_ == 1 ? low : low + temperatures;
    const double a = low[0] + p.part * (low[1] - low[0]), b = high[0] + p.part * (high[1] - high[0]);
    return a + p.share * (b - a);
}

double burnt_mixture::density(double pressure, double temperature, const double* y) const {
    return pressure / (combustion::gas_constant * temperature * mix(moles_, find(temperature, y)));
}

double burnt_mixture::enthalpy(double temperature, const double* y) const {
    return mix(enthalpy_, find(temperature, y));
}

double burnt_mixture::specific_heat(double temperature, const double* y) const {
    place p = find(temperature, y);
    p.part = 1;
    const double above = mix(enthalpy_, p);
    p.part = 0;
    return (above - mix(enthalpy_, p)) / spacing;
}

double reacting_mixture::burner_share(const double* y) const { return std::clamp(1 - y[first_share], 0.0, 1.0); }

per_species reacting_mixture::composition(double, const double* y) const {
    using namespace combustion;
    const per_species before = unburnt(burner_share(y));
    const double carbon_atoms = before[CH4], oxygen_atoms = 2 * before[O2];
    double co = std::max(0.0, y[carbon_monoxide] / molar_mass[CO]),
           co2 = std::max(0.0, y[carbon_dioxide] / molar_mass[CO2]);
    double h2o =
        std::clamp(y[water] / molar_mass[H2O], 0.0, 2 * (co + co2));  // hydrogen comes with carbon, four to one
    const double bound_carbon = co + co2, bound_oxygen = co + 2 * co2 + h2o;
    const double scale = std::min({1.0, bound_carbon > carbon_atoms ? carbon_atoms / bound_carbon : 1.0,
                                   bound_oxygen > oxygen_atoms ? oxygen_atoms / bound_oxygen : 1.0});
    co *= scale;
    co2 *= scale;
    h2o *= scale;
    per_species n{};
    n[CO] = co;
    n[CO2] = co2;
    n[H2O] = h2o;
    n[CH4] = std::max(0.0, carbon_atoms - co - co2);
    n[O2] = std::max(0.0, 0.5 * (oxygen_atoms - co - 2 * co2 - h2o));
    n[H2] = std::max(0.0, 2 * (carbon_atoms - n[CH4]) - h2o);
    n[N2] = before[N2];
    return n;
}

gas::array<double> reacting_mixture::carried(double share, double temperature, bool burnt) const {
    gas::array<double> y(carried_count, 0.0);
    y[first_share] = 1 - share;
    if (burnt) {
        const per_species n = combustion::equilibrium_at(unburnt(share), temperature, pressure_of_start);
        y[carbon_monoxide] = n[combustion::CO] * combustion::molar_mass[combustion::CO];
        y[carbon_dioxide] = n[combustion::CO2] * combustion::molar_mass[combustion::CO2];
        y[water] = n[combustion::H2O] * combustion::molar_mass[combustion::H2O];
    }
    y[rest] = share - y[carbon_monoxide] - y[carbon_dioxide] - y[water];
    return y;
}

double reacting_mixture::density(double pressure, double temperature, const double* y) const {
    return pressure / (combustion::gas_constant * temperature * combustion::sum(composition(temperature, y)));
}

double reacting_mixture::enthalpy(double temperature, const double* y) const {
    return combustion::combine(composition(temperature, y)).enthalpy(temperature);
}

double reacting_mixture::specific_heat(double temperature, const double* y) const {
    return combustion::combine(composition(temperature, y)).heat_capacity(temperature);
}

std::shared_ptr<const mixture> make_mixture(const settings& scene) {
    const per_species second = premix(fuel_ratio(scene));
    if (scene.physics.combustion == burning::jones_lindstedt) return std::make_shared<reacting_mixture>(air(), second);
    return std::make_shared<burnt_mixture>(air(), second, scene.physics.combustion, scene.gas.pressure);
}

}  // namespace hearth::furnace
