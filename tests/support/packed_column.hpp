// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hearth/time/caloric.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/time/through_flow.hpp>
#include <hearth/time/tssm_error.hpp>
#include <hearth/time/tssm_ledger.hpp>

#include "support/schumann.hpp"

namespace hearth_test {

/// A bed like that of the paper's Fig. 6, per square metre: glass of 10 mm at 300 K meets air of 400 K, void fraction
/// 0.4. Air at 400 K (0.8825 kg/m^3, 1014 J/(kg K)), 0.5 m/s superficial; Gunn at Re 192: Nu 30.35, h = 100.5 W/(m^2
/// K).
struct glass_bed {
    double void_fraction = 0.4;
    double gas_density = 0.8825, gas_heat = 1014;
    double velocity = 0.5;                      ///< superficial [m/s]
    double exchange = 100.5 * 6 * 0.6 / 0.010;  ///< h a [W/(m^3 K)]
    double solid_density = 2500, solid_heat = 840;
    double cold = 300, hot = 400;

    double gas_storage() const { return void_fraction * gas_density * gas_heat; }              // [J/(m^3 K)]
    double solid_storage() const { return (1 - void_fraction) * solid_density * solid_heat; }  // [J/(m^3 K)]
    double capacity_flow() const { return gas_density * velocity * gas_heat; }                 // [W/(m^2 K)]
    double interstitial_velocity() const { return velocity / void_fraction; }
    hearth::tssm_bed at(double x) const { return {gas_storage() / solid_storage(), exchange * x / capacity_flow()}; }

    /// Exact temperature of the solid at x [m] after process time t [s].
    double solid(double x, double t) const {
        const double xi = at(x).transfer_units;
        const double tau = exchange * (t - x / interstitial_velocity()) / solid_storage();
        return cold + (hot - cold) * static_cast<double>(
                                         schumann::solid(static_cast<long double>(xi), static_cast<long double>(tau)));
    }
};

/// A column of such a bed, gas by through_flow, solid by its default integrator, every flux by the clock.
template <class Clock>
class packed_column {
  public:
    packed_column(const glass_bed& bed, const Clock& clock, double length, std::size_t cells)
        : bed_(bed),
          clock_(clock),
          spacing_(length / static_cast<double>(cells)),
          gas_(cells, bed.cold),
          solid_(cells, bed.cold),
          ledger_(clock.gas_storage_factor()) {}

    void advance(double step) {
        const double gas_content = bed_.gas_storage() * spacing_;
        const double mass = (1 - bed_.void_fraction) * bed_.solid_density * spacing_;
        const hearth::constant_specific_heat<> caloric{bed_.solid_heat};
        double inlet = bed_.hot;
        for (std::size_t i = 0; i < gas_.size(); ++i) {
            const double factor = clock_.factor(i);
            const hearth::through_flow<> cell(bed_.capacity_flow(), bed_.exchange * spacing_,
                                              clock_.gas_storage_factor() * gas_content / step, inlet, gas_[i]);
            const auto taken = hearth::etd2_secant::advance(solid_[i], mass, caloric, cell.bath(), factor * step);
            const auto gas = cell.settle(taken.heat / (factor * step));
            ledger_.particle(taken.heat, factor);
            ledger_.gas(gas_content * (gas.mean - gas_[i]));
            solid_[i] = taken.temperature;
            gas_[i] = gas.mean;
            inlet = gas.outlet;
        }
        ledger_.boundary(bed_.capacity_flow() * (bed_.hot - inlet) * step);
    }

    /// Temperature of the solid at x, between the centres of cells linear [K].
    double solid_at(double x) const {
        const double place = x / spacing_ - 0.5;
        const auto i = static_cast<std::size_t>(std::max(0.0, std::min(place, static_cast<double>(solid_.size()) - 2)));
        const double part = place - static_cast<double>(i);
        return solid_[i] * (1 - part) + solid_[i + 1] * part;
    }

    const std::vector<double>& solid() const { return solid_; }
    const std::vector<double>& gas() const { return gas_; }
    const hearth::tssm_ledger& ledger() const { return ledger_; }

  private:
    glass_bed bed_;
    Clock clock_;
    double spacing_;
    std::vector<double> gas_, solid_;
    hearth::tssm_ledger ledger_;
};

/// Largest departure from Schumann's solution at x over a run, K of the 100 K of the inlet's step; `delay` shifts the
/// exact solution to later process times.
template <class Clock>
double largest_error(const glass_bed& bed, const Clock& clock, double x, double step, double process_time,
                     std::size_t cells = 150, double delay = 0) {
    packed_column<Clock> column(bed, clock, 0.15, cells);
    const double process_step = clock.factor(std::size_t{0}) * step;
    double worst = 0;
    const auto steps = static_cast<long>(process_time / process_step + 0.5);
    const long every = std::max(1L, steps / 400);  // the exact solution is the dear part
    for (long n = 1; n <= steps; ++n) {
        column.advance(step);
        if (n % every != 0) continue;
        worst = std::max(worst,
                         std::fabs(column.solid_at(x) - bed.solid(x, static_cast<double>(n) * process_step - delay)));
    }
    return worst;
}

}  // namespace hearth_test
