// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <doctest/doctest.h>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/jones_lindstedt.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

struct flame {
    double nitrogen;                      // moles per mole of O2 in the air
    double temperature, pressure, ratio;  // of the fresh mixture [K], [Pa], equivalence ratio [-]
    double complete, burnt;               // flame temperatures [K]
    double co, h2, o2;                    // mole fractions at `burnt` [-]
};
constexpr double dry = 0.79 / 0.21, molar = 3.76, none = 0;

// Solved apart, by minimisation of the Gibbs energy in extended precision, from the same coefficients (residuals
// 1e-28).
// clang-format off
constexpr flame published[] = {
    {dry, 298.15, 101325, 0.60, 1668.897, 1668.784, 9.99230e-06, 6.08010e-06, 7.90290e-02},
    {dry, 298.15, 101325, 0.80, 2014.459, 2009.145, 5.54185e-04, 2.41693e-04, 3.91279e-02},
    {dry, 298.15, 101325, 0.90, 2173.689, 2151.038, 2.47006e-03, 9.89388e-04, 2.08834e-02},
    {dry, 298.15, 101325, 1.00, 2325.014, 2245.024, 8.85921e-03, 3.53831e-03, 6.19876e-03},
    {dry, 298.15, 101325, 1.10, none, 2226.029, 2.57390e-02, 1.20959e-02, 4.47936e-04},
    {dry, 298.15, 101325, 1.20, none, 2143.334, 4.51886e-02, 2.67895e-02, 3.12924e-05},
    {dry, 298.15, 100000, 0.60, 1668.897, 1668.784, 1.00582e-05, 6.12019e-06, 7.90291e-02},
    {dry, 298.15, 100000, 0.80, 2014.459, 2009.111, 5.57647e-04, 2.43218e-04, 3.91303e-02},
    {dry, 298.15, 100000, 0.90, 2173.689, 2150.915, 2.48323e-03, 9.94866e-04, 2.08925e-02},
    {dry, 298.15, 100000, 1.00, 2325.014, 2244.771, 8.88597e-03, 3.55041e-03, 6.21819e-03},
    {dry, 298.15, 100000, 1.10, none, 2225.962, 2.57451e-02, 1.21000e-02, 4.53165e-04},
    {dry, 298.15, 100000, 1.20, none, 2143.329, 4.51890e-02, 2.67899e-02, 3.17036e-05},
    {dry, 300.00, 101325, 0.60, 1670.317, 1670.203, 1.01647e-05, 6.17410e-06, 7.90292e-02},
    {dry, 300.00, 101325, 0.80, 2015.815, 2010.446, 5.60112e-04, 2.44042e-04, 3.91319e-02},
    {dry, 300.00, 101325, 0.90, 2175.020, 2152.197, 2.48937e-03, 9.96543e-04, 2.08964e-02},
    {dry, 300.00, 101325, 1.00, 2326.322, 2246.013, 8.89539e-03, 3.55191e-03, 6.22365e-03},
    {dry, 300.00, 101325, 1.10, none, 2227.246, 2.57526e-02, 1.20955e-02, 4.54660e-04},
    {dry, 300.00, 101325, 1.20, none, 2144.624, 4.51999e-02, 2.67793e-02, 3.18559e-05},
    {dry, 300.00, 100000, 0.60, 1670.317, 1670.202, 1.02317e-05, 6.21482e-06, 7.90292e-02},
    {dry, 300.00, 100000, 0.80, 2015.815, 2010.413, 5.63609e-04, 2.45581e-04, 3.91343e-02},
    {dry, 300.00, 100000, 0.90, 2175.020, 2152.074, 2.50262e-03, 1.00206e-03, 2.09056e-02},
    {dry, 300.00, 100000, 1.00, 2326.322, 2245.760, 8.92223e-03, 3.56405e-03, 6.24314e-03},
    {dry, 300.00, 100000, 1.10, none, 2227.177, 2.57588e-02, 1.20997e-02, 4.59958e-04},
    {dry, 300.00, 100000, 1.20, none, 2144.619, 4.52003e-02, 2.67797e-02, 3.22745e-05},
    {dry, 600.00, 101325, 0.60, 1906.393, 1905.167, 1.20819e-04, 5.72866e-05, 7.91037e-02},
    {dry, 600.00, 101325, 0.80, 2242.923, 2219.555, 2.55727e-03, 9.84300e-04, 4.04476e-02},
    {dry, 600.00, 101325, 0.90, 2398.462, 2333.660, 7.24986e-03, 2.73298e-03, 2.40825e-02},
    {dry, 600.00, 101325, 1.00, 2546.502, 2403.589, 1.59836e-02, 6.29563e-03, 1.11396e-02},
    {dry, 600.00, 101325, 1.10, none, 2413.848, 2.97215e-02, 1.32286e-02, 3.05368e-03},
    {dry, 600.00, 101325, 1.20, none, 2358.469, 4.71945e-02, 2.56016e-02, 4.55501e-04},
    {dry, 600.00, 100000, 0.60, 1906.393, 1905.159, 1.21606e-04, 5.76606e-05, 7.91042e-02},
    {dry, 600.00, 100000, 0.80, 2242.923, 2219.426, 2.57112e-03, 9.89859e-04, 4.04569e-02},
    {dry, 600.00, 100000, 0.90, 2398.462, 2333.385, 7.27950e-03, 2.74540e-03, 2.41031e-02},
    {dry, 600.00, 100000, 1.00, 2546.502, 2403.204, 1.60235e-02, 6.31513e-03, 1.11693e-02},
    {dry, 600.00, 100000, 1.10, none, 2413.561, 2.97480e-02, 1.32461e-02, 3.07608e-03},
    {dry, 600.00, 100000, 1.20, none, 2358.399, 4.71997e-02, 2.56069e-02, 4.60963e-04},
    {molar, 298.15, 101325, 0.60, 1669.331, 1669.218, 1.00466e-05, 6.10982e-06, 7.90588e-02},
    {molar, 298.15, 101325, 0.80, 2014.976, 2009.640, 5.56539e-04, 2.42630e-04, 3.91438e-02},
    {molar, 298.15, 101325, 0.90, 2174.242, 2151.516, 2.47850e-03, 9.92525e-04, 2.08961e-02},
    {molar, 298.15, 101325, 1.00, 2325.598, 2245.454, 8.87713e-03, 3.54506e-03, 6.21109e-03},
    {molar, 298.15, 101325, 1.10, none, 2226.540, 2.57536e-02, 1.20999e-02, 4.50756e-04},
    {molar, 298.15, 101325, 1.20, none, 2143.843, 4.52085e-02, 2.67947e-02, 3.15135e-05},
    {molar, 298.15, 100000, 0.60, 1669.331, 1669.217, 1.01128e-05, 6.15011e-06, 7.90589e-02},
    {molar, 298.15, 100000, 0.80, 2014.976, 2009.607, 5.60015e-04, 2.44161e-04, 3.91462e-02},
    {molar, 298.15, 100000, 0.90, 2174.242, 2151.393, 2.49170e-03, 9.98018e-04, 2.09052e-02},
    {molar, 298.15, 100000, 1.00, 2325.598, 2245.201, 8.90393e-03, 3.55718e-03, 6.23056e-03},
    {molar, 298.15, 100000, 1.10, none, 2226.472, 2.57597e-02, 1.21040e-02, 4.56014e-04},
    {molar, 298.15, 100000, 1.20, none, 2143.837, 4.52089e-02, 2.67951e-02, 3.19276e-05},
    {molar, 300.00, 101325, 0.60, 1670.751, 1670.636, 1.02198e-05, 6.20423e-06, 7.90589e-02},
    {molar, 300.00, 101325, 0.80, 2016.332, 2010.942, 5.62486e-04, 2.44987e-04, 3.91478e-02},
    {molar, 300.00, 101325, 0.90, 2175.572, 2152.674, 2.49785e-03, 9.99696e-04, 2.09091e-02},
    {molar, 300.00, 101325, 1.00, 2326.906, 2246.443, 8.91335e-03, 3.55868e-03, 6.23601e-03},
    {molar, 300.00, 101325, 1.10, none, 2227.756, 2.57672e-02, 1.20995e-02, 4.57514e-04},
    {molar, 300.00, 101325, 1.20, none, 2145.133, 4.52198e-02, 2.67845e-02, 3.20807e-05},
    {molar, 300.00, 100000, 0.60, 1670.751, 1670.635, 1.02872e-05, 6.24514e-06, 7.90590e-02},
    {molar, 300.00, 100000, 0.80, 2016.332, 2010.908, 5.65997e-04, 2.46531e-04, 3.91502e-02},
    {molar, 300.00, 100000, 0.90, 2175.572, 2152.551, 2.51114e-03, 1.00522e-03, 2.09183e-02},
    {molar, 300.00, 100000, 1.00, 2326.906, 2246.189, 8.94023e-03, 3.57084e-03, 6.25553e-03},
    {molar, 300.00, 100000, 1.10, none, 2227.687, 2.57734e-02, 1.21037e-02, 4.62842e-04},
    {molar, 300.00, 100000, 1.20, none, 2145.127, 4.52202e-02, 2.67849e-02, 3.25022e-05},
    {molar, 600.00, 101325, 0.60, 1906.814, 1905.584, 1.21306e-04, 5.74961e-05, 7.91337e-02},
    {molar, 600.00, 101325, 0.80, 2243.427, 2219.992, 2.56493e-03, 9.87056e-04, 4.04668e-02},
    {molar, 600.00, 101325, 0.90, 2399.001, 2334.059, 7.26615e-03, 2.73892e-03, 2.41004e-02},
    {molar, 600.00, 101325, 1.00, 2547.073, 2403.957, 1.60073e-02, 6.30502e-03, 1.11562e-02},
    {molar, 600.00, 101325, 1.10, none, 2414.253, 2.97448e-02, 1.32384e-02, 3.06394e-03},
    {molar, 600.00, 101325, 1.20, none, 2358.938, 4.72159e-02, 2.56093e-02, 4.57871e-04},
    {molar, 600.00, 100000, 0.60, 1906.814, 1905.576, 1.22096e-04, 5.78715e-05, 7.91343e-02},
    {molar, 600.00, 100000, 0.80, 2243.427, 2219.863, 2.57882e-03, 9.92628e-04, 4.04762e-02},
    {molar, 600.00, 100000, 0.90, 2399.001, 2333.784, 7.29583e-03, 2.75136e-03, 2.41210e-02},
    {molar, 600.00, 100000, 1.00, 2547.073, 2403.571, 1.60472e-02, 6.32454e-03, 1.11859e-02},
    {molar, 600.00, 100000, 1.10, none, 2413.966, 2.97714e-02, 1.32559e-02, 3.08639e-03},
    {molar, 600.00, 100000, 1.20, none, 2358.868, 4.72212e-02, 2.56147e-02, 4.63359e-04},
};
// clang-format on

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
