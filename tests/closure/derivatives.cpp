// SPDX-License-Identifier: MIT
// Every closure on Eigen's dual numbers.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/eigen.hpp>

#include "support/closure_condition.hpp"
#include "support/closure_probes.hpp"

using namespace hearth_test;

TEST_CASE("every closure: a dual number carries the derivative that finite differences find") {
    using dual = Eigen::AutoDiffScalar<Eigen::VectorXd>;
    for_each_closure([&](const auto& probe) {
        using probe_type = std::decay_t<decltype(probe)>;
        seeded random(13);
        CAPTURE(std::string(probe_type::about().name));
        for (int n = 0; n < 100; ++n) {
            CAPTURE(n);
            const auto plain = draw<probe_type>(random);
            const auto exact_x = as<long double>(plain);
            const auto inputs = static_cast<Eigen::Index>(plain.size());
            std::vector<dual> x;
            for (Eigen::Index i = 0; i < inputs; ++i) x.emplace_back(plain[static_cast<std::size_t>(i)], inputs, i);
            const dual y = probe(x.data());
            const double f = static_cast<double>(probe(exact_x.data()));
            const double scale = std::fabs(f) * (1 + condition(probe, exact_x));
            REQUIRE(std::fabs(y.value() - f) <= 2 * round_offs * 2.3e-16 * scale);
            for (Eigen::Index i = 0; i < inputs; ++i) {
                CAPTURE(i);
                const double slope = plain[static_cast<std::size_t>(i)] * y.derivatives()[i];
                const double expected =
                    static_cast<double>(logarithmic_slope(probe, exact_x, static_cast<std::size_t>(i)));
                REQUIRE(std::fabs(slope - expected) <= 1e-7 * scale);
            }
        }
    });
}
