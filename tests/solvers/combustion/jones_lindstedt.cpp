// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/jones_lindstedt.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

struct rate_row {
    double temperature;                           // [K], at 101325 Pa
    per_species x;                                // [-]
    per_step forward_b, net_b, forward_a, net_a;  // [kmol/(m^3 s)]
};

// Evaluated apart, in the kmol, m^3 and cal of the paper, with a regularisation of 1e-9 in both variants.
// clang-format off
constexpr rate_row published[] = {
    {1500, {0.050000, 0.100000, 0.720000, 0.030000, 0.030000, 0.020000, 0.050000},
     {5.17801003e+01, 2.10733834e-03, 1.76169439e+01, 3.31945461e-01}, {5.17801003e+01, 2.10733834e-03, 1.76166804e+01, -1.14787149e-02},
     {5.17801003e+01, 2.10733834e-03, 8.66261791e+01, 3.31945461e-01}, {5.17801003e+01, 2.10733834e-03, 8.66248835e+01, -1.14787149e-02}},
    {1800, {0.020000, 0.050000, 0.720000, 0.040000, 0.050000, 0.030000, 0.090000},
     {5.35578445e+01, 5.63883207e-03, 3.90816739e+01, 1.69266914e+00}, {5.35578445e+01, 5.63883207e-03, 3.90534277e+01, -9.98972753e-01},
     {5.35578445e+01, 5.63883207e-03, 7.02537578e+01, 1.69266914e+00}, {5.35578445e+01, 5.63883207e-03, 7.02029820e+01, -9.98972753e-01}},
    {2200, {0.001000, 0.010000, 0.710000, 0.010000, 0.085000, 0.005000, 0.179000},
     {5.18014078e+00, 1.72475862e-03, 9.82492596e+00, 1.55714211e+00}, {5.18014078e+00, 1.72475862e-03, 5.81233757e+00, -3.93148141e-01},
     {5.18014078e+00, 1.72475862e-03, 1.69687508e+00, 1.55714211e+00}, {5.18014078e+00, 1.72475862e-03, 1.00385599e+00, -3.93148141e-01}},
    {1200, {0.090000, 0.190000, 0.710000, 0.001000, 0.001000, 0.002000, 0.006000},
     {1.84972145e+01, 5.74487671e-05, 1.67337619e+00, 3.87669705e-04}, {1.84972145e+01, 5.74487671e-05, 1.67337604e+00, 2.10247690e-04},
     {1.84972145e+01, 5.74487671e-05, 6.24016556e+01, 3.87669705e-04}, {1.84972145e+01, 5.74487671e-05, 6.24016502e+01, 2.10247690e-04}},
};
// clang-format on

constexpr auto a = jones_lindstedt::hydrogen_step::a;
constexpr auto b = jones_lindstedt::hydrogen_step::b;

jones_lindstedt mechanism(jones_lindstedt::hydrogen_step variant) {
    jones_lindstedt m;
    m.variant = variant;
    return m;
}

per_step net(const rate_terms& r) {
    per_step d;
    for (std::size_t s = 0; s < step_count; ++s) d[s] = r.forward[s] - r.backward[s];
    return d;
}

}  // namespace

TEST_CASE("jones_lindstedt: rates agree with the published constants in all digits given") {
    for (const rate_row& row : published)
        for (const auto variant : {a, b}) {
            jones_lindstedt m = mechanism(variant);
            m.regularisation = m.water_seed = 1e-9;
            CAPTURE(row.temperature);
            CAPTURE(variant == a);
            const step_rates r = rates(m, row.temperature, 101325, row.x);
            const per_step& forward = variant == a ? row.forward_a : row.forward_b;
            const per_step& net = variant == a ? row.net_a : row.net_b;
            for (std::size_t s = 0; s < step_count; ++s) {
                CAPTURE(s);
                // Nine digits are given.
                CHECK(std::fabs(1e-3 * r.forward[s] - forward[s]) < 6e-9 * std::fabs(forward[s]));
                CHECK(std::fabs(1e-3 * r.net[s] - net[s]) < 6e-9 * std::fabs(net[s]));
            }
        }
}

TEST_CASE("jones_lindstedt: the derivatives are those of the rates") {
    const std::uint64_t seed = 21;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 200; ++i)
        for (const auto variant : {a, b}) {
            const jones_lindstedt m = mechanism(variant);
            const per_species x = mole_fractions(burning_mixture(random));
            const double t = random.uniform(1010, 2600), p = random.log_uniform(1e4, 1e6);
            rate_terms r;
            evaluate<true>(m, rate_constants_at(m, t, p), x, r);
            const auto net_at = [&](double temperature, const per_species& y) {
                rate_terms q;
                evaluate<false>(m, rate_constants_at(m, temperature, p), y, q);
                return net(q);
            };
            // Central differences: truncation (E/RT h)^2/6 < (20 h)^2, and h^2 for the fractions; round-off 1e-16/h.
            const double h = 1e-5;
            const per_step up = net_at(t * (1 + h), x), down = net_at(t * (1 - h), x);
            for (std::size_t s = 0; s < step_count; ++s) {
                const double gross = (r.forward[s] + r.backward[s]) / t;
                CHECK(std::fabs((up[s] - down[s]) / (2 * h * t) - r.by_temperature[s]) < 1e-6 * gross);
            }
            for (std::size_t k = 0; k < species_count; ++k) {
                per_species more = x, less = x;
                more[k] *= 1 + h;
                less[k] *= 1 - h;
                const per_step high = net_at(t, more), low = net_at(t, less);
                for (std::size_t s = 0; s < step_count; ++s) {
                    const double gross = (r.forward[s] + r.backward[s]) / x[k];
                    CHECK(std::fabs((high[s] - low[s]) / (2 * h * x[k]) - r.by_fraction[s][k]) < 1e-9 * gross);
                }
            }
        }
}

TEST_CASE("jones_lindstedt: the reversible steps stand still in chemical equilibrium, in both variants") {
    const std::uint64_t seed = 22;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 200; ++i) {
        const double t = random.uniform(1010, 2800), p = random.log_uniform(1e4, 1e6);
        const per_species x = mole_fractions(equilibrium_at(burning_mixture(random), t, p));
        for (const auto variant : {a, b}) {
            const step_rates r = rates(mechanism(variant), t, p, x);
            // The equilibrium is solved to 1e-15 in ln z, which is at most 40; the seed of oxygen is 1e-12.
            CHECK(std::fabs(r.net[hydrogen_oxidation]) < (1e-11 + 1e-12 / x[O2]) * r.forward[hydrogen_oxidation]);
            CHECK(std::fabs(r.net[water_gas_shift]) < 1e-11 * r.forward[water_gas_shift]);
        }
    }
}

TEST_CASE("jones_lindstedt: rates are finite whatever is absent, and a negative fraction counts as absent") {
    for (unsigned absent = 0; absent < 128; ++absent) {
        per_species x{0.05, 0.1, 0.6, 0.05, 0.05, 0.05, 0.1};
        per_species negative = x;
        for (std::size_t k = 0; k < species_count; ++k)
            if (absent >> k & 1u) {
                x[k] = 0;
                negative[k] = -1e-7;
            }
        for (const auto variant : {a, b})
            for (const double t : {300.0, 1000.0, 2500.0, 5000.0}) {
                const jones_lindstedt m = mechanism(variant);
                rate_terms r, q;
                evaluate<true>(m, rate_constants_at(m, t, 1e5), x, r);
                evaluate<true>(m, rate_constants_at(m, t, 1e5), negative, q);
                for (std::size_t s = 0; s < step_count; ++s) {
                    CHECK(std::isfinite(r.forward[s]));
                    CHECK(std::isfinite(r.backward[s]));
                    CHECK(std::isfinite(r.by_temperature[s]));
                    for (const double d : r.by_fraction[s]) CHECK(std::isfinite(d));
                    CHECK(q.forward[s] == r.forward[s]);
                    CHECK(q.backward[s] == r.backward[s]);
                    // What is absent is not consumed; but O2 is formed without O2, from its seed.
                    for (std::size_t k = 0; k < species_count; ++k) {
                        if (x[k] == 0 && stoichiometry[s][k] < 0) CHECK(r.forward[s] == 0);
                        if (x[k] == 0 && stoichiometry[s][k] > 0) CHECK(r.backward[s] == 0);
                        if (k == O2 && x[k] == 0 && s == hydrogen_oxidation) CHECK((r.backward[s] > 0) == (x[H2O] > 0));
                    }
                }
            }
    }
}

TEST_CASE("jones_lindstedt: forward rates go with the pressure to the order of the step") {
    const per_species x{0.05, 0.1, 0.6, 0.05, 0.05, 0.05, 0.1};
    for (const auto variant : {a, b}) {
        const step_rates one = rates(mechanism(variant), 1700, 1e5, x), two = rates(mechanism(variant), 1700, 2e5, x);
        const per_step order{1.75, 2, 1.75, 2};  // 3A: 1/2 + 9/4 - 1
        for (std::size_t s = 0; s < step_count; ++s)
            CHECK(std::log2(two.forward[s] / one.forward[s]) == doctest::Approx(order[s]).epsilon(1e-13));
    }
}
