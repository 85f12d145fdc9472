// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <doctest/doctest.h>

#include <hearth/combustion/jones_lindstedt.hpp>
#include <hearth/combustion/thermo.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct property_row {
    species k;
    double temperature, heat_capacity, enthalpy, entropy;  // [K], [J/(mol K)], [J/mol], [J/(mol K)]
};

// Evaluated apart from the same published coefficients.
// clang-format off
constexpr property_row published[] = {
    {CH4, 298.15, 35.690975, -74599.5745, 186.370229},
    {CH4, 500, 46.494068, -66387.9906, 207.162094},
    {CH4, 1000, 73.616670, -35948.4447, 248.278829},
    {CH4, 1500, 90.413747, 5424.4831, 281.599286},
    {CH4, 2226, 103.642854, 76415.4772, 320.027581},
    {CH4, 2500, 106.865009, 105268.6493, 332.248074},
    {O2, 298.15, 29.378186, 0.0000, 205.148298},
    {O2, 500, 31.083501, 6086.1880, 220.699106},
    {O2, 1000, 34.882974, 22706.8109, 243.586393},
    {O2, 1500, 36.575270, 40602.0750, 258.075089},
    {O2, 2226, 38.300289, 67804.1575, 272.843215},
    {O2, 2500, 38.906601, 78381.4894, 277.323791},
    {N2, 298.15, 29.071024, 1.4299, 191.512241},
    {N2, 500, 29.635885, 5921.5830, 206.663755},
    {N2, 1000, 32.761946, 21469.8652, 228.088544},
    {N2, 1500, 34.805342, 38405.6227, 241.794263},
    {N2, 2226, 36.333572, 64306.3907, 255.857242},
    {N2, 2500, 36.645715, 74306.8079, 260.093728},
    {CO, 298.15, 29.140834, -110529.3698, 197.656317},
    {CO, 500, 29.810753, -104593.6690, 212.845190},
    {CO, 1000, 33.162862, -88839.4069, 234.544615},
    {CO, 1500, 35.211342, -71688.9411, 248.424387},
    {CO, 2226, 36.538628, -45569.2698, 262.609113},
    {CO, 2500, 36.815796, -35518.2681, 266.867069},
    {CO2, 298.15, 37.135175, -393507.7577, 213.786267},
    {CO2, 500, 44.620385, -385207.3630, 234.879828},
    {CO2, 1000, 54.320864, -360110.6924, 269.286217},
    {CO2, 1500, 58.396386, -331810.5006, 292.179888},
    {CO2, 2226, 60.897412, -288358.5956, 315.773481},
    {CO2, 2500, 61.412730, -271599.6416, 322.873102},
    {H2, 298.15, 28.836183, 0.0000, 130.680270},
    {H2, 500, 29.297652, 5895.4655, 145.771094},
    {H2, 1000, 30.163146, 20686.5339, 166.235720},
    {H2, 1500, 32.279205, 36294.4671, 178.863653},
    {H2, 2226, 35.030668, 60772.4663, 192.136959},
    {H2, 2500, 35.851136, 70486.1848, 196.251410},
    {H2O, 298.15, 33.587519, -241824.6216, 188.828039},
    {H2O, 500, 35.214047, -234899.7983, 206.528993},
    {H2O, 1000, 41.294744, -215822.1050, 232.735006},
    {H2O, 1500, 47.291345, -193611.6607, 250.663895},
    {H2O, 2226, 53.290944, -156912.8366, 270.539686},
    {H2O, 2500, 54.805516, -142095.4088, 276.815625},
};
// clang-format on

}  // namespace

TEST_CASE("thermo: heat capacity, enthalpy and entropy agree with the tables to the last digit") {
    for (const property_row& row : published) {
        CAPTURE(row.k);
        CAPTURE(row.temperature);
        const nasa7& gas = thermo_table[row.k];
        // Half a unit of the last digit printed, and a fiftieth of it for round-off.
        CHECK(std::fabs(gas.heat_capacity(row.temperature) - row.heat_capacity) < 0.51e-6);
        CHECK(std::fabs(gas.enthalpy(row.temperature) - row.enthalpy) < 0.51e-4);
        CHECK(std::fabs(gas.entropy(row.temperature) - row.entropy) < 0.51e-6);
    }
}

TEST_CASE("thermo: heat capacity is the slope of enthalpy, and over T that of entropy") {
    for (const nasa7& gas : thermo_table)
        for (const double t : {250.0, 700.0, 1300.0, 3000.0}) {
            const double h = 0.05;  // [K] truncation below 1e-8, round-off 1e-16 * 4e5/(h cp) = 3e-11
            CHECK((gas.enthalpy(t + h) - gas.enthalpy(t - h)) / (2 * h) ==
                  doctest::Approx(gas.heat_capacity(t)).epsilon(1e-7));
            CHECK((gas.entropy(t + h) - gas.entropy(t - h)) / (2 * h) ==
                  doctest::Approx(gas.heat_capacity(t) / t).epsilon(1e-7));
            CHECK(gas.gibbs(t) == doctest::Approx(gas.enthalpy(t) - t * gas.entropy(t)).epsilon(1e-15));
        }
}

TEST_CASE("thermo: beyond the range the heat capacity stays and enthalpy and entropy go on without a step") {
    for (const nasa7& gas : thermo_table)
        for (const double limit : {nasa7::limits().lo, nasa7::limits().hi}) {
            const double outside = limit < 1000 ? limit - 150 : limit + 2000;
            const double cp = gas.heat_capacity(limit);
            CHECK(gas.heat_capacity(outside) == cp);
            CHECK(gas.enthalpy(outside) ==
                  doctest::Approx(gas.enthalpy(limit) + cp * (outside - limit)).epsilon(1e-14));
            CHECK(gas.entropy(outside) ==
                  doctest::Approx(gas.entropy(limit) + cp * std::log(outside / limit)).epsilon(1e-14));
        }
}

TEST_CASE("thermo: temperature from enthalpy inverts enthalpy for any mixture, inside and outside the range") {
    const std::uint64_t seed = 11;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 20000; ++i) {
        const nasa7 gas = combine(any_mixture(random));
        const double t = random.log_uniform(60, 9000);
        CAPTURE(t);
        const double h = gas.enthalpy(t), cp = gas.heat_capacity(t);
        const double found = gas.temperature(h, random.log_uniform(1, 1e5));
        // The terms of the enthalpy, of which heats of formation reach 1.6e7 J/kg, carry about 20 roundings.
        const double rounding = 20 * epsilon * (1.6e7 + cp * t);
        CHECK(std::fabs(gas.enthalpy(found) - h) <= rounding);
        if (std::fabs(t - 1000) > 0.01)
            CHECK(std::fabs(found - t) <= rounding / cp);  // two temperatures within the step
    }
}

TEST_CASE(
    "thermo: across the step of the tables at 1000 K every enthalpy has one temperature, and they rise together") {
    for (const nasa7& gas : thermo_table) {
        const double h = gas.enthalpy(1000);
        double previous = 0;
        for (int i = -200; i <= 200; ++i) {
            const double enthalpy = h + i * 1e-4;  // [J/mol], 0.02 each way; the largest step is 0.0052
            const double t = gas.temperature(enthalpy);
            CHECK(t > previous);
            CHECK(std::fabs(gas.enthalpy(t) - enthalpy) < 20 * epsilon * 4e5);
            previous = t;
        }
    }
}

TEST_CASE("thermo: Newton for the temperature contracts, since the mean heat capacity is below twice the local one") {
    for (const nasa7& gas : thermo_table)
        for (const auto& [lo, hi, range] : {std::tuple{200.0, 1000.0, gas.low}, std::tuple{1000.0, 3500.0, gas.high}})
            for (int i = 0; i <= 40; ++i)
                for (int j = 0; j <= 40; ++j) {
                    if (i == j) continue;
                    const double from = lo + (hi - lo) * i / 40, to = lo + (hi - lo) * j / 40;
                    CHECK((range.enthalpy(to) - range.enthalpy(from)) / (to - from) < 1.9 * range.heat_capacity(from));
                }
}

TEST_CASE("species: conversions invert one another and reactions keep mass and elements") {
    const std::uint64_t seed = 12;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 100; ++i) {
        const per_species n = any_mixture(random), y = mass_fractions(n), back = amounts(y);
        CHECK(sum(y) == doctest::Approx(1).epsilon(8 * epsilon));
        CHECK(sum(mole_fractions(n)) == doctest::Approx(1).epsilon(8 * epsilon));
        for (std::size_t k = 0; k < species_count; ++k) CHECK(std::fabs(back[k] - n[k]) <= 2 * epsilon * n[k]);
    }
    for (const per_species& made : stoichiometry) {
        double mass = 0;
        for (std::size_t k = 0; k < species_count; ++k) mass += made[k] * molar_mass[k];
        CHECK(std::fabs(mass) < 4 * epsilon * molar_mass[CO2]);
        for (const double left : element_amounts(made)) CHECK(left == 0);
    }
    // CH4, O2, N2, CO, CO2, H2, H2O as tables print them [g/mol]; methane there is 4e-5 above its atoms.
    const per_species printed{16.0425, 31.9988, 28.0134, 28.0101, 44.0095, 2.01588, 18.01528};
    for (std::size_t k = 0; k < species_count; ++k)
        CHECK(1e3 * molar_mass[k] == doctest::Approx(printed[k]).epsilon(3e-6));
}
