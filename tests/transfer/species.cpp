// SPDX-License-Identifier: MIT
#include <cmath>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/closure/gunn.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/drying_step.hpp>
#include <hearth/time/tssm_ledger.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/species.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

using wet_scene = scene<convection<closure::gunn>, drying<closure::gunn>>;
const drying<closure::gunn> water_term{closure::gunn{}};
const wet_scene wet{convection{closure::gunn{}}, water_term};

TEST_CASE("drying: the particle loses Gamma times what the gas gains, and pays the latent heat") {
    warm_bed bed(3);
    gas_samples gas(3);
    bed.moisture = {1e-5, 0.0, 0.0};
    gas.vapour = {0.005, 0.005, 0.2};  // dew point of the last far above 300 K
    const auto books = wet.accumulate(bed, gas, tssm(200));
    CHECK(gas.vapour_rate[0] > 0);
    CHECK(bed.mass_rate[0] == -200 * gas.vapour_rate[0]);
    CHECK(gas.vapour_rate[1] == 0);  // dry
    CHECK(gas.vapour_rate[2] < 0);   // condenses, also on a dry particle
    CHECK(books[1].vapour_to_gas == doctest::Approx(gas.vapour_rate[0] + gas.vapour_rate[2]));
    const double latent = water_term.vapour_enthalpy(300) - water_term.liquid_enthalpy(300);
    CHECK(latent == doctest::Approx(2.4376e6).epsilon(1e-3));  // steam tables at 300 K
    CHECK(bed.heat_rate[0] == doctest::Approx(200 * (-gas.heat_rate[0] - gas.vapour_rate[0] * latent)).epsilon(1e-12));
    CHECK(gas.vapour_enthalpy_rate[0] ==
          doctest::Approx(gas.vapour_rate[0] * water_term.vapour_enthalpy(300)).epsilon(1e-12));
}

/// The bath and the film of particle i at its present place.
template <class Clock>
drying_result<> dry(const warm_bed& bed, const gas_samples& gas, int i, double dry_mass, double step,
                    const Clock& clock) {
    const view<warm_bed> p(bed, i);
    const view<gas_samples> g(gas, i);
    heat_bath<> bath;
    bath.add(static_cast<const convection<closure::gunn>&>(convection{closure::gunn{}}).gas_link(p, g, clock),
             gas.temperature[warm_bed::at(i)]);
    const auto film = water_term.gas_film(p, g, clock);
    return drying_step(
        bed.temperature[warm_bed::at(i)], dry_mass, bed.moisture[warm_bed::at(i)], constant_specific_heat<>{840},
        water_term, bath, [&](double t) { return film.rate(t); }, step);
}

TEST_CASE("drying: a wet particle comes to the wet-bulb temperature, where heat supplied is heat of evaporation") {
    warm_bed bed(1);
    gas_samples gas(1);
    bed.moisture = {1.0};  // never dry
    for (int n = 0; n < 4000; ++n) bed.temperature[0] = dry(bed, gas, 0, 1e-3, 1e3, unsplit{}).temperature;
    const double t = bed.temperature[0];
    // Psychrometric chart: air of 127 C with 5 g/kg has a wet-bulb temperature near 39 C; Le^(2/3) of vapour in air and
    // Gunn's own exponent move it by a few kelvin.
    CHECK(t > 305);
    CHECK(t < 318);
    std::vector<double> conductance;
    wet.gas_conductances(bed, gas, conductance);
    const double rate = water_term.gas_film(view<warm_bed>(bed, 0), view<gas_samples>(gas, 0), unsplit{}).rate(t);
    CHECK(conductance[0] * (400 - t) ==
          doctest::Approx(rate * (water_term.vapour_enthalpy(t) - water_term.liquid_enthalpy(t))).epsilon(1e-6));
}

TEST_CASE("drying: bounded, never below no water, and balanced, for any step and through the boiling point") {
    seeded random(8);
    for (int k = 0; k < 4000; ++k) {
        CAPTURE(k);
        warm_bed bed(1);
        gas_samples gas(1);
        gas.temperature[0] = random.uniform(290, 2200);
        gas.vapour[0] = random.uniform(0, 0.15);
        bed.temperature[0] = random.uniform(290, 370);
        bed.moisture[0] = random.log_uniform(1e-9, 1e-3);
        const double step = random.log_uniform(1e-6, 1e6), before = bed.temperature[0], water = bed.moisture[0];
        const auto after = dry(bed, gas, 0, 1e-3, step, unsplit{});
        REQUIRE(after.moisture >= 0);
        REQUIRE(std::fabs(after.moisture + after.evaporated - water) <= 1e-15 * (water + std::fabs(after.evaporated)));
        REQUIRE(after.temperature > 200);
        REQUIRE(after.temperature < 2200);
        const auto content = [&](double t, double w) { return 1e-3 * 840 * t + w * water_term.liquid_enthalpy(t); };
        const double gained = content(after.temperature, after.moisture) - content(before, water);
        const double given = after.conducted + after.radiated - after.vapour_enthalpy;
        REQUIRE(std::fabs(gained - given) <=
                1e-12 * (content(2200, water) + std::fabs(after.vapour_enthalpy) + std::fabs(after.conducted)));
        // The equation itself: the heat booked is what the bath gives at the final temperature.
        std::vector<double> conductance;
        wet.gas_conductances(bed, gas, conductance);
        const double rate = conductance[0] * (gas.temperature[0] - after.temperature);
        REQUIRE(std::fabs(after.conducted - rate * step) <= 1e-9 * (std::fabs(rate) * step + content(2200, water)) +
                                                                step * conductance[0] * 1e-9 * after.temperature);
    }
}

/// A column of wet particles under a stream of hot air, ten cells of one particle, upwind and implicit gas.
struct drying_column {
    static constexpr std::size_t cells = 10;
    double gamma;
    warm_bed bed{cells};
    gas_samples gas{cells};
    double dry_mass = 1.3e-3, dry_air = 1e-6, flow = 1.2e-4;  // [kg], [kg] per cell, [kg/s]
    std::vector<double> load, enthalpy;                       // of the gas: water and heat per kg of dry air
    tssm_ledger mass, species, heat;

    explicit drying_column(double gamma_)
        : gamma(gamma_), load(cells, 0.005), mass(1 / gamma_), species(1 / gamma_), heat(1 / gamma_) {
        bed.moisture.assign(cells, 3e-5);
        for (std::size_t i = 0; i < cells; ++i) enthalpy.push_back(content(320, load[i]));
    }
    static double content(double t, double x) { return 1010 * (t - 273.15) + x * water_term.vapour_enthalpy(t); }
    static double temperature(double h, double x) {
        double t = 350;
        for (int k = 0; k < 50; ++k) {
            const double slope = (content(t + 0.5, x) - content(t - 0.5, x));
            t -= (content(t, x) - h) / slope;
        }
        return t;
    }

    void advance(double step) {
        const tssm clock(gamma);
        const double s = clock.gas_storage_factor(), inlet_load = 0.005, inlet_heat = content(420, inlet_load);
        double x_in = inlet_load, h_in = inlet_heat;
        for (std::size_t i = 0; i < cells; ++i) {
            gas.temperature[i] = temperature(enthalpy[i], load[i]);
            gas.vapour[i] = load[i] / (1 + load[i]);
            const auto after = dry(bed, gas, static_cast<int>(i), dry_mass, clock.factor(i) * step, clock);
            // What the particle took in its own time, the gas gave once.
            const double vapour = after.evaporated / clock.factor(i);
            const double given = (after.vapour_enthalpy - after.conducted) / clock.factor(i);
            const double stored = s * dry_air, passing = flow * step;
            const double x = (stored * load[i] + passing * x_in + vapour) / (stored + passing);
            const double h = (stored * enthalpy[i] + passing * h_in + given) / (stored + passing);
            for (auto* ledger : {&mass, &species}) {
                ledger->gas(dry_air * (x - load[i]));
                ledger->particle(-after.evaporated, clock.factor(i));
            }
            heat.gas(dry_air * (h - enthalpy[i]));
            heat.particle(dry_mass * 840 * (after.temperature - bed.temperature[i]) +
                              after.moisture * water_term.liquid_enthalpy(after.temperature) -
                              bed.moisture[i] * water_term.liquid_enthalpy(bed.temperature[i]),
                          clock.factor(i));
            bed.temperature[i] = after.temperature;
            bed.moisture[i] = after.moisture;
            load[i] = x_in = x;
            enthalpy[i] = h_in = h;
        }
        for (auto* ledger : {&mass, &species}) ledger->boundary(flow * step * (inlet_load - x_in));
        heat.boundary(flow * step * (inlet_heat - h_in));
    }
};

TEST_CASE("drying: a bed closes its ledgers of mass, species and enthalpy at Gamma 1 and 200, and dries alike") {
    std::vector<double> moisture[2], temperature[2];
    for (const int k : {0, 1}) {
        const double gamma = k == 0 ? 1 : 200;
        CAPTURE(gamma);
        drying_column column(gamma);
        for (int n = 0; n < 1000; ++n) column.advance(0.1 / gamma);
        // Sums of 1e4 booked increments, each to a round-off of what it is the difference of.
        CHECK(column.mass.relative_imbalance() < 1e-11);
        CHECK(column.species.relative_imbalance() < 1e-11);
        CHECK(column.heat.relative_imbalance() < 1e-11);
        moisture[k] = column.bed.moisture;
        temperature[k] = column.bed.temperature;
        CHECK(column.bed.moisture.front() == 0.0);  // dry where the hot gas enters
        CHECK(column.bed.moisture.back() > 1e-6);   // still wet where it leaves
        for (std::size_t i = 0; i + 1 < column.bed.moisture.size(); ++i)
            CHECK(column.bed.moisture[i] <= column.bed.moisture[i + 1]);
    }
    // With the corrected gas storage the two are the same equations in the bed's time.
    for (std::size_t i = 0; i < moisture[0].size(); ++i) {
        CHECK(moisture[1][i] == doctest::Approx(moisture[0][i]).epsilon(1e-6).scale(3e-5));
        CHECK(temperature[1][i] == doctest::Approx(temperature[0][i]).epsilon(1e-6));
    }
}

}  // namespace
