// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/combustion/chemistry.hpp>
#include <hearth/combustion/equilibrium.hpp>
#include <hearth/combustion/mixing.hpp>
#include <hearth/core/error.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cells that own their arrays.
struct cells {
    std::vector<double> pressure, temperature, mixing_time;
    std::array<std::vector<double>, species_count> y;

    void add(const per_species& amount, double t, double p = 101325) {
        const per_species fractions = mass_fractions(amount);
        for (std::size_t k = 0; k < species_count; ++k) y[k].push_back(fractions[k]);
        temperature.push_back(t);
        pressure.push_back(p);
    }
    cell_arrays view() {
        cell_arrays v;
        v.count = temperature.size();
        v.pressure = pressure.data();
        v.temperature = temperature.data();
        for (std::size_t k = 0; k < species_count; ++k) v.mass_fraction[k] = y[k].data();
        if (!mixing_time.empty()) v.mixing_time = mixing_time.data();
        return v;
    }
    per_species fractions(std::size_t i) const {
        per_species out;
        for (std::size_t k = 0; k < species_count; ++k) out[k] = y[k][i];
        return out;
    }
    bool operator==(const cells& o) const { return pressure == o.pressure && temperature == o.temperature && y == o.y; }
};

cells one(const per_species& amount, double t, double p = 101325) {
    cells c;
    c.add(amount, t, p);
    return c;
}

chemistry with(chemistry::model kind) {
    chemistry s;
    s.kind = kind;
    return s;
}

cells any_cells(std::size_t count, std::uint64_t seed) {
    hearth_test::seeded random(seed);
    cells c;
    for (std::size_t i = 0; i < count; ++i) {
        const per_species n = i % 2 ? any_mixture(random) : burning_mixture(random);
        c.add(n, random.uniform(300, 2600), random.log_uniform(5e4, 5e5));
    }
    return c;
}

constexpr chemistry::model all_models[] = {chemistry::model::finite_rate, chemistry::model::equilibrium,
                                           chemistry::model::mixed_is_burnt};

}  // namespace

TEST_CASE("chemistry: a batch gives each cell what it gets alone, whatever its neighbours") {
    for (const auto kind : all_models) {
        const cells start = any_cells(60, 61);
        cells batch = start;
        const chemistry_report all = advance(with(kind), 1e-4, batch.view());
        std::size_t reacting = 0;
        for (std::size_t i = 0; i < start.temperature.size(); ++i) {
            cells alone = one(amounts(start.fractions(i)), start.temperature[i], start.pressure[i]);
            for (std::size_t k = 0; k < species_count; ++k) alone.y[k][0] = start.y[k][i];
            reacting += advance(with(kind), 1e-4, alone.view()).reacting;
            CHECK(alone.temperature[0] == batch.temperature[i]);
            CHECK(alone.fractions(0) == batch.fractions(i));
        }
        CHECK(all.reacting == reacting);
        CHECK(all.failed == 0);
    }
}

TEST_CASE("chemistry: over any step from 1e-6 to 1000 s it finishes, stays positive, and keeps elements and enthalpy") {
    const std::uint64_t seed = 62;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (const auto kind : all_models)
        for (int i = 0; i < 40; ++i) {
            const cells start = any_cells(50, 1000 + static_cast<std::uint64_t>(i));
            cells c = start;
            const double dt = random.log_uniform(1e-6, 1e3);
            const chemistry_report r = advance(with(kind), dt, c.view());
            CHECK(r.failed == 0);
            CHECK(r.first_failed == -1);
            CHECK(r.element_imbalance < 4e-15);   // seven terms with five roundings each
            CHECK(r.enthalpy_imbalance < 1e-13);  // heats of formation are up to 50 times cp T
            for (std::size_t j = 0; j < c.temperature.size(); ++j) {
                CHECK(std::isfinite(c.temperature[j]));
                for (const double y : c.fractions(j)) CHECK(y >= 0);
                CHECK(std::fabs(sum(c.fractions(j)) - sum(start.fractions(j))) < 1e-14);
            }
        }
}

TEST_CASE("chemistry: cold, inert and burnt-out cells cost nothing and keep their bits") {
    cells c;
    c.add(methane_air(1.0), 300);                                     // premixed, but cold
    c.add(amounts_from_moles({0, 0, 1, 0, 0, 0, 0}), 2300);           // nitrogen
    c.add(amounts_from_moles({0, 0.21, 0.79, 0, 0, 0, 0}), 2300);     // air
    c.add(amounts_from_moles({0, 0.02, 0.7, 0, 0.1, 0, 0.18}), 700);  // cold products
    c.add(amounts_from_moles({1, 0, 0, 0, 0, 1, 0}), 1500);           // fuel alone
    const cells start = c;
    for (const auto kind : all_models) {
        const chemistry_report r = advance(with(kind), 1e-4, c.view());
        CHECK(r.reacting == 0);
        CHECK(r.steps == 0);
        CHECK(c == start);
    }
    CHECK(advance({}, 0.0, c.view()).reacting == 0);
    c.temperature[0] = 1500;
    CHECK(advance({}, 1e-4, c.view()).reacting == 1);
}

TEST_CASE("chemistry: cells that are left out would have changed by less than the tolerance") {
    const std::uint64_t seed = 63;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    int left_out = 0;
    for (int i = 0; i < 20000; ++i) {
        CAPTURE(i);
        chemistry settings;
        if (i % 4 == 0) settings.mechanism.variant = jones_lindstedt::hydrogen_step::a;
        per_species n = any_mixture(random);
        if (i % 3 == 0) n[CH4] = n[CO] = n[H2] = 0;
        if (!(sum(n) > 0)) continue;
        n = amounts_from_moles(n);
        const double t = random.uniform(200, 1500), p = random.log_uniform(1e4, 1e6),
                     dt = random.log_uniform(1e-6, 1e3);
        cells c = one(n, t, p);
        if (advance(settings, dt, c.view()).reacting > 0) continue;
        ++left_out;
        reactor gas(settings.mechanism, n, t, p);
        extents e{};
        CHECK(integrate(gas, e, dt, {1e-6, 1e-10}).finished);
        const per_species m = gas.amount(e);
        // What products may dissociate into is bounded for each of H2 and CO; methane ends where the trace of O2 or H2O
        // does.
        for (std::size_t k = 0; k < species_count; ++k)
            CHECK(std::fabs(m[k] - n[k]) < 4 * settings.accuracy.absolute * sum(n));
    }
    CHECK(left_out > 2000);
}

TEST_CASE("chemistry: the mean rates are the change that advance makes, and leave the cells") {
    cells c = any_cells(40, 64);
    const cells start = c;
    std::array<std::vector<double>, species_count> rate;
    std::array<double*, species_count> out;
    for (std::size_t k = 0; k < species_count; ++k) {
        rate[k].assign(40, 99.0);
        out[k] = rate[k].data();
    }
    const double dt = 3e-5;
    const chemistry_report by_rates = mean_rates({}, dt, c.view(), out);
    CHECK(c == start);
    const chemistry_report by_advance = advance({}, dt, c.view());
    CHECK(by_rates.reacting == by_advance.reacting);
    for (std::size_t i = 0; i < 40; ++i) {
        double whole = 0;
        for (std::size_t k = 0; k < species_count; ++k) {
            CHECK(std::fabs(rate[k][i] * dt - (c.y[k][i] - start.y[k][i])) < 1e-15);
            whole += rate[k][i];
        }
        CHECK(std::fabs(whole * dt) < 1e-14);
    }
}

TEST_CASE("chemistry: mass fractions may lie species by species or cell by cell") {
    cells c = any_cells(20, 67);
    std::vector<double> together(20 * species_count), rate(20 * species_count, 99.0), temperature = c.temperature;
    cell_arrays interleaved{20, c.pressure.data(), temperature.data(), {}, species_count, nullptr};
    std::array<double*, species_count> out;
    for (std::size_t k = 0; k < species_count; ++k) {
        interleaved.mass_fraction[k] = &together[k];
        out[k] = &rate[k];
        for (std::size_t i = 0; i < 20; ++i) together[i * species_count + k] = c.y[k][i];
    }
    const cells start = c;
    CHECK(mean_rates({}, 1e-5, interleaved, out).failed == 0);
    CHECK(advance({}, 1e-5, interleaved).failed == 0);
    CHECK(advance({}, 1e-5, c.view()).failed == 0);
    CHECK(temperature == c.temperature);
    for (std::size_t k = 0; k < species_count; ++k)
        for (std::size_t i = 0; i < 20; ++i) {
            CHECK(together[i * species_count + k] == c.y[k][i]);
            CHECK(std::fabs(rate[i * species_count + k] * 1e-5 - (c.y[k][i] - start.y[k][i])) < 1e-15);
        }
}

TEST_CASE("chemistry: two halves are the whole, within the tolerance") {
    cells once = any_cells(40, 65), twice = once;
    chemistry settings;
    settings.accuracy = {1e-7, 1e-10};
    CHECK(advance(settings, 2e-5, once.view()).failed == 0);
    CHECK(advance(settings, 1e-5, twice.view()).failed == 0);
    CHECK(advance(settings, 1e-5, twice.view()).failed == 0);
    for (std::size_t i = 0; i < 40; ++i)
        for (std::size_t k = 0; k < species_count; ++k) CHECK(std::fabs(once.y[k][i] - twice.y[k][i]) < 1e-6);
}

TEST_CASE("chemistry: mixing at once is no mixing time, mixing never is no reaction, and between is the shorter time") {
    for (const auto kind : all_models) {
        const cells start = one(methane_air(0.9), 1600);
        cells fast = start, none = start, never = start;
        fast.mixing_time = {0.0};
        never.mixing_time = {infinity};
        CHECK(advance(with(kind), 1e-4, fast.view()).reacting == 1);
        CHECK(advance(with(kind), 1e-4, none.view()).reacting == 1);
        CHECK(advance(with(kind), 1e-4, never.view()).failed == 0);
        CHECK(fast.fractions(0) == none.fractions(0));
        CHECK(fast.temperature == none.temperature);
        CHECK(never.temperature[0] == doctest::Approx(1600).epsilon(1e-13));
        for (std::size_t k = 0; k < species_count; ++k) CHECK(std::fabs(never.y[k][0] - start.y[k][0]) < 1e-15);
    }
    // Finite rate: rates times the reacting fraction.
    const double t = 1600, p = 101325, mixing = 2e-5, dt = 3e-5;
    const per_species n = methane_air(0.9);
    const double share = reacting_fraction(chemical_time({}, t, p, mole_fractions(n)), mixing);
    CHECK(share > 0.05);
    CHECK(share < 0.95);
    cells stirred = one(n, t), shorter = one(n, t);
    stirred.mixing_time = {mixing};
    CHECK(advance({}, dt, stirred.view()).failed == 0);
    CHECK(advance({}, share * dt, shorter.view()).failed == 0);
    CHECK(stirred.fractions(0) == shorter.fractions(0));
    // Instant models: a share 1 - exp(-dt/mixing) of the way, in elements and enthalpy as well.
    cells half = one(n, t), full = one(n, t);
    const per_species before = half.fractions(0);
    half.mixing_time = {1e-4 / std::log(2.0)};
    CHECK(advance(with(chemistry::model::mixed_is_burnt), 1e-4, half.view()).enthalpy_imbalance < 1e-13);
    CHECK(advance(with(chemistry::model::mixed_is_burnt), 1e-4, full.view()).failed == 0);
    for (std::size_t k = 0; k < species_count; ++k)
        CHECK(half.y[k][0] == doctest::Approx(0.5 * (before[k] + full.y[k][0])).epsilon(1e-13));
}

TEST_CASE("chemistry: the models without rates burn above the ignition temperature only") {
    const per_species n = methane_air(1.0);
    for (const auto kind : {chemistry::model::equilibrium, chemistry::model::mixed_is_burnt}) {
        cells cold = one(n, 899), hot = one(n, 901);
        CHECK(advance(with(kind), 1e-4, cold.view()).reacting == 0);
        CHECK(cold.temperature[0] == 899);
        CHECK(advance(with(kind), 1e-4, hot.view()).reacting == 1);
        const mixture_state expected = kind == chemistry::model::equilibrium
                                           ? equilibrium(n, combine(n).enthalpy(901), 101325)
                                           : burn(n, combine(n).enthalpy(901));
        CHECK(hot.temperature[0] == doctest::Approx(expected.temperature).epsilon(1e-12));
    }
}

TEST_CASE("chemistry: cells hotter than the thermodynamics' range are counted") {
    cells c = one(amounts_from_moles({1, 2, 0, 0, 0, 0, 0}), 3000);  // methane in pure oxygen
    const chemistry_report r = advance({}, 1e-3, c.view());
    CHECK(r.extrapolated == 1);
    CHECK(c.temperature[0] > 3500);
    CHECK(r.enthalpy_imbalance < 1e-13);
}

TEST_CASE("chemistry: bad input is refused with place, index and value, and every cell stays as it was") {
    const cells good = any_cells(5, 66);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [&](cells bad, const std::string& place, const chemistry& settings = {}, double dt = 1e-4,
                             std::int64_t index = 3) {
        const cells before = bad;
        std::array<std::vector<double>, species_count> rate;
        std::array<double*, species_count> out;
        for (std::size_t k = 0; k < species_count; ++k) {
            rate[k].assign(5, 7.0);
            out[k] = rate[k].data();
        }
        for (const bool by_rates : {false, true}) try {
                const chemistry_report r =
                    by_rates ? mean_rates(settings, dt, bad.view(), out) : advance(settings, dt, bad.view());
                FAIL("accepted: " << place << r.reacting);
            } catch (const hearth::bad_value& error) {
                CHECK(error.place == place);
                CHECK(error.index == index);
                CHECK(std::string(error.what()).find(place) != std::string::npos);
            }
        for (std::size_t k = 0; k < species_count; ++k) {
            CHECK(rate[k] == std::vector<double>(5, 7.0));
            for (std::size_t i = 0; i < 5; ++i)
                CHECK((bad.y[k][i] == before.y[k][i] || (std::isnan(bad.y[k][i]) && std::isnan(before.y[k][i]))));
        }
    };
    for (const double t : {nan, 199.0, 6001.0, -5.0, infinity}) {
        cells bad = good;
        bad.temperature[3] = t;
        refused(bad, "temperature of cell");
    }
    for (const double p : {nan, 0.0, -1e5, infinity}) {
        cells bad = good;
        bad.pressure[3] = p;
        refused(bad, "pressure of cell");
    }
    for (std::size_t k = 0; k < species_count; ++k)
        for (const double y : {nan, -1e-8, -1.0}) {
            cells bad = good;
            bad.y[k][3] = y;
            refused(bad, std::string("mass fraction of ") + species_names[k] + " in cell");
        }
    for (const double extra : {1e-5, 0.1, infinity}) {
        cells bad = good;
        bad.y[N2][3] += extra;
        refused(bad, "sum of mass fractions in cell");
    }
    for (const double mixing : {nan, -1e-3}) {
        cells bad = good;
        bad.mixing_time = {0, 0, 0, mixing, 0};
        refused(bad, "mixing time of cell");
    }
    const std::int64_t none = hearth::bad_value::no_index;
    for (const double dt : {nan, -1e-6, infinity}) refused(good, "dt", {}, dt, none);
    chemistry settings;
    settings.accuracy.relative = 0;
    refused(good, "relative tolerance", settings, 1e-4, none);
    settings = {};
    settings.accuracy.absolute = -1;
    refused(good, "absolute tolerance", settings, 1e-4, none);
    settings = {};
    settings.mechanism.regularisation = 0;
    refused(good, "regularisation", settings, 1e-4, none);
    settings = {};
    settings.mechanism.water_seed = nan;
    refused(good, "water_seed", settings, 1e-4, none);
    settings = {};
    settings.ignition_temperature = nan;
    refused(good, "ignition_temperature", settings, 1e-4, none);
}

TEST_CASE("chemistry: a negative residue of transport passes through unchanged and takes nothing from the balance") {
    cells c = one(methane_air(0.9), 1600);
    c.y[CO][0] = -3e-10;
    cells clean = one(methane_air(0.9), 1600);
    CHECK(advance({}, 1e-4, c.view()).reacting == 1);
    CHECK(advance({}, 1e-4, clean.view()).reacting == 1);
    CHECK(c.y[CO][0] == doctest::Approx(clean.y[CO][0] - 3e-10).epsilon(1e-15));
    CHECK(c.y[CO2][0] == clean.y[CO2][0]);
    CHECK(c.temperature == clean.temperature);
}

TEST_CASE("chemistry: no cells is no work") {
    cells c;
    CHECK(advance({}, 1.0, c.view()).reacting == 0);
}
