// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/time/caloric.hpp>
#include <hearth/time/gas_exchange.hpp>

#include "support/random.hpp"

using namespace hearth;
using hearth_test::seeded;

namespace {

// Particles over a row of cells, each spread over a few of them (rows of W sum to 1).  Gas flows through the row and is
// solved implicitly, upwind, cell by cell.
struct bed_in_gas {
    std::size_t cells, particles;
    std::vector<std::vector<double>> w;  // particle by cell
    std::vector<double> gas, gas_capacity, temperature, mass, conductance, factor;
    double flow, inlet, low = 1e300, high = 0;

    explicit bed_in_gas(std::uint64_t seed, double gamma) {
        seeded random(seed);
        cells = 1 + random.index(12);
        particles = 1 + random.index(40);
        flow = random.uniform(0, 1) < 0.3 ? 0.0 : random.log_uniform(1e-3, 10);
        inlet = random.uniform(300, 2200);
        const auto in_range = [&](double t) {
            low = std::min(low, t);
            high = std::max(high, t);
            return t;
        };
        in_range(inlet);
        for (std::size_t c = 0; c < cells; ++c) {
            gas.push_back(in_range(random.uniform(300, 2200)));
            gas_capacity.push_back(random.log_uniform(3e-7, 3e-4));
        }
        for (std::size_t p = 0; p < particles; ++p) {
            std::vector<double> row(cells, 0.0);
            double sum = 0;
            for (double& weight : row) sum += weight = random.uniform(0, 1) < 0.4 ? random.uniform(0, 1) : 0.0;
            if (sum == 0) row[0] = sum = 1;
            for (double& weight : row) weight /= sum;
            w.push_back(row);
            temperature.push_back(in_range(random.uniform(300, 2200)));
            mass.push_back(random.log_uniform(1e-5, 1e-2));
            conductance.push_back(random.log_uniform(1e-4, 1));
            factor.push_back(random.uniform(0, 1) < 0.2 ? 1.0 : gamma);
        }
    }

    std::vector<double> gather() const {
        std::vector<double> at(particles, 0.0);
        for (std::size_t p = 0; p < particles; ++p)
            for (std::size_t c = 0; c < cells; ++c) at[p] += w[p][c] * gas[c];
        return at;
    }
    std::vector<double> scatter(const std::vector<double>& q) const {
        std::vector<double> field(cells, 0.0);
        for (std::size_t p = 0; p < particles; ++p)
            for (std::size_t c = 0; c < cells; ++c) field[c] += w[p][c] * q[p];
        return field;
    }
    /// One implicit step of the gas; returns the heat that entered with the flow [J].
    double step_gas(const gas_exchange& exchange, double storage_factor, double step) {
        const auto diagonal = scatter(exchange.coefficient()), source = scatter(exchange.source());
        double upstream = inlet;
        for (std::size_t c = 0; c < cells; ++c) {
            const double stored = storage_factor * gas_capacity[c] / step;
            gas[c] = (stored * gas[c] + flow * upstream + source[c]) / (stored + flow + diagonal[c]);
            upstream = gas[c];
        }
        return flow * (inlet - upstream) * step;
    }
};

template <class CaloricOf>
void bounded_and_conservative(const CaloricOf& caloric_of, bool bent) {
    for (std::uint64_t seed = 1; seed <= 2000; ++seed)
        for (const double gamma : {1.0, 678.0}) {
            CAPTURE(seed);
            CAPTURE(gamma);
            bed_in_gas bed(seed, gamma);
            const double step = seeded(seed).log_uniform(1e-6, 1e3);
            const tssm_per_particle clock(gamma, bed.factor);
            gas_exchange exchange;
            std::vector<particle_step<double>> taken;
            double stored = 0, supplied = 0, turnover = 0;
            for (int n = 0; n < 3; ++n) {
                const auto gas_before = bed.gas;
                std::vector<double> at_particles = bed.gather();
                double entered = 0;
                int passes = 0;
                do {
                    bed.gas = gas_before;
                    exchange.prepare(bed.conductance, at_particles, bed.mass, caloric_of, clock, step, bed.temperature);
                    entered = bed.step_gas(exchange, clock.gas_storage_factor(), step);
                    at_particles = bed.gather();
                    ++passes;
                } while (exchange.overshoots(at_particles, bed.mass, caloric_of, clock, bed.temperature) > 0);
                CHECK(passes <= (bent ? 30 : 1));
                supplied += entered;
                const double lost = exchange.finish(at_particles, bed.mass, caloric_of, clock, bed.temperature, taken);
                double received = 0, size = 0;
                for (std::size_t p = 0; p < bed.particles; ++p) {
                    received += taken[p].heat / bed.factor[p];
                    size += std::fabs(taken[p].heat / bed.factor[p]);
                }
                REQUIRE(std::fabs(lost - received) <= 1e-14 * size);
                for (std::size_t c = 0; c < bed.cells; ++c) {
                    const double capacity = clock.gas_storage_factor() * bed.gas_capacity[c];
                    stored += capacity * (bed.gas[c] - gas_before[c]);
                    turnover += capacity * bed.gas[c];
                }
                for (std::size_t p = 0; p < bed.particles; ++p) {
                    stored += taken[p].heat / bed.factor[p];
                    turnover += std::fabs(taken[p].heat / bed.factor[p]) + bed.conductance[p] * step * 2200;
                }
                turnover += bed.flow * step * 2200;
                const double room = 1e-9 * (bed.high - bed.low);
                for (const auto* field : {&bed.gas, &bed.temperature})
                    for (const double t : *field) {
                        REQUIRE(t >= bed.low - room);
                        REQUIRE(t <= bed.high + room);
                    }
            }
            REQUIRE(std::fabs(stored - supplied) <= 1e-12 * turnover);
        }
}

TEST_CASE("gas exchange: bounded and conservative for steps of 1e-6 to 1e3 s, Gamma 1 and 678") {
    const constant_specific_heat<> plain{1000};
    bounded_and_conservative([&](std::size_t) { return plain; }, false);
}

TEST_CASE("gas exchange: the same with a specific heat that bends") {
    const polynomial_specific_heat<2> bent{{950.0, 0.28}, -1.3e7};
    bounded_and_conservative([&](std::size_t) { return bent; }, true);
}

TEST_CASE("gas exchange: tends to the exact exchange of one particle with one cell, at first order") {
    const double capacity = 2.0, gas_capacity = 0.5, conductance = 0.1, time = 4;
    const constant_specific_heat<> caloric{1000};
    const auto caloric_of = [&](std::size_t) { return caloric; };
    const std::vector<double> mass{capacity / 1000};
    const auto error = [&](int steps) {
        double gas = 400;
        std::vector<double> t{300.0};
        std::vector<particle_step<double>> taken;
        gas_exchange exchange;
        const double step = time / steps;
        for (int n = 0; n < steps; ++n) {
            exchange.prepare({conductance}, {gas}, mass, caloric_of, unsplit{}, step, t);
            gas =
                (gas_capacity / step * gas + exchange.source()[0]) / (gas_capacity / step + exchange.coefficient()[0]);
            (void)exchange.finish({gas}, mass, caloric_of, unsplit{}, t, taken);
        }
        const double rate = conductance * (1 / capacity + 1 / gas_capacity);
        const double mixed = (capacity * 300 + gas_capacity * 400) / (capacity + gas_capacity);
        return std::fabs(t[0] - (mixed + (300 - mixed) * std::exp(-rate * time)));
    };
    CHECK(error(40) / error(80) == doctest::Approx(2).epsilon(0.05));
    CHECK(error(1000) < 0.02);
}

TEST_CASE("gas exchange: bad input is named and changes nothing") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](double temperature, double gas, double mass, double heat, double conductance, double step,
                            double factor, const char* place) {
        std::vector<double> t{300.0, temperature};
        const std::vector<double> factors{1.0, factor};
        gas_exchange exchange;
        try {
            exchange.prepare(
                {0.1, conductance}, {400.0, gas}, std::vector<double>{1.0, mass},
                [&](std::size_t) { return constant_specific_heat<>{heat}; }, tssm_per_particle(1.0, factors), step, t);
            FAIL_CHECK("accepted");
        } catch (const bad_value& error) {
            CHECK(error.place == place);
        }
        CHECK(exchange.coefficient().empty());
    };
    for (const double bad : {nan, 0.0, -5.0}) {
        refused(bad, 400, 1, 900, 0.1, 1, 1, "temperature of particle");
        refused(300, bad, 1, 900, 0.1, 1, 1, "gas temperature at particle");
        refused(300, 400, bad, 900, 0.1, 1, 1, "mass of particle");
        refused(300, 400, 1, bad, 0.1, 1, 1, "specific_heat of particle");
        refused(300, 400, 1, 900, 0.1, bad, 1, "step");
        refused(300, 400, 1, 900, 0.1, 1, bad, "acceleration_factor");
    }
    refused(300, 400, 1, 900, -0.1, 1, 1, "gas conductance of particle");
    refused(300, 400, 1, 900, nan, 1, 1, "gas conductance of particle");

    const auto caloric_of = [](std::size_t) { return constant_specific_heat<>{900}; };
    std::vector<double> t{300.0};
    std::vector<particle_step<double>> taken;
    gas_exchange exchange;
    exchange.prepare({0.1}, {400.0}, std::vector<double>{1.0}, caloric_of, unsplit{}, 1.0, t);
    CHECK_THROWS_AS((void)exchange.finish({nan}, std::vector<double>{1.0}, caloric_of, unsplit{}, t, taken), bad_value);
    CHECK_THROWS_AS((void)exchange.finish({}, std::vector<double>{1.0}, caloric_of, unsplit{}, t, taken), bad_value);
    CHECK(t[0] == 300.0);
}

TEST_CASE("gas exchange: no particles, no exchange") {
    const auto caloric_of = [](std::size_t) { return constant_specific_heat<>{900}; };
    std::vector<double> none;
    std::vector<particle_step<double>> taken;
    gas_exchange exchange;
    exchange.prepare({}, {}, none, caloric_of, unsplit{}, 1.0, none);
    CHECK(exchange.finish({}, none, caloric_of, unsplit{}, none, taken) == 0.0);
}

}  // namespace
