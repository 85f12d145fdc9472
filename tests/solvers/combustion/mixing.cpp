// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <hearth/combustion/mixing.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

TEST_CASE("mixing: a bed mixes over a pore, a free cell by its turbulence, and the threshold decides") {
    mixing_state cell;
    cell.interstitial_speed = 16;
    cell.particle_diameter = 0.01775;
    cell.effective_viscosity = 4e-3;
    cell.dissipation = 100;
    const mixing_model model{0.1, 0.3};

    cell.solid_fraction = 0.6;
    CHECK(model.time(cell) == doctest::Approx(0.4 * 0.01775 / 16).epsilon(1e-14));  // 0.44 ms in the furnace's bed
    cell.solid_fraction = 0.1;
    CHECK(model.time(cell) == doctest::Approx(0.3 * std::sqrt(4e-3 / 100)).epsilon(1e-14));
    cell.solid_fraction = std::nextafter(0.1, 1.0);
    CHECK(model.time(cell) == doctest::Approx(0.9 * 0.01775 / 16).epsilon(1e-14));
}

TEST_CASE("mixing: without flow a bed does not mix, without turbulence there is nothing to mix") {
    CHECK(mixing_model::bed_time(0.6, 0.02, 0) == infinity);
    CHECK(mixing_model{}.turbulent_time(1e-5, 0) == 0);
}

TEST_CASE("mixing: the chemical time is moles over the moles that the forward steps make") {
    const double t = 1800, p = 101325;
    const per_species x{0.02, 0.05, 0.72, 0.04, 0.05, 0.03, 0.09};
    // Forward rates at this state in kmol/(m^3 s), as in the test of the rates; their right hand sides hold 3, 4, 1 and
    // 2 moles.
    const double made = 3 * 53.5578445 + 4 * 5.63883207e-3 + 39.0816739 + 2 * 1.69266914;
    const double concentration = 1e-3 * p / (gas_constant * t);
    jones_lindstedt mechanism;
    mechanism.regularisation = 1e-9;
    CHECK(chemical_time(mechanism, t, p, x) == doctest::Approx(4 * concentration / made).epsilon(1e-8));
    CHECK(chemical_time({}, 300, p, {0, 0.21, 0.79, 0, 0, 0, 0}) == infinity);
}

TEST_CASE("mixing: all of a cell reacts where mixing or chemistry allow it, none where mixing takes forever") {
    CHECK(reacting_fraction(1e-5, 0) == 1);
    CHECK(reacting_fraction(infinity, 1e-3) == 1);
    CHECK(reacting_fraction(infinity, infinity) == 1);
    CHECK(reacting_fraction(1e-5, infinity) == 0);
    CHECK(reacting_fraction(0, 1e-3) == 0);
    CHECK(reacting_fraction(1e-4, 3e-4) == doctest::Approx(0.25).epsilon(1e-15));
}
