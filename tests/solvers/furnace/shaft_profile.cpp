// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <hearth/furnace/sensitivities.hpp>
#include <hearth/furnace/shaft_profile.hpp>
#include <hearth/furnace/spinel.hpp>

using namespace hearth::furnace;

TEST_CASE("spinel: the enthalpy is the integral of the specific heat, and its inverse") {
    CHECK(spinel::specific_heat(298.15) == doctest::Approx(815).epsilon(2e-3));  // calorimetry, 115.9 to 116.2 J/(mol K)
    for (double t = 250; t < 2500; t += 50) {
        const double step = 0.01;
        const double slope = (spinel::enthalpy(t + step) - spinel::enthalpy(t - step)) / (2 * step);
        // central difference: second order in the step, and the round-off of enthalpies near 3e6 over 0.02 K
        CHECK(slope == doctest::Approx(spinel::specific_heat(t)).epsilon(1e-7));
        CHECK(spinel::temperature(spinel::enthalpy(t)) == doctest::Approx(t).epsilon(1e-13));
    }
}

TEST_CASE("shaft profile: the paper's furnace lands where the paper says") {
    const shaft_profile fine = solve_shaft_profile(settings{}, 4000);
    REQUIRE(fine.converged);
    // Heat that enters by fuel leaves by wall, off-gas and product: a Newton step of 1e-6 K of 1e3 W/K each, over 0.6 MW.
    CHECK(std::abs(fine.enthalpy_imbalance) < 1e-9);
    // 2243 K, 67 kPa and 120 to 300 W/(m^2 K) in the paper; burner flow and void fraction are assumed, so a band.
    CHECK(fine.peak_particle_temperature == doctest::Approx(2243).epsilon(0.02));
    CHECK(fine.peak_height == doctest::Approx(8).epsilon(0.02));
    CHECK(fine.pressure_drop == doctest::Approx(67e3).epsilon(0.1));
    const auto [least, most] =
        std::minmax_element(fine.heat_transfer_coefficient.begin(), fine.heat_transfer_coefficient.end());
    CHECK(*least > 110);
    CHECK(*most < 310);
    // First order in the height of the cells: each halving halves the error.
    const double peaks[] = {solve_shaft_profile(settings{}, 1000).peak_particle_temperature,
                            solve_shaft_profile(settings{}, 2000).peak_particle_temperature, fine.peak_particle_temperature};
    CHECK((peaks[1] - peaks[0]) / (peaks[2] - peaks[1]) == doctest::Approx(2).epsilon(0.2));
}

TEST_CASE("shaft profile: without burners nothing leaves the range of what enters") {
    settings scene;
    scene.burners.count = 0;
    const shaft_profile cold = solve_shaft_profile(scene, 200);
    REQUIRE(cold.converged);
    for (const double t : cold.particle_temperature) CHECK(t >= 300 - 1e-6);
    for (const double t : cold.particle_temperature) CHECK(t <= 320 + 1e-6);  // the ambient of the walls
    scene.shaft.zones.clear();
    scene.air.temperature = 900;
    const shaft_profile heated = solve_shaft_profile(scene, 200);
    REQUIRE(heated.converged);
    for (std::size_t k = 0; k < heated.height.size(); ++k) {
        CHECK(heated.particle_temperature[k] >= 300 - 1e-6);
        CHECK(heated.particle_temperature[k] <= 900 + 1e-6);
        CHECK(heated.gas_temperature[k] >= heated.particle_temperature[k] - 1e-6);  // heat flows from gas to stones
    }
}

TEST_CASE("shaft profile: isothermal pressure drop of an ideal gas is Ergun's, integrated exactly") {
    settings scene;
    scene.burners.count = 0;
    scene.shaft.zones.clear();
    scene.particles.sizes = {{18e-3, 1.0}};
    const shaft_profile profile = solve_shaft_profile(scene, 1000);
    REQUIRE(profile.converged);
    // With rho = p M / (R T): d(p^2)/dz = -2 (R T / M)(a G + b G^2), a and b Ergun's two factors.
    const double molar_mass = 0.21 * 0.0319988 + 0.79 * 0.0280134, t = 300, e = scene.bed.void_fraction, d = 18e-3;
    const double mu = 1.716e-5 * std::pow(t / 273.15, 1.5) * (273.15 + 110.4) / (t + 110.4);
    const double section = 3.14159265358979 / 4 * 0.85 * 0.85;
    const double flux = scene.air.volume_flow * 101325 / (8.31446261815324 * 273.15) * molar_mass / section;
    const double a = 150 * (1 - e) * (1 - e) * mu / (e * e * e * d * d), b = 1.75 * (1 - e) / (e * e * e * d);
    const double top = scene.gas.pressure;
    const double bottom = std::sqrt(top * top + 2 * 10 * 8.31446261815324 * t / molar_mass * (a * flux + b * flux * flux));
    // The model has the gas's weight as well, at most 1.4 kg/m^3 over 10 m.
    CHECK(profile.pressure_drop >= bottom - top);
    CHECK(profile.pressure_drop <= bottom - top + 1.4 * 9.81 * 10);
}

TEST_CASE("shaft profile: fuel that cannot burn is refused") {
    settings scene;
    scene.burners.equivalence_ratio = 5;
    scene.air.volume_flow = 0.01;
    CHECK_THROWS_AS(solve_shaft_profile(scene, 100), bad_scene);
}

TEST_CASE("shaft profile: its answers to single inputs are those of the physics") {
    const shaft_profile base = solve_shaft_profile(settings{});
    const auto all = sensitivities(settings{});
    const auto of = [&](const std::string& input) -> const sensitivity& {
        return *std::find_if(all.begin(), all.end(), [&](const sensitivity& s) { return s.input.rfind(input, 0) == 0; });
    };
    for (const sensitivity& s : all) {
        CAPTURE(s.input);
        CHECK(s.less.converged);
        CHECK(s.more.converged);
    }
    CHECK(of("burner flow").more.peak_particle_temperature > of("burner flow").less.peak_particle_temperature);
    CHECK(of("loss of the wall").less.wall_heat_loss == 0);
    CHECK(of("loss of the wall").more.peak_particle_temperature < base.peak_particle_temperature);
    // Ergun: (1 - e)/e^3 and (1 - e)^2/e^3 over the total, compressible drop, some 7 % per 0.01: 0.02 either way is 28 % of it.
    const double span = (of("void fraction").less.pressure_drop - of("void fraction").more.pressure_drop) / base.pressure_drop;
    CHECK(span > 0.2);
    CHECK(span < 0.4);
    // 3 % of the air more take away the heat that 3 % fewer solids would leave: one goes up where the other goes down.
    CHECK((of("flow of secondary air").more.solids_outlet_temperature < base.solids_outlet_temperature));
    CHECK((of("flow of solids").more.solids_outlet_temperature > base.solids_outlet_temperature));
    CHECK((of("flow of solids").more.offgas_temperature < base.offgas_temperature));
}

TEST_CASE("shaft profile: the shift to steady leads to the steady state, from anywhere, and from there nowhere") {
    const settings scene;
    constexpr int cells = 400;
    const shaft_profile steady = solve_shaft_profile(scene, cells);
    REQUIRE(steady.converged);
    // Newton's last step of both is below 1e-6 K; the slow mode makes it a thousand times as much where balances miss round-off.
    for (const double kelvin : shift_to_steady(scene, steady.particle_temperature, std::vector<double>(cells, 0.0))) CHECK(std::abs(kelvin) < 1e-5);
    // Walls that lose more: the old temperatures store what those walls take, less than nothing.  The model of the old walls knows
    // nothing of that, so it only leads near the new steady state, and the nearer the less there is to do.
    settings other = scene;
    other.shaft.zones[0].transmittance = 3.3;
    const shaft_profile wanted = solve_shaft_profile(other, cells);
    std::vector<double> taken;
    for (const double t : steady.particle_temperature) taken.push_back(-0.3 * 3.14159265358979 * scene.shaft.diameter * (t - 320));
    const std::vector<double> known = shift_to_steady(other, steady.particle_temperature, taken), unknown = shift_to_steady(scene, steady.particle_temperature, taken);
    REQUIRE(known.size() == cells);
    REQUIRE(unknown.size() == cells);
    double most = 0;
    for (std::size_t k = 0; k < cells; ++k) most = std::max(most, std::abs(wanted.particle_temperature[k] - steady.particle_temperature[k]));
    for (std::size_t k = 0; k < cells; ++k) {
        CHECK(steady.particle_temperature[k] + known[k] == doctest::Approx(wanted.particle_temperature[k]).epsilon(1e-8));
        CHECK(std::abs(steady.particle_temperature[k] + unknown[k] - wanted.particle_temperature[k]) < 0.2 * most);
    }
}
