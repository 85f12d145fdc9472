// SPDX-License-Identifier: MIT
// What every closure must have, over the list of all closures in support/closure_probes.hpp.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/closure_condition.hpp"
#include "support/closure_probes.hpp"

using namespace hearth_test;

TEST_CASE_TEMPLATE("every closure: rounds like its condition number in any precision", Real, float, double) {
    const double epsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
    for_each_closure([&](const auto& probe) {
        using probe_type = std::decay_t<decltype(probe)>;
        seeded random(11);
        CAPTURE(std::string(probe_type::about().name));
        for (int n = 0; n < 300; ++n) {
            CAPTURE(n);
            const auto x = as<Real>(draw<probe_type>(random));
            const auto exact_x = as<long double>(x);
            const long double exact = probe(exact_x.data());
            const double error = relative_error(probe(x.data()), exact);
            REQUIRE(error <= (round_offs + 2 * condition(probe, exact_x)) * epsilon);
        }
    });
}

TEST_CASE("every closure: keeps its units") {
    // New units of 3 lengths, 5 masses, 7 times and 2 temperatures: no wrong power can come out right by chance.
    const auto factor = [](const dimension& unit) {
        return std::pow(3.0L, unit.length) * std::pow(5.0L, unit.mass) * std::pow(7.0L, unit.time) *
               std::pow(2.0L, unit.temperature);
    };
    int scaled_closures = 0;
    for_each_closure([&](const auto& probe) {
        using probe_type = std::decay_t<decltype(probe)>;
        constexpr auto about = probe_type::about();
        if (about.units == scaling::none) return;  // scaled by hand in the closure's own test
        ++scaled_closures;
        CAPTURE(std::string(about.name));
        seeded random(14);
        for (int n = 0; n < 50; ++n) {
            CAPTURE(n);
            const auto x = as<long double>(draw<probe_type>(random));
            auto scaled = x;
            for (std::size_t i = 0; i < x.size(); ++i) scaled[i] *= factor(about.inputs[i].unit);
            const long double expected = probe(x.data()) * factor(about.output);
            const double relative = relative_error(probe(scaled.data()), expected);
            REQUIRE(relative <= (2 * round_offs + 2 * condition(probe, x)) * 1.1e-19);
        }
    });
    CHECK(scaled_closures == 24);
}

TEST_CASE_TEMPLATE("every closure: a NaN that matters comes out as NaN", Number, float, double) {
    for_each_closure([&](const auto& probe) {
        using probe_type = std::decay_t<decltype(probe)>;
        seeded random(15);
        CAPTURE(std::string(probe_type::about().name));
        for (int n = 0; n < 10; ++n) {
            const auto plain = draw<probe_type>(random);
            const auto exact_x = as<long double>(plain);
            for (std::size_t i = 0; i < plain.size(); ++i) {
                CAPTURE(i);
                if (logarithmic_slope(probe, exact_x, i) == 0) continue;
                std::vector<Number> x;
                for (const double value : plain) x.push_back(static_cast<Number>(value));
                x[i] = std::numeric_limits<Number>::quiet_NaN();
                const Number y = probe(x.data());
                REQUIRE(std::isnan(y));
            }
        }
    });
}
