// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <hearth/closure/drag.hpp>
#include <hearth/closure/ergun_wen_yu.hpp>
#include <hearth/closure/gidaspow.hpp>

#include "support/drag_table.hpp"

using namespace hearth::closure;

TEST_CASE("drag: Reynolds number on the interstitial slip") {
    // 1.2 * 3 * 0.014 / 1.8e-5
    CHECK(reynolds(bed_flow<double>{0.4, 3, 1.2, 1.8e-5, 0.014}) == doctest::Approx(2800).epsilon(1e-15));
}

TEST_CASE("drag: forces on the particles and pressure gradient balance") {
    for (const auto& row : hearth_test::drag_table) {
        const auto flow = hearth_test::flow_of(row);
        const double particles_per_volume =
            (1 - flow.void_fraction) / (3.14159265358979324 / 6 * flow.diameter * flow.diameter * flow.diameter);
        const double beta = exchange_coefficient(gidaspow{}, flow);
        // a handful of roundings each
        CHECK(particles_per_volume * particle_coefficient(gidaspow{}, flow) == doctest::Approx(beta).epsilon(1e-14));
        // model a: 0 = -e dp/dx - beta u
        CHECK(flow.void_fraction * pressure_gradient(gidaspow{}, flow) ==
              doctest::Approx(beta * flow.slip_speed).epsilon(1e-14));
    }
}

TEST_CASE("drag: models a and b of the same closure make the same pressure drop") {
    for (const auto& row : hearth_test::drag_table) {
        const auto flow = hearth_test::flow_of(row);
        CHECK(pressure_gradient(ergun_wen_yu{}, flow) ==
              doctest::Approx(pressure_gradient(gidaspow{}, flow)).epsilon(1e-14));
        CHECK(exchange_coefficient(ergun_wen_yu{}, flow) * flow.void_fraction ==
              doctest::Approx(exchange_coefficient(gidaspow{}, flow)).epsilon(1e-14));
    }
}

TEST_CASE("drag: a single slow sphere feels Stokes' drag") {
    const bed_flow<double> flow{1, 1e-12, 1.2, 1.8e-5, 0.014};
    // 3 pi mu d; the inertial term is 0.15 Re^0.687 = 6e-9 of it
    CHECK(particle_coefficient(wen_yu{}, flow) ==
          doctest::Approx(3 * 3.14159265358979324 * 1.8e-5 * 0.014).epsilon(1e-8));
    CHECK(exchange_coefficient(wen_yu{}, flow) == 0);
}
