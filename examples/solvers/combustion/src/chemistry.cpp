// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <hearth/combustion/chemistry.hpp>
#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/mixing.hpp>
#include <hearth/combustion/thermo.hpp>
#include <hearth/core/error.hpp>

#include "require.hpp"

namespace hearth::combustion {
namespace {

constexpr double negative_allowed = 1e-9;
constexpr double sum_allowed = 1e-6;

void check(const chemistry& settings, double dt, const cell_arrays& cells) {
    require_duration("dt", dt);
    require_mechanism(settings.mechanism);
    require_tolerance(settings.accuracy);
    require(settings.ignition_temperature >= 0, "ignition_temperature", settings.ignition_temperature, ">= 0 [K]");

    for (std::size_t i = 0; i < cells.count; ++i) {
        const auto cell = static_cast<std::int64_t>(i);
        const double t = cells.temperature[i], p = cells.pressure[i];
        require(temperature_limits().contains(t), "temperature of cell", t, "200 to 6000 [K]", cell);
        require(p > 0 && std::isfinite(p), "pressure of cell", p, "finite and > 0 [Pa]", cell);
        double whole = 0;
        for (std::size_t k = 0; k < species_count; ++k) {
            const double y = cells.mass_fraction[k][i * cells.stride];
            if (!(y >= -negative_allowed))
                throw bad_value(std::string("mass fraction of ") + species_names[k] + " in cell", cell, y,
                                ">= -1e-9 [-]");
            whole += y;
        }
        require(std::fabs(whole - 1) <= sum_allowed, "sum of mass fractions in cell", whole, "1 within 1e-6 [-]", cell);
        if (cells.mixing_time)
            require(cells.mixing_time[i] >= 0, "mixing time of cell", cells.mixing_time[i], ">= 0 [s]", cell);
    }
}

/// Largest allowed temperature below which a rising function is not positive.
template <class Function>
double highest_without(const Function& f) {
    double lo = temperature_limits().lo, hi = temperature_limits().hi;
    if (f(lo) > 0) return lo;
    while (hi - lo > 0.5) {
        const double middle = 0.5 * (lo + hi);
        (f(middle) > 0 ? hi : lo) = middle;
    }
    return lo;
}

/// Whether a cell can react, from comparisons alone.
class reactivity {
  public:
    reactivity(const chemistry& settings, double dt, const cell_arrays& cells) {
        const auto pressures = std::minmax_element(cells.pressure, cells.pressure + cells.count);
        if (settings.kind != chemistry::model::finite_rate) {
            frozen_below_ = settings.ignition_temperature;
            inert_products_below_ = settings.kind == chemistry::model::equilibrium ? settings.ignition_temperature
                                                                                   : temperature_limits().hi + 1;
            return;
        }
        const double accuracy = settings.accuracy.absolute;
        trace_ = accuracy / molar_mass[CO2];  // a kilogram holds at least as many moles as one of CO2
        const jones_lindstedt& m = settings.mechanism;
        frozen_below_ = highest_without([&](double t) {
            const rate_constants k = rate_constants_at(m, t, *pressures.second);
            const bool b = m.variant == jones_lindstedt::hydrogen_step::b;
            const double third = b ? 1 + k.hydrogen_back * std::pow(m.regularisation, -0.75)
                                   : (1 + k.hydrogen_back / std::sqrt(m.regularisation)) / m.water_seed;
            return (k.forward[0] + k.forward[1] + third * k.forward[2] + (1 + k.shift_back) * k.forward[3]) * dt -
                   1e-3 * accuracy;
        });
        // Products dissociate into at most x of H2 or CO, with x sqrt(x/2) = 1/K.
        inert_products_below_ = highest_without([&](double t) {
            const rate_constants k = rate_constants_at(m, t, *pressures.first);
            return std::pow(std::sqrt(2.0) * k.hydrogen_back * std::max(1.0, k.shift_back), 2.0 / 3) - accuracy;
        });
    }

    bool operator()(const cell_arrays& cells, std::size_t i) const {
        const double t = cells.temperature[i];
        if (t < frozen_below_) return false;
        const auto amount = [&](species k) { return cells.mass_fraction[k][i * cells.stride] / molar_mass[k]; };
        const double products = amount(H2O) + amount(CO2);
        if (amount(CH4) + amount(CO) + amount(H2) > trace_) return amount(O2) + products > trace_;
        return t >= inert_products_below_ && products > trace_;
    }

  private:
    double frozen_below_ = 0, inert_products_below_ = 0, trace_ = 0;
};

/// The state of a cell after dt, and what it cost.
mixture_state react(const chemistry& settings, double dt, const per_species& n, double temperature, double pressure,
                    double mixing_time, integration& done) {
    if (settings.kind == chemistry::model::finite_rate) {
        double share = 1;
        if (mixing_time > 0)
            share = reacting_fraction(chemical_time(settings.mechanism, temperature, pressure, mole_fractions(n)),
                                      mixing_time);
        // The share is constant and the equations autonomous: rates times a share are the same as a shorter time.
        reactor gas(settings.mechanism, n, temperature, pressure);
        extents e{};
        done = integrate(gas, e, share * dt, settings.accuracy);
        mixture_state out{gas.amount(e), 0};
        for (double& a : out.amount) a = std::max(a, 0.0);  // within round-off of zero, as integrate promises
        out.temperature = combine(out.amount).temperature(gas.enthalpy(), gas.temperature());
        return out;
    }
    const double enthalpy = combine(n).enthalpy(temperature);
    mixture_state out = settings.kind == chemistry::model::equilibrium ? equilibrium(n, enthalpy, pressure, temperature)
                                                                       : burn(n, enthalpy);
    if (mixing_time > 0) {
        const double share = -std::expm1(-dt / mixing_time);
        for (std::size_t k = 0; k < species_count; ++k) out.amount[k] = n[k] + share * (out.amount[k] - n[k]);
        out.temperature = combine(out.amount).temperature(enthalpy, temperature);
    }
    return out;
}

/// Computes all cells, checked before, that can react; store(cell, before, after) takes the results, of non-negative
/// mass fractions.
template <class Store>
chemistry_report run(const chemistry& given, double dt, const cell_arrays& cells, const Store& store) {
    chemistry_report report;
    if (cells.count == 0 || dt == 0) return report;
    chemistry settings = given;
    settings.mechanism.regularisation = std::max(given.mechanism.regularisation, given.accuracy.absolute);
    const reactivity can_react(settings, dt, cells);
    for (std::size_t i = 0; i < cells.count; ++i) {
        if (!can_react(cells, i)) continue;
        ++report.reacting;
        per_species before;
        for (std::size_t k = 0; k < species_count; ++k)
            before[k] = std::max(cells.mass_fraction[k][i * cells.stride], 0.0);
        const per_species n = amounts(before);
        const double temperature = cells.temperature[i];
        integration done;
        const mixture_state after = react(settings, dt, n, temperature, cells.pressure[i],
                                          cells.mixing_time ? cells.mixing_time[i] : 0.0, done);
        report.steps += done.steps;
        report.rejected += done.rejected;
        report.limited += done.limited;
        report.error = std::max(report.error, done.error);
        if (!done.finished) {
            if (report.failed++ == 0) report.first_failed = static_cast<std::int64_t>(i);
            continue;
        }
        if (after.temperature > nasa7::limits().hi) ++report.extrapolated;

        const per_element had = element_amounts(n), has = element_amounts(after.amount);
        const double all = had[carbon] + had[hydrogen] + had[oxygen] + had[nitrogen];
        for (std::size_t e = 0; e < element_count; ++e)
            report.element_imbalance = std::max(report.element_imbalance, std::fabs(has[e] - had[e]) / all);
        const nasa7 mixture = combine(n);
        const double change = combine(after.amount).enthalpy(after.temperature) - mixture.enthalpy(temperature);
        report.enthalpy_imbalance =
            std::max(report.enthalpy_imbalance, std::fabs(change) / (mixture.heat_capacity(temperature) * temperature));
        store(i, before, after);
    }
    return report;
}

}  // namespace

chemistry_report advance(const chemistry& settings, double dt, const cell_arrays& cells) {
    check(settings, dt, cells);
    return run(settings, dt, cells, [&](std::size_t i, const per_species&, const mixture_state& after) {
        for (std::size_t k = 0; k < species_count; ++k) {
            const double residue = std::min(cells.mass_fraction[k][i * cells.stride], 0.0);
            cells.mass_fraction[k][i * cells.stride] = after.amount[k] * molar_mass[k] + residue;
        }
        cells.temperature[i] = after.temperature;
    });
}

chemistry_report mean_rates(const chemistry& settings, double dt, const cell_arrays& cells,
                            const std::array<double*, species_count>& rate) {
    check(settings, dt, cells);
    for (std::size_t k = 0; k < species_count; ++k)
        for (std::size_t i = 0; i < cells.count; ++i) rate[k][i * cells.stride] = 0;
    return run(settings, dt, cells, [&](std::size_t i, const per_species& before, const mixture_state& after) {
        for (std::size_t k = 0; k < species_count; ++k)
            rate[k][i * cells.stride] = (after.amount[k] * molar_mass[k] - before[k]) / dt;
    });
}

}  // namespace hearth::combustion
