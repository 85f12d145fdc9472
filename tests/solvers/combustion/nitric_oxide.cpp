// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/nitric_oxide.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

// Radicals above 1000 K, of the same source as the table of the library (GRI-Mech 3.0).
const nasa7 atomic_oxygen{
    {}, {{2.56942078, -8.59741137e-05, 4.19484589e-08, -1.00177799e-11, 1.22833691e-15, 29217.5791, 4.78433864}}};
const nasa7 hydroxyl{
    {}, {{3.09288767, 5.48429716e-04, 1.26505228e-07, -8.79461556e-11, 1.17412376e-14, 3858.657, 4.4766961}}};
const nasa7 nitric_oxide{
    {}, {{3.2606056, 1.1911043e-03, -4.2917048e-07, 6.9457669e-11, -4.0336099e-15, 9920.9746, 6.3693027}}};

/// exp(-G/RT) of making one mole from others.
double constant(const nasa7& made, const per_species& from, double t) {
    nasa7 reaction = made;
    reaction.add(-1, combine(from));
    return std::exp(-reaction.gibbs(t) / (gas_constant * t));
}

}  // namespace

TEST_CASE("nitric oxide: oxygen atoms and OH are those of the equilibrium tables") {
    for (const double t : {1800.0, 2000.0, 2200.0, 2500.0}) {
        CAPTURE(t);
        const double c0 = standard_pressure / (gas_constant * t);
        const double o2 = 0.03 * c0, h2o = 0.18 * c0;
        const double o = constant(atomic_oxygen, {0, 0.5, 0, 0, 0, 0, 0}, t) * std::sqrt(o2 * c0);
        CHECK(thermal_nitric_oxide::oxygen_atoms(t, o2) == doctest::Approx(o).epsilon(0.07).scale(0));
        // 1/2 H2O + 1/4 O2 -> OH
        const double oh = constant(hydroxyl, {0, 0.25, 0, 0, 0, 0, 0.5}, t) * std::sqrt(h2o) * std::pow(o2, 0.25) *
                          std::pow(c0, 0.25);
        CHECK(thermal_nitric_oxide::hydroxyl(t, o, h2o) == doctest::Approx(oh).epsilon(0.006).scale(0));
    }
}

TEST_CASE("nitric oxide: the rate starts at twice the first step's and ends at the equilibrium of NO") {
    for (const double t : {1800.0, 2100.0, 2500.0}) {
        CAPTURE(t);
        const double p = 101325;
        const per_species x = mole_fractions(equilibrium_at(methane_air(0.9), t, p));
        const double c = p / (gas_constant * t);
        const double first =
            1.8e8 * std::exp(-38370 / t) * thermal_nitric_oxide::oxygen_atoms(t, x[O2] * c) * x[N2] * c;
        CHECK(thermal_nitric_oxide::rate(t, p, x) == doctest::Approx(2 * first).epsilon(1e-13).scale(0));
        // N2 + O2 <-> 2 NO of the tables; the rate constants imply it within 20 % [Hanson & Salimian].
        const double no = constant(nitric_oxide, {0, 0.5, 0.5, 0, 0, 0, 0}, t) * std::sqrt(x[N2] * x[O2]);
        CHECK(thermal_nitric_oxide::rate(t, p, x, no / 1.2) > 0);
        CHECK(thermal_nitric_oxide::rate(t, p, x, no * 1.2) < 0);
        CHECK(thermal_nitric_oxide::rate(t, p, x, 0.5 * no) < thermal_nitric_oxide::rate(t, p, x));
    }
}

TEST_CASE("nitric oxide: none without oxygen, and next to none in the cold") {
    CHECK(thermal_nitric_oxide::rate(2200, 1e5, {0.1, 0, 0.9, 0, 0, 0, 0}) == 0);
    CHECK(thermal_nitric_oxide::rate(2200, 1e5, {0, 1, 0, 0, 0, 0, 0}) == 0);  // nor without nitrogen
    const per_species air{0, 0.21, 0.79, 0, 0, 0, 0};
    const double c = 1e5 / (gas_constant * 1200);
    CHECK(thermal_nitric_oxide::rate(1200, 1e5, air) / c < 1e-6);  // mole fraction per second
    CHECK(thermal_nitric_oxide::rate(300, 1e5, air) >= 0);
}
