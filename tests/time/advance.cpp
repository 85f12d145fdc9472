// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/time/advance.hpp>
#include <hearth/time/caloric.hpp>

#include "support/random.hpp"

using namespace hearth;

namespace {

const auto caloric_of = [](std::size_t) { return constant_specific_heat<>{900}; };

TEST_CASE("advance: each particle takes its step in its own time") {
    std::vector<heat_bath<double>> baths(3);
    for (auto& bath : baths) bath.add(conductive_link<double>{0.05}, 500.0);
    const std::vector<double> mass(3, 1e-3), factors{1.0, 10.0, 678.0};
    std::vector<double> t(3, 300.0);
    std::vector<particle_step<double>> taken;
    advance(baths, mass, caloric_of, tssm_per_particle(678.0, factors), 0.1, t, taken);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(t[i] == doctest::Approx(500 - 200 * std::exp(-0.05 / 0.9 * factors[i] * 0.1)).epsilon(1e-14));
        CHECK(taken[i].heat == doctest::Approx(0.9 * (t[i] - 300)).epsilon(1e-12));
    }
    std::vector<double> implicit(3, 300.0);
    advance<backward_euler>(baths, mass, caloric_of, unsplit{}, 0.1, implicit, taken);
    CHECK(implicit[0] == doctest::Approx((300 + 0.1 * 0.05 / 0.9 * 500) / (1 + 0.1 * 0.05 / 0.9)).epsilon(1e-13));
}

TEST_CASE("advance: no particles, nothing done") {
    std::vector<double> none;
    std::vector<particle_step<double>> taken(3);
    advance({}, none, caloric_of, unsplit{}, 1.0, none, taken);
    CHECK(taken.empty());
}

TEST_CASE("advance: bad input is named by place and index, and nothing changes") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    const auto refused = [](auto spoil, const char* place) {
        CAPTURE(place);
        std::vector<heat_bath<double>> baths(2);
        std::vector<double> mass(2, 1.0), factors(2, 1.0), t{300.0, 400.0};
        double heat = 900, step = 1;
        spoil(baths[1], mass[1], factors[1], t[1], heat, step);
        const double other = t[0];
        std::vector<particle_step<double>> taken;
        try {
            advance(
                baths, mass, [&](std::size_t) { return constant_specific_heat<>{heat}; },
                tssm_per_particle(1.0, factors), step, t, taken);
            FAIL_CHECK("accepted");
        } catch (const bad_value& error) {
            CHECK(error.place == place);
        }
        CHECK(t[0] == other);
        CHECK(taken.empty());
    };
    for (const double bad : {nan, infinite, 0.0, -1.0}) {
        refused([&](auto&, auto&, auto&, double& t, auto&, auto&) { t = bad; }, "temperature of particle");
        refused([&](auto&, double& m, auto&, auto&, auto&, auto&) { m = bad; }, "mass of particle");
        refused([&](auto&, auto&, double& f, auto&, auto&, auto&) { f = bad; }, "acceleration_factor");
        refused([&](auto&, auto&, auto&, auto&, double& c, auto&) { c = bad; }, "specific_heat of particle");
        refused([&](auto&, auto&, auto&, auto&, auto&, double& s) { s = bad; }, "step");
    }
    refused([&](auto& b, auto&, auto&, auto&, auto&, auto&) { b.radiation = nan; }, "bath radiation of particle");
    refused([&](auto& b, auto&, auto&, auto&, auto&, auto&) { b.conductance = -1; }, "bath conductance of particle");
}

}  // namespace
