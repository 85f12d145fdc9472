// SPDX-License-Identifier: MIT
// Stiff and extreme: tiny gas cells, Gamma 1e4, 3000 K, no slip and far too much, one particle, NaN.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/closure/ergun.hpp>
#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/gas_exchange.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/drag.hpp>
#include <hearth/transfer/radiation.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

const auto caloric_of = [](std::size_t) { return constant_specific_heat<>{840}; };

TEST_CASE("limits: a cell of 1 mm^3 round a 10 mm particle, where an explicit exchange would run to -8000 K in 1 ms") {
    const double gas_capacity = 3.56e-7, conductance = 0.0316;
    const std::vector<double> mass{1.3e-3};
    for (const double step : {1e-6, 1e-3, 1.0, 1e3}) {
        CAPTURE(step);
        std::vector<double> t{300.0};
        std::vector<particle_step<double>> taken;
        double gas = 400;
        gas_exchange exchange;
        exchange.prepare({conductance}, {gas}, mass, caloric_of, unsplit{}, step, t);
        const double stored = gas_capacity / step;
        const double after = (stored * gas + exchange.source()[0]) / (stored + exchange.coefficient()[0]);
        const double lost = exchange.finish({after}, mass, caloric_of, unsplit{}, t, taken);
        CHECK(after >= 300);
        CHECK(after <= 400);
        CHECK(t[0] <= after);
        CHECK(lost == doctest::Approx(gas_capacity * (gas - after)).epsilon(1e-9));
    }
    // The worked case: one step of 1 ms leaves the gas 1 / (1 + 88.8) of its lead.
    gas_exchange exchange;
    const std::vector<double> t{300.0};
    exchange.prepare({conductance}, {400.0}, mass, caloric_of, unsplit{}, 1e-3, t);
    const double stored = gas_capacity / 1e-3;
    CHECK((stored * 400 + exchange.source()[0]) / (stored + exchange.coefficient()[0]) ==
          doctest::Approx(300 + 100 / (1 + 88.8)).epsilon(1e-4));
}

TEST_CASE("limits: bed and dust of a millionth of its mass at 3000 K, Gamma 1e4, any step") {
    seeded random(2);
    std::vector<linked_pair<radiative_link<double>>> pairs;
    std::vector<heat_bath<double>> baths(60);
    std::vector<double> mass(60), start(60);
    for (int i = 0; i < 60; ++i) {
        const auto k = static_cast<std::size_t>(i);
        mass[k] = i % 2 == 0 ? 1e-2 : 1e-8;
        start[k] = random.uniform(300, 3000);
        for (int j = 0; j < i; j += 1 + static_cast<int>(random.index(6)))
            pairs.push_back({j, i, {random.log_uniform(1e-14, 1e-10)}});
    }
    baths[0].add(radiative_link<double>{1e-10}, 3000.0);
    for (const double step : {1e-9, 1e-3, 1.0, 1e9}) {
        CAPTURE(step);
        std::vector<double> t = start;
        std::vector<particle_step<double>> taken;
        const auto report = thermal_network().advance(pairs, baths, mass, caloric_of, tssm(1e4), step, t, taken);
        CHECK(report.converged);
        CHECK(*std::min_element(t.begin(), t.end()) >= 300 - 1e-9 * 2700);
        CHECK(*std::max_element(t.begin(), t.end()) <= 3000 + 1e-9 * 2700);
    }
}

TEST_CASE("limits: one particle alone, in a network and in a scene") {
    std::vector<double> t{500.0};
    std::vector<particle_step<double>> taken;
    std::vector<heat_bath<double>> bath(1);
    bath[0].add(conductive_link<double>{1.0}, 900.0);
    const auto report = thermal_network().advance(std::vector<thermal_pair>{}, bath, std::vector<double>{1e-3},
                                                  caloric_of, unsplit{}, 1e9, t, taken);
    CHECK(report.converged);
    CHECK(t[0] == doctest::Approx(900).epsilon(1e-9));

    warm_bed bed(1);
    radiation_params params;
    params.surroundings = 700;
    const auto list = scene{radiation{closure::feng_han::monte_carlo_fit{}, params}}.links(bed, bed);
    REQUIRE(list.surroundings.size() == 1);
    // It sees nothing but the surroundings, with all of its surface.
    const double surface = 4 * constants<double>::pi() * 0.005 * 0.005;
    CHECK(list.surroundings[0].link.radiation == doctest::Approx(constants<double>::stefan_boltzmann() * surface));
    CHECK(list.views[0].open == 1);
}

TEST_CASE("limits: no slip, and a Reynolds number of 1e8, give finite rates") {
    warm_bed bed(2);
    gas_samples gas(2);
    gas.velocity[0] = {0, 0, 0};
    gas.velocity[1] = {0, 0, 1e8 * 2.29e-5 / (0.8825 * 0.01 * 0.4)};
    const scene both{convection{closure::gunn{}}, drag{closure::ergun{}}};
    (void)both.accumulate(bed, gas, tssm(1e4));
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        CHECK(std::isfinite(bed.heat_rate[i]));
        CHECK(std::isfinite(bed.force[i][2]));
    }
    // Gunn at Re 0: Nu = 7 - 10 e + 5 e^2 = 3.8 at 0.4.
    CHECK(-gas.heat_rate[0] == doctest::Approx(3.8 * 0.0331 * constants<double>::pi() * 0.01 * 100).epsilon(1e-12));
    CHECK(gas.force[0][2] == 0);
}

TEST_CASE("limits: a NaN is not passed on in silence: the ledger of its term shows it") {
    warm_bed bed(3);
    gas_samples gas(3);
    bed.temperature[1] = std::numeric_limits<double>::quiet_NaN();
    const auto books = scene{drag{closure::ergun{}}, convection{closure::gunn{}}}.accumulate(bed, gas);
    CHECK(std::isnan(books[1].heat_from_gas));
    CHECK(std::isfinite(books[0].force_from_gas[2]));
    CHECK(std::isfinite(bed.heat_rate[0]));
}

}  // namespace
