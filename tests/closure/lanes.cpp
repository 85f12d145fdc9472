// SPDX-License-Identifier: MIT
// Every closure on Eigen's arrays.
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

TEST_CASE_TEMPLATE("every closure: gives on each lane what it gives on a plain number", Lanes,
                   Eigen::Array<float, 16, 1>, Eigen::ArrayXd) {
    using real = typename Lanes::Scalar;
    const double epsilon = static_cast<double>(std::numeric_limits<real>::epsilon());
    const Eigen::Index lanes = Lanes::SizeAtCompileTime == Eigen::Dynamic ? 5 : Lanes::SizeAtCompileTime;
    for_each_closure([&](const auto& probe) {
        using probe_type = std::decay_t<decltype(probe)>;
        seeded random(12);
        CAPTURE(std::string(probe_type::about().name));
        for (int n = 0; n < 20; ++n) {
            CAPTURE(n);
            std::vector<std::vector<real>> rows;
            std::vector<Lanes> x(probe_type::about().inputs.size(), Lanes::Zero(lanes));
            for (Eigen::Index lane = 0; lane < lanes; ++lane) {
                rows.push_back(as<real>(draw<probe_type>(random)));
                for (std::size_t i = 0; i < x.size(); ++i) x[i][lane] = rows.back()[i];
            }
            const Lanes together = probe(x.data());
            for (Eigen::Index lane = 0; lane < lanes; ++lane) {
                const auto exact_x = as<long double>(rows[static_cast<std::size_t>(lane)]);
                const long double exact = probe(exact_x.data());
                const double error = relative_error(together[lane], exact);
                // A power on lanes adds (2 + 2 |a log x|) round-offs, see power; |a log x| is below 30 here.
                REQUIRE(error <= (2 * round_offs + 2 * condition(probe, exact_x)) * epsilon);
            }
        }
    });
}

TEST_CASE_TEMPLATE("every closure: a NaN that matters comes out of its lanes as NaN", Number,
                   Eigen::Array<float, 16, 1>, Eigen::ArrayXd) {
    using real = hearth::real_t<Number>;
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
                for (const double value : plain) x.push_back(Number::Constant(16, static_cast<real>(value)));
                x[i] = Number::Constant(16, std::numeric_limits<real>::quiet_NaN());
                const Number y = probe(x.data());
                for (std::int64_t lane = 0; lane < hearth::lane_count(y); ++lane)
                    REQUIRE(std::isnan(hearth::lane(y, lane)));
            }
        }
    });
}
