// SPDX-License-Identifier: MIT
#include "heated_bed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <hearth/closure/air.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/time/through_flow.hpp>
#include <hearth/time/tssm.hpp>
#include <hearth/time/tssm_error.hpp>
#include <hearth/time/tssm_ledger.hpp>
#include <hearth/transfer/convection.hpp>

#include "rung_of.hpp"

namespace hearth::furnace::rungs {
namespace {

/// A thread of the bed, one sphere per cell.
struct spheres {
    double radius;                       ///< [m]
    std::array<double, 3> velocity{};    ///< [m/s]
    std::vector<double> temperature;     ///< [K]
};

/// The air at each of them.
struct stream {
    double void_fraction, density, viscosity, conductivity, specific_heat;
    std::array<double, 3> velocity;   ///< interstitial [m/s]
    std::vector<double> temperature;  ///< [K]
};

}  // namespace
}  // namespace hearth::furnace::rungs

template <>
struct hearth::particle_traits<hearth::furnace::rungs::spheres> {
    using index = std::size_t;
    using scalar = double;
    using bed = hearth::furnace::rungs::spheres;
    static index particle_count(const bed& b) { return b.temperature.size(); }
    static scalar get(quantity::radius, const bed& b, index) { return b.radius; }
    static scalar get(quantity::temperature, const bed& b, index i) { return b.temperature[i]; }
    static const auto& get(quantity::velocity, const bed& b, index) { return b.velocity; }
};

template <>
struct hearth::particle_traits<hearth::furnace::rungs::stream> {
    using index = std::size_t;
    using scalar = double;
    using gas = hearth::furnace::rungs::stream;
    static index particle_count(const gas& g) { return g.temperature.size(); }
    static scalar get(quantity::void_fraction, const gas& g, index) { return g.void_fraction; }
    static scalar get(quantity::gas_density, const gas& g, index) { return g.density; }
    static scalar get(quantity::gas_viscosity, const gas& g, index) { return g.viscosity; }
    static scalar get(quantity::gas_conductivity, const gas& g, index) { return g.conductivity; }
    static scalar get(quantity::gas_specific_heat, const gas& g, index) { return g.specific_heat; }
    static scalar get(quantity::gas_temperature, const gas& g, index i) { return g.temperature[i]; }
    static const auto& get(quantity::gas_velocity, const gas& g, index) { return g.velocity; }
};

namespace hearth::furnace::rungs {
namespace {

/// What the bed and the exact solution have in common, per cell of `cells`.
struct column {
    spheres bed;
    stream air;
    double spacing, area, sphere_mass, conductance, capacity_flow, gas_content;

    column(const heated_bed& s, int cells) : spacing(s.height / cells) {
        using closure::air;
        const auto n = static_cast<std::size_t>(cells);
        const double t = s.property_temperature, density = closure::air::density(s.gas_temperature, s.pressure);
        bed = {0.5 * s.diameter, {}, std::vector<double>(n, s.temperature)};
        this->air = {s.void_fraction,       density, air::viscosity(t), air::conductivity(t), air::specific_heat(t),
                     {0, 0, s.velocity / s.void_fraction}, std::vector<double>(n, s.temperature)};
        const double volume = pi / 6 * std::pow(s.diameter, 3);
        sphere_mass = s.density * volume;
        area = volume / (1 - s.void_fraction) / spacing;  // of the thread that one sphere per cell fills
        const scene bed_in_air{convection{closure::gunn{}}};
        std::vector<double> of_spheres;
        bed_in_air.gas_conductances(bed, this->air, of_spheres);
        conductance = of_spheres.front();
        capacity_flow = density * s.velocity * area * this->air.specific_heat;
        gas_content = s.void_fraction * density * this->air.specific_heat * area * spacing;
    }

    double transfer_units(double x) const { return conductance / capacity_flow * x / spacing; }
    double heat_transfer_coefficient() const { return conductance / (4 * pi * bed.radius * bed.radius); }
};

/// Schumann's temperature of the solid, 0 to 1 (J. Franklin Inst. 208 (1929) 405, doi:10.1016/S0016-0032(29)91186-8):
/// the integral of exp(-xi - s) I0(2 sqrt(xi s)) over s from 0 to tau, by Simpson's rule, to 1e-8.
double schumann(double xi, double tau) {
    if (!(tau > 0)) return 0;
    const auto integrand = [xi](double s) {
        const double z = 2 * std::sqrt(xi * s);  // far out the Bessel function overflows, and there it is exp(z)/sqrt(2 pi z)
        return z < 600 ? std::exp(-xi - s) * std::cyl_bessel_i(0.0, z) : std::exp(z - xi - s) / std::sqrt(2 * pi * z);
    };
    const int parts = 600;
    const double end = std::min(tau, xi + 12 * std::sqrt(xi) + 40), h = end / parts;
    double sum = integrand(0) + integrand(end);
    for (int k = 1; k < parts; ++k) sum += (k % 2 == 1 ? 4 : 2) * integrand(k * h);
    return sum * h / 3;
}

/// Temperature of the solid at a height after a process time [K].
double exact(const heated_bed& s, const column& c, double x, double time) {
    const double tau = c.conductance / (c.sphere_mass * s.specific_heat) * (time - x * s.void_fraction / s.velocity);
    return s.temperature + (s.gas_temperature - s.temperature) * schumann(c.transfer_units(x), tau);
}

struct variant {
    double factor = 1;
    gas_storage form = gas_storage::corrected;
    double step;
    int cells;
};

struct history {
    std::vector<std::vector<double>> at;  ///< per height: temperature at each sample [K]
    double seconds = 0, imbalance = 0;
};

/// The bed under one clock, from the start to the last sample.
history heat(const heated_bed& s, const variant& v) {
    column c(s, v.cells);
    const tssm clock(v.factor, v.form);
    tssm_ledger ledger(clock.gas_storage_factor());
    const constant_specific_heat<> caloric{s.specific_heat};
    history seen{std::vector<std::vector<double>>(s.heights.size()), 0, 0};
    const double began = cpu_seconds(), between = s.duration / s.samples;
    const auto steps = static_cast<long>(std::ceil(between / (v.factor * v.step) * (1 - 1e-12)));
    const double step = between / (v.factor * static_cast<double>(steps));
    for (int sample = 0; sample < s.samples; ++sample) {
        for (long n = 0; n < steps; ++n) {
            double inlet = s.gas_temperature;
            for (std::size_t i = 0; i < c.bed.temperature.size(); ++i) {
                double &solid = c.bed.temperature[i], &gas = c.air.temperature[i];
                const through_flow<> cell(c.capacity_flow, c.conductance, clock.gas_storage_factor() * c.gas_content / step, inlet, gas);
                const auto taken = etd2_secant::advance(solid, c.sphere_mass, caloric, cell.bath(), clock.factor(i) * step);
                const auto after = cell.settle(taken.heat / (clock.factor(i) * step));
                ledger.particle(taken.heat, clock.factor(i));
                ledger.gas(c.gas_content * (after.mean - gas));
                solid = taken.temperature;
                gas = after.mean;
                inlet = after.outlet;
            }
            ledger.boundary(c.capacity_flow * (s.gas_temperature - inlet) * step);
        }
        for (std::size_t h = 0; h < s.heights.size(); ++h) {
            const double place = s.heights[h] / c.spacing - 0.5;
            const auto last = static_cast<double>(v.cells - 2);
            const auto i = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, last));
            const double part = place - static_cast<double>(i);
            seen.at[h].push_back((1 - part) * c.bed.temperature[i] + part * c.bed.temperature[i + 1]);
        }
    }
    seen.seconds = cpu_seconds() - began;
    seen.imbalance = ledger.relative_imbalance();
    return seen;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b, bool in_celsius = false) {
    double worst = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        worst = std::max(worst, std::abs(a[k] - b[k]) / (in_celsius ? std::max(1.0, b[k] - 273.15) : 1.0));
    }
    return worst;
}

double particle_steps(const heated_bed& s) {
    double sum = 1;
    for (const double f : s.factors) sum += 3 / f;
    return (sum + 1.0 / s.compared * 12) * s.duration / s.step * s.cells;
}

}  // namespace

void check(const heated_bed& scene) {
    for (const double x : scene.heights) {
        if (x > scene.height) {
            throw bad_scene("bed.heights_mm holds " + format(x * 1e3) + ", allowed: up to the bed's height, " + format(scene.height * 1e3));
        }
    }
}

rung_plan foresee(const heated_bed& scene) {
    rung_plan p;
    p.builds = std::to_string(scene.cells) + " cells in a row, one sphere each; " + format(scene.duration) + " s of process time for Gamma 1 and " +
               std::to_string(scene.factors.size()) + " more, three forms of the gas's storage";
    p.memory = 20e6 + 16.0 * scene.cells;
    p.seconds = 0.1 + 5e-8 * particle_steps(scene);
    p.left_out = {{"motion, contacts", "the bed is fixed", "all of DEM"},
                  {"conduction, radiation", "kind = \"heated_bed\" is Schumann's bed", "all pairs of particles"},
                  {"momentum", "the bed is uniform and so is the mass flux", "the flow solver"},
                  {"species, combustion", "the gas is air", "two fields per cell"}};
    return p;
}

rung_result run(const heated_bed& s, const watcher& watch) {
    rung_result r;
    const column bed(s, s.cells);
    const std::size_t heights = s.heights.size(), last = heights - 1;
    std::vector<double> time, exact_last_late(static_cast<std::size_t>(s.samples));
    std::vector<std::vector<double>> truth(heights);
    const double delay = tssm_delay(s.compared, gas_storage::paper, s.heights[last], s.velocity / s.void_fraction);
    for (int k = 1; k <= s.samples; ++k) {
        time.push_back(s.duration * k / s.samples);
        for (std::size_t h = 0; h < heights; ++h) truth[h].push_back(exact(s, bed, s.heights[h], time.back()));
        exact_last_late[static_cast<std::size_t>(k - 1)] = exact(s, bed, s.heights[last], time.back() - delay);
    }
    double work = 0;
    const auto run_one = [&](const variant& v, const char* what) {
        char at[80];
        std::snprintf(at, sizeof at, "Gamma %g, %s", v.factor, what);
        watch(std::min(1.0, work / particle_steps(s)), at);
        history h = heat(s, v);
        work += s.duration / (v.factor * v.step) * v.cells;
        return h;
    };

    const history plain = run_one({1, gas_storage::corrected, s.step, s.cells}, "without splitting");
    const history paper = run_one({s.compared, gas_storage::paper, s.step, s.cells}, "as the paper");
    const history corrected = run_one({s.compared, gas_storage::corrected, s.step, s.cells}, "storage corrected");

    curves temperatures{"temperatures.csv", {{"time_s", time}}};
    for (std::size_t h = 0; h < heights; ++h) {
        const std::string place = "_" + format(s.heights[h] * 1e3) + "_mm_K";
        temperatures.columns.push_back({"exact" + place, truth[h]});
        temperatures.columns.push_back({"gamma_1" + place, plain.at[h]});
        temperatures.columns.push_back({"paper" + place, paper.at[h]});
        temperatures.columns.push_back({"corrected" + place, corrected.at[h]});
    }
    r.tables.push_back(temperatures);

    // Error against run time over what can be turned: Gamma and form, step, cells.  The highest place is the worst.
    const auto error = [&](const history& h) { return largest_difference(h.at[last], truth[last]); };
    curves by_factor{"over_gamma.csv", {{"acceleration_factor", {}}, {"law_K", {}}}};
    for (const char* form : {"paper", "corrected", "quasi_steady"}) {
        by_factor.columns.push_back({std::string(form) + "_error_K", {}});
        by_factor.columns.push_back({std::string(form) + "_time_s", {}});
    }
    std::vector<double> factors = s.factors;
    std::sort(factors.begin(), factors.end());
    for (const double factor : factors) {
        by_factor.columns[0].second.push_back(factor);
        const tssm_bed place{bed.gas_content / (bed.sphere_mass * s.specific_heat), bed.transfer_units(s.heights[last])};
        by_factor.columns[1].second.push_back((s.gas_temperature - s.temperature) * tssm_error(factor, gas_storage::paper, place));
        std::size_t at = 2;
        for (const gas_storage form : {gas_storage::paper, gas_storage::corrected, gas_storage::quasi_steady}) {
            const history h = run_one({factor, form, s.step, s.cells}, "error against time");
            by_factor.columns[at++].second.push_back(error(h));
            by_factor.columns[at++].second.push_back(h.seconds);
        }
    }
    r.tables.push_back(by_factor);
    curves by_step{"over_step.csv", {{"process_step_s", {}}, {"error_K", {}}, {"time_s", {}}}};
    for (const double times : {1.0, 4.0, 16.0, 64.0, 256.0}) {
        const history h = run_one({s.compared, gas_storage::corrected, s.step * times, s.cells}, "longer steps");
        by_step.columns[0].second.push_back(s.step * times * s.compared);
        by_step.columns[1].second.push_back(error(h));
        by_step.columns[2].second.push_back(h.seconds);
    }
    r.tables.push_back(by_step);
    curves by_cells{"over_cells.csv", {{"cells", {}}, {"error_K", {}}, {"time_s", {}}}};
    for (int cells = std::max(2, s.cells / 16); cells <= 4 * s.cells; cells *= 2) {
        const history h = run_one({s.compared, gas_storage::corrected, s.step, cells}, "other meshes");
        by_cells.columns[0].second.push_back(cells);
        by_cells.columns[1].second.push_back(error(h));
        by_cells.columns[2].second.push_back(h.seconds);
    }
    r.tables.push_back(by_cells);

    const std::string gamma = format(s.compared), place = format(s.heights[last] * 1e3) + " mm";
    const double span = s.gas_temperature - s.temperature;
    r.findings = {
        {"heat_transfer_coefficient_W_per_m2K", "heat transfer coefficient", "", bed.heat_transfer_coefficient(), "W/(m2 K)"},
        {"transfer_units", "transfer units up to " + place, "", bed.transfer_units(s.heights[last]), "-"},
        {"gamma_1_error_K", "Gamma 1 off Schumann at " + place, "0", error(plain), "K"},
        {"paper_deviation_percent", "Gamma " + gamma + " as the paper off Gamma 1", "8 (paper)",
         100 * largest_difference(paper.at[last], plain.at[last]) / span, "% of the step"},
        {"paper_deviation_percent_of_celsius", "  the same", "8 (paper)",
         100 * largest_difference(paper.at[last], plain.at[last], true), "% of T in C"},
        {"delay_law_percent", "  the law: late by (Gamma - 1) x / u", "", 100 * largest_difference(truth[last], exact_last_late) / span,
         "% of the step"},
        {"corrected_deviation_percent", "Gamma " + gamma + ", storage corrected", "0",
         100 * largest_difference(corrected.at[last], plain.at[last]) / span, "% of the step"},
        {"time_share_percent", "run time of Gamma " + gamma + " over Gamma 1", "2 (paper)", 100 * paper.seconds / plain.seconds, "%"},
        {"energy_imbalance", "energy lost over energy moved, Gamma " + gamma, "0", corrected.imbalance, "-", "%.1e"}};
    watch(1, "done");
    return r;
}

}  // namespace hearth::furnace::rungs
