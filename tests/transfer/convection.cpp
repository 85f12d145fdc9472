// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/closure/gunn.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/convection.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

constexpr double pi = constants<double>::pi();

// One particle of 10 mm in gas of void fraction 0.4, Pr 0.7 and Re 100 on the superficial slip: Gunn's Nu
// is 22.26700004 (evaluated in 30 digits).
struct at_reynolds_100 {
    warm_bed bed{1};
    gas_samples gas{1};
    at_reynolds_100() {
        gas.viscosity[0] = 2e-5;
        gas.specific_heat[0] = 1000;
        gas.conductivity[0] = 2e-5 * 1000 / 0.7;
        gas.density[0] = 1;
        gas.velocity[0] = {0, 100 * 2e-5 / (1 * 0.01 * 0.4), 0};
    }
};

TEST_CASE("convection: is Nu k / d times the sphere's surface, on the superficial slip") {
    at_reynolds_100 c;
    const scene warm{convection{closure::gunn{}}};
    const auto books = warm.accumulate(c.bed, c.gas);
    const double exact = 22.26700004 * c.gas.conductivity[0] * pi * 0.01 * (400 - 300);
    CHECK(c.bed.heat_rate[0] == doctest::Approx(exact).epsilon(1e-9));
    CHECK(c.gas.heat_rate[0] == -c.bed.heat_rate[0]);
    CHECK(books[0].heat_from_gas == c.bed.heat_rate[0]);
}

TEST_CASE("convection: the slip is with the velocity over Gamma, the particle's heat times Gamma, the gas's once") {
    at_reynolds_100 c;
    const std::array<double, 3> wind = c.gas.velocity[0];
    for (std::size_t a = 0; a < 3; ++a) {
        c.bed.velocity[0][a] = 678 * 0.25 * wind[a];
        c.gas.velocity[0][a] = 1.25 * wind[a];  // slip as before
    }
    const scene warm{convection{closure::gunn{}}};
    (void)warm.accumulate(c.bed, c.gas, tssm(678));
    const double exact = 22.26700004 * c.gas.conductivity[0] * pi * 0.01 * (400 - 300);
    CHECK(c.gas.heat_rate[0] == doctest::Approx(-exact).epsilon(1e-9));
    CHECK(c.bed.heat_rate[0] == doctest::Approx(678 * exact).epsilon(1e-9));
}

TEST_CASE("convection: conduction inside the particle lowers h, and counts where Bi passes 0.3") {
    at_reynolds_100 c;
    c.bed.conductivity[0] = 0.5;
    std::vector<double> plain, corrected;
    closure::biot_report report;
    scene{convection{closure::gunn{}}}.gas_conductances(c.bed, c.gas, plain);
    scene{convection{closure::gunn{}, parabolic_particle{}}}.gas_conductances(c.bed, c.gas, corrected);
    const double h = plain[0] / (pi * 1e-4);
    CHECK(corrected[0] / (pi * 1e-4) == doctest::Approx(1 / (1 / h + 0.01 / (10 * 0.5))).epsilon(1e-14));

    const scene counting{convection{closure::gunn{}, counted_parabolic_particle{report}}};
    std::vector<double> counted;
    counting.gas_conductances(c.bed, c.gas, counted);
    CHECK(counted[0] == corrected[0]);
    CHECK(report.evaluations == 1);
    CHECK(report.above_limit == 0);
    c.bed.conductivity[0] = 0.2;  // Bi = h d / (6 k) = 0.53
    counting.gas_conductances(c.bed, c.gas, counted);
    CHECK(report.above_limit == 1);
    CHECK(report.largest == doctest::Approx(h * 0.01 / (6 * 0.2)));
}

TEST_CASE("convection: a bed and its gas exchange to round-off the same") {
    const std::size_t count = 500;
    warm_bed bed(count);
    gas_samples gas(count);
    seeded random(21);
    for (std::size_t i = 0; i < count; ++i) {
        bed.temperature[i] = random.uniform(300, 2200);
        bed.radius[i] = random.uniform(0.004, 0.01);
        gas.temperature[i] = random.uniform(300, 2200);
        bed.velocity[i] = {0, 0, random.uniform(-0.5, 0)};
    }
    const auto books = scene{convection{closure::gunn{}}}.accumulate(bed, gas, tssm(678));
    double particles = 0, received = 0, size = 0;
    for (std::size_t i = 0; i < count; ++i) {
        particles += bed.heat_rate[i] / 678;
        received += gas.heat_rate[i];
        size += std::fabs(gas.heat_rate[i]);
    }
    CHECK(std::fabs(particles + received) < 1e-15 * count * size);
    CHECK(std::fabs(books[0].heat_from_gas + received) < 1e-15 * count * size);
}

}  // namespace
