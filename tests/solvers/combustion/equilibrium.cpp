// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <doctest/doctest.h>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/jones_lindstedt.hpp>

#include "solvers/combustion/flames.hpp"
#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

/// Gibbs energy of a mixture over RT [mol/kg].
double gibbs(const per_species& n, double temperature, double pressure) {
    double g = 0;
    for (std::size_t k = 0; k < species_count; ++k)
        if (n[k] > 0)
            g += n[k] * (thermo_table[k].gibbs(temperature) / (gas_constant * temperature) +
                         std::log(n[k] / sum(n) * pressure / standard_pressure));
    return g;
}

void check_elements(const per_species& before, const per_species& now) {
    const per_element had = element_amounts(before), has = element_amounts(now);
    const double all = had[carbon] + had[hydrogen] + had[oxygen] + had[nitrogen];
    // Sums of seven terms with four roundings each.
    for (std::size_t e = 0; e < element_count; ++e) CHECK(std::fabs(has[e] - had[e]) <= 30 * 2.2e-16 * all);
}

}  // namespace

TEST_CASE("equilibrium: adiabatic flame temperatures and compositions agree in all digits given") {
    for (const flame& f : published) {
        CAPTURE(f.temperature);
        CAPTURE(f.pressure);
        CAPTURE(f.ratio);
        const per_species n = amounts_from_moles({f.ratio, 2, 2 * f.nitrogen, 0, 0, 0, 0});
        const double h = combine(n).enthalpy(f.temperature);
        const mixture_state burnt = equilibrium(n, h, f.pressure);
        const per_species x = mole_fractions(burnt.amount);
        // Half a unit of the last digit.  Methane here weighs 2.5e-6 less than in the table, which no mole feels.
        CHECK(std::fabs(burnt.temperature - f.burnt) < 0.51e-3);
        CHECK(x[CO] == doctest::Approx(f.co).epsilon(6e-6).scale(0));
        CHECK(x[H2] == doctest::Approx(f.h2).epsilon(6e-6).scale(0));
        CHECK(x[O2] == doctest::Approx(f.o2).epsilon(6e-6).scale(0));
        if (f.complete != none) CHECK(std::fabs(burn(n, h).temperature - f.complete) < 0.51e-3);
    }
}

TEST_CASE(
    "equilibrium: for any mixture it converges, keeps elements and enthalpy, and satisfies the equilibrium constants") {
    const std::uint64_t seed = 51;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 20000; ++i) {
        CAPTURE(i);
        const per_species n = any_mixture(random);
        const double t = random.uniform(300, 3000), p = random.log_uniform(1e4, 1e6);
        const double h = combine(n).enthalpy(t);
        const mixture_state e = equilibrium(n, h, p, random.uniform(300, 3000));
        for (const double a : e.amount) CHECK(a >= 0);
        CHECK(e.temperature > 299);  // reactions at 300 K heat
        CHECK(e.temperature < 6000);
        check_elements(n, e.amount);
        const nasa7 mixture = combine(e.amount);
        CHECK(std::fabs(mixture.enthalpy(e.temperature) - h) <= 60 * 2.2e-16 * (1.6e7 + mixture.heat_capacity(t) * t));
        const per_species x = mole_fractions(e.amount);
        for (const per_species& step : {stoichiometry[reforming], stoichiometry[hydrogen_oxidation],
                                        stoichiometry[water_gas_shift], per_species{0, -0.5, 0, -1, 1, 0, 0}}) {
            double affinity = combine(step).gibbs(e.temperature) / (gas_constant * e.temperature), smallest = 1;
            for (std::size_t k = 0; k < species_count; ++k)
                if (step[k] != 0) {
                    smallest = std::min(smallest, x[k]);
                    if (!(x[k] > 0)) continue;
                    affinity += step[k] * (std::log(x[k]) + std::log(p / standard_pressure));
                }
            // The temperature is solved to 1e-12, which H/RT < 60 multiplies; a species that the balance of its
            // elements fixes has the round-off of the balance, 4e-16 of the whole.
            if (smallest > 1e-12) CHECK(std::fabs(affinity) < 6e-11 + 8 * 4e-16 / smallest);
        }
    }
}

TEST_CASE("equilibrium: no exchange of atoms lowers the Gibbs energy further") {
    const std::uint64_t seed = 52;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 500; ++i) {
        const double t = random.uniform(600, 3000), p = random.log_uniform(1e4, 1e6);
        const per_species n = equilibrium_at(burning_mixture(random), t, p);
        const double least = gibbs(n, t, p);
        for (int j = 0; j < 20; ++j) {
            const double a = random.uniform(-1, 1), b = random.uniform(-1, 1), c = random.uniform(-1, 1);
            per_species change, moved = n;
            double room = 1e300;
            for (std::size_t k = 0; k < species_count; ++k) {
                change[k] = a * stoichiometry[reforming][k] + b * stoichiometry[hydrogen_oxidation][k] +
                            c * stoichiometry[water_gas_shift][k];
                if (change[k] < 0) room = std::min(room, -n[k] / change[k]);
            }
            const double step = random.uniform(0.01, 1) * room;
            for (std::size_t k = 0; k < species_count; ++k) moved[k] = std::max(0.0, n[k] + step * change[k]);
            CHECK(gibbs(moved, t, p) >= least - 1e-13 * std::fabs(least));  // round-off of a sum of about 1e3
        }
    }
}

TEST_CASE("equilibrium: mixtures that cannot react stay, and nearly so where there is next to nothing to react with") {
    for (const per_species& parts :
         {per_species{0, 0, 1, 0, 0, 0, 0}, per_species{0, 1, 0, 0, 0, 0, 0}, per_species{1, 0, 0, 0, 0, 0, 0},
          per_species{1, 0, 0, 0, 0, 1, 0}, per_species{0, 1, 4, 0, 0, 0, 0}, per_species{0, 0, 0, 1, 0, 0, 0},
          per_species{1, 0, 0, 1, 0, 0, 0}, per_species{1, 0, 3, 1, 0, 0, 0}})
        for (const double t : {300.0, 1500.0, 3000.0}) {
            const per_species n = amounts_from_moles(parts);
            const mixture_state e = equilibrium(n, combine(n).enthalpy(t), 101325);
            CHECK(e.temperature == doctest::Approx(t).epsilon(1e-9));
            for (std::size_t k = 0; k < species_count; ++k) CHECK(std::fabs(e.amount[k] - n[k]) < 1e-9 * sum(n));
            check_elements(n, e.amount);
        }
}

TEST_CASE("equilibrium: two elements alone agree with the solution of their one equation") {
    for (const double t : {1500.0, 2500.0, 3000.0}) {
        // CO2 <-> CO + 1/2 O2 from pure CO2 at p0: x/(1-x) sqrt(x/(2+x)) = K
        const per_species co2 = equilibrium_at(amounts_from_moles({0, 0, 0, 0, 1, 0, 0}), t, standard_pressure);
        const double k = std::exp(-combine({0, 0.5, 0, 1, -1, 0, 0}).gibbs(t) / (gas_constant * t));
        double x = co2[CO] / (co2[CO] + co2[CO2]);
        CHECK(x / (1 - x) * std::sqrt(x / (2 + x)) == doctest::Approx(k).epsilon(1e-11).scale(0));
        // H2O <-> H2 + 1/2 O2 from pure steam
        const per_species steam = equilibrium_at(amounts_from_moles({0, 0, 0, 0, 0, 0, 1}), t, standard_pressure);
        const double q = std::exp(combine(stoichiometry[hydrogen_oxidation]).gibbs(t) / (gas_constant * t));
        x = steam[H2] / (steam[H2] + steam[H2O]);
        CHECK(x / (1 - x) * std::sqrt(x / (2 + x)) == doctest::Approx(q).epsilon(1e-11).scale(0));
    }
}

TEST_CASE(
    "equilibrium: what is burnt has no oxygen or no fuel, and the same share of each fuel where oxygen is short") {
    const std::uint64_t seed = 53;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 2000; ++i) {
        const per_species n = any_mixture(random);
        const double t = random.uniform(300, 3000), h = combine(n).enthalpy(t);
        const mixture_state b = burn(n, h);
        for (const double a : b.amount) CHECK(a >= 0);
        check_elements(n, b.amount);
        CHECK(b.temperature >= t - 1e-6);
        const double fuel = b.amount[CH4] + b.amount[CO] + b.amount[H2];
        CHECK((b.amount[O2] == 0 || fuel < 1e-15 * sum(n)));
        for (const species k : {CO, H2})
            CHECK(b.amount[CH4] * n[k] == doctest::Approx(b.amount[k] * n[CH4]).epsilon(1e-12));
        const mixture_state again = burn(b.amount, h);
        for (std::size_t k = 0; k < species_count; ++k)
            CHECK(std::fabs(again.amount[k] - b.amount[k]) <= 1e-14 * sum(n));
    }
}
