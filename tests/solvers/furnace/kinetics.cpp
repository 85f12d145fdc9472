// SPDX-License-Identifier: MIT
// Gas that burns at finite rates in the furnace, beside gas that is at equilibrium where it is mixed; and gas that does not burn.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "coarse_column.hpp"

using namespace hearth::furnace;

namespace {

double hottest(const std::vector<double>& t) { return *std::max_element(t.begin(), t.end()); }

furnace burnt_for(settings scene, burning how, int couplings) {
    scene.physics.combustion = how;
    furnace shaft(scene);
    run_couplings(shaft, couplings);
    return shaft;
}

}  // namespace

TEST_CASE("kinetics: finite rates end where equilibrium does, and keep elements, mass and heat") {
    const settings scene = coarse_column();
    const furnace at_once = burnt_for(scene, burning::equilibrium, 8), kinetic = burnt_for(scene, burning::jones_lindstedt, 8);
    const status equilibrium = at_once.now(), rates = kinetic.now();
    CAPTURE(equilibrium.peak_particle_temperature);
    CAPTURE(rates.peak_particle_temperature);
    CAPTURE(equilibrium.maximum_gas_temperature);
    CAPTURE(rates.maximum_gas_temperature);
    // Adiabatic flames: 2246 K with reversible steps as with CO/H2 in equilibrium, 2327 K complete.  In the bed what is between the
    // two kinds ought to be small beside these 81 K.
    CHECK(std::abs(rates.peak_particle_temperature - equilibrium.peak_particle_temperature) < 81.0 / 4);
    const summary books = kinetic.summarise();
    CHECK(*books.element_imbalance < 1e-6);
    CHECK(std::abs(*books.enthalpy_audit) < 1e-3 * rates.fuel_power);
    CHECK(*books.methane_outlet < 1e-3 * 0.0219);  // a thousandth of the fuel, which is 0.0219 of all moles
    CHECK(*books.carbon_monoxide_outlet < 5e-3);
    CHECK(std::abs(*books.oxygen_dry_outlet - 0.1689) < 1e-3);  // as in the column's test, less what CO keeps
    // Elements in every cell: air and methane have no others than these.
    const snapshot seen = kinetic.look();
    for (std::size_t c = 0; c < seen.gas_temperature.size(); ++c) {
        const auto x = [&](const char* gas) { return seen.mole_fraction.at(gas)[c]; };
        const double carbon = x("CH4") + x("CO") + x("CO2"), hydrogen = 4 * x("CH4") + 2 * x("H2") + 2 * x("H2O");
        const double oxygen = 2 * x("O2") + x("CO") + 2 * x("CO2") + x("H2O");
        CHECK(std::abs(hydrogen - 4 * carbon) < 1e-12);
        CHECK(std::abs(oxygen - 0.42 / 0.79 * x("N2")) < 1e-12);
        for (const auto& gas : seen.mole_fraction) CHECK(gas.second[c] >= 0);
        CHECK(std::isfinite(seen.gas_temperature[c]));
    }
}

TEST_CASE("kinetics: the bed's mixing time delays, and loses nothing") {
    settings scene = coarse_column();
    const furnace at_once = burnt_for(scene, burning::jones_lindstedt, 3);
    scene.physics.mixing = gas_mixing::bed;
    const furnace slower = burnt_for(scene, burning::jones_lindstedt, 3);
    CHECK(*slower.summarise().element_imbalance < 1e-6);
    CHECK(slower.now().peak_particle_temperature != at_once.now().peak_particle_temperature);
    CHECK(std::abs(slower.now().peak_particle_temperature - at_once.now().peak_particle_temperature) < 81);
    CHECK(*slower.summarise().methane_outlet < 1e-3);
}

TEST_CASE("kinetics: cold gas does not burn, and nothing in it is NaN") {
    settings scene = coarse_column();
    scene.time.start = start_from::cold;
    scene.gas.ignition_temperature = 300;  // nobody lights it
    const furnace shaft = burnt_for(scene, burning::jones_lindstedt, 4);
    const snapshot seen = shaft.look();
    CHECK(hottest(seen.gas_temperature) < 320 + 1e-6);  // that of the ambient
    for (std::size_t c = 0; c < seen.gas_temperature.size(); ++c) {
        CHECK(std::isfinite(seen.gas_temperature[c]));
        CHECK(std::isfinite(seen.pressure[c]));
        CHECK(seen.mole_fraction.at("CO2")[c] < 1e-12);
    }
    // 7.12 mol/s of burner gas hold 0.71 of CH4; with 24.9 mol/s of air that is 0.0223 of the moles, and all of it leaves.
    CHECK(*shaft.summarise().methane_outlet == doctest::Approx(0.0223).epsilon(0.03));
}

TEST_CASE("kinetics: a bed that is lit burns on its own from a cold start") {
    settings scene = coarse_column();
    scene.time.start = start_from::cold;
    const furnace shaft = burnt_for(scene, burning::jones_lindstedt, 12);
    CHECK(*shaft.summarise().methane_outlet < 0.1 * 0.0223);  // unlit, all of it leaves
    CHECK(shaft.now().peak_particle_temperature > 500);
}

TEST_CASE("kinetics: without combustion the gas has no species, and the plan says so") {
    settings scene = coarse_column();
    scene.physics.combustion = burning::none;
    furnace shaft(scene);
    run_couplings(shaft, 3);
    const status now = shaft.now();
    CHECK(now.fuel_power == 0);
    CHECK(hottest(shaft.look().gas_temperature) < 320 + 1e-6);  // that of the ambient
    const saved_state state = shaft.save();
    CHECK(state.at("gas/mass_fraction").size() == state.at("gas/temperature").size());
    CHECK(shaft.summarise().oxygen_dry_outlet.value() == doctest::Approx(0.21));
    const plan planned = foresee(scene);
    CHECK(std::any_of(planned.left_out.begin(), planned.left_out.end(),
                      [](const plan::omission& o) { return o.because == "physics.combustion" && o.saves.find("species") != std::string::npos; }));
}
