// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/ergun.hpp>
#include <hearth/closure/ergun_wen_yu.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/drag.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

TEST_CASE("drag: a resting bed takes Ergun's pressure drop, by drag and by its share of the gradient") {
    warm_bed bed(1);
    gas_samples gas(1);
    // Ergun by hand: d 10 mm, e 0.4, U = 0.5 m/s.
    const double e = 0.4, d = 0.01, U = 0.5, mu = gas.viscosity[0], rho = gas.density[0];
    const double gradient =
        150 * (1 - e) * (1 - e) * mu * U / (e * e * e * d * d) + 1.75 * (1 - e) * rho * U * U / (e * e * e * d);
    gas.pressure_gradient[0] = {0, 0, -gradient};
    const auto books = scene{drag{closure::ergun{}}}.accumulate(bed, gas);
    // Gas at steady flow: -e grad p = n V-mean drag; a volume of bed holds (1-e)/V_p particles.  All of the pressure
    // drop ends on the particles: F (1-e)/V_p = -grad p.
    const double volume = 3.14159265358979 / 6 * d * d * d;
    CHECK(bed.force[0][2] * (1 - e) / volume == doctest::Approx(gradient).epsilon(1e-12));
    CHECK(-gas.force[0][2] * (1 - e) / volume == doctest::Approx(e * gradient).epsilon(1e-12));
    CHECK(books[0].force_from_gas[2] == -gas.force[0][2]);
    CHECK(books[0].force_from_pressure[2] == doctest::Approx(volume * gradient).epsilon(1e-12));
    CHECK(bed.force[0][0] == 0);
    CHECK(bed.heat_rate[0] == 0);
}

TEST_CASE("drag: a closure of model B leaves the pressure to the drag") {
    warm_bed bed(1);
    gas_samples gas(1);
    (void)scene{drag{closure::ergun_wen_yu{}}}.accumulate(bed, gas);
    CHECK(bed.force[0][2] == -gas.force[0][2]);
    CHECK(bed.force[0][2] > 0);
}

TEST_CASE("drag: sees the true velocity and is not multiplied by Gamma") {
    warm_bed bed(2);
    gas_samples gas(2);
    for (auto& gradient : gas.pressure_gradient) gradient = {0, 0, 0};
    bed.velocity[1] = {0, 0, 678 * 1.25};
    (void)scene{drag{closure::ergun{}}}.accumulate(bed, gas, tssm(678));
    CHECK(std::fabs(bed.force[1][2]) < 1e-15);  // moves with the gas in truth
    CHECK(bed.force[0][2] > 0);
    warm_bed rest(1);
    gas_samples same(1);
    same.pressure_gradient[0] = {0, 0, 0};
    (void)scene{drag{closure::ergun{}}}.accumulate(rest, same);
    CHECK(rest.force[0][2] == bed.force[0][2]);
}

}  // namespace
