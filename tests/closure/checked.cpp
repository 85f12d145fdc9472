// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <thread>
#include <type_traits>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/closure/checked.hpp>
#include <hearth/closure/eisfeld_schnitzlein.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/eigen.hpp>

using namespace hearth::closure;
namespace closure = hearth::closure;

static_assert(std::is_empty_v<checked<gunn>>, "trust weighs nothing");
static_assert(std::is_empty_v<checked<gunn, raise>> && std::is_empty_v<checked<ergun, closure::clamp>>);

TEST_CASE("checked: trust changes nothing") {
    CHECK(checked<gunn>{}.nusselt(0.1, 1e7, 0.7) == gunn::nusselt(0.1, 1e7, 0.7));
    CHECK(checked<gunn>{}.sherwood(0.1, 1e7, 0.7) == gunn::sherwood(0.1, 1e7, 0.7));
}

TEST_CASE("checked: clamp takes the nearest value of the range") {
    const checked<gunn, closure::clamp> clamped;
    CHECK(clamped.nusselt(0.1, 1e7, 0.7) == gunn::nusselt(0.35, 1e5, 0.7));
    CHECK(clamped.nusselt(0.1F, 10.0F, 0.7F) == gunn::nusselt(0.35F, 10.0F, 0.7F));
    CHECK(clamped.nusselt(0.4, 10.0, 0.7) == gunn::nusselt(0.4, 10.0, 0.7));
    CHECK(std::isnan(clamped.nusselt(std::numeric_limits<double>::quiet_NaN(), 10.0, 0.7)));
}

TEST_CASE("checked: count leaves the value and counts the evaluations outside") {
    range_counter counter;
    CHECK(counter.share() == 0);
    const checked<gunn, closure::count> counted{gunn{}, closure::count{counter}};
    CHECK(counted.nusselt(0.1, 10.0, 0.7) == gunn::nusselt(0.1, 10.0, 0.7));
    CHECK(counted.nusselt(0.1, 1e7, 0.7) > 0);  // both arguments outside is one evaluation outside
    CHECK(counted.nusselt(0.4, 10.0, 0.7) > 0);
    CHECK(std::isnan(counted.nusselt(0.4, std::numeric_limits<double>::quiet_NaN(), 0.7)));
    CHECK(counter.evaluations == 4);
    CHECK(counter.outside == 3);
    CHECK(counter.share() == 0.75);
}

TEST_CASE("checked: the ends of a range are inside in every precision") {
    range_counter counter;
    const checked<gunn, closure::count> counted{gunn{}, closure::count{counter}};
    CHECK(counted.nusselt(0.35, 1e5, 0.7) > 0);
    CHECK(counted.nusselt(0.35F, 1e5F, 0.7F) > 0);
    CHECK(counted.nusselt(0.35L, 0.0L, 0.7L) > 0);
    CHECK(counter.outside == 0);
}

TEST_CASE("checked: each lane counts") {
    range_counter counter;
    const checked<gunn, closure::count> counted{gunn{}, closure::count{counter}};
    const Eigen::Array4d void_fraction(0.1, 0.4, 0.5, 0.6), reynolds(1, 2, 3, 1e9),
        prandtl = Eigen::Array4d::Constant(0.7);
    const Eigen::Array4d nusselt = counted.nusselt(void_fraction, reynolds, prandtl);
    CHECK(nusselt[1] > 0);
    CHECK(counter.evaluations == 4);
    CHECK(counter.outside == 2);
}

TEST_CASE("checked: threads may share a counter") {
    range_counter counter;
    const checked<gunn, closure::count> counted{gunn{}, closure::count{counter}};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&counted] {
            for (int n = 0; n < 1000; ++n) static_cast<void>(counted.nusselt(n % 4 == 0 ? 0.1 : 0.5, 10.0, 0.7));
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(counter.evaluations == 4000);
    CHECK(counter.outside == 1000);
}

TEST_CASE("checked: raise names closure, argument, value and range") {
    const checked<gunn, raise> raising;
    CHECK(raising.nusselt(0.4, 10.0, 0.7) == gunn::nusselt(0.4, 10.0, 0.7));
    CHECK_THROWS_WITH(static_cast<void>(raising.nusselt(0.25, 10.0, 0.7)),
                      "hearth: void_fraction of closure gunn is 0.25, allowed: in [0.35, 1]");
    CHECK_THROWS_WITH(static_cast<void>(raising.nusselt(0.5, -1.0, 0.7)),
                      "hearth: reynolds of closure gunn is -1, allowed: in [0, 100000]");
    CHECK_THROWS_AS(static_cast<void>(raising.nusselt(std::numeric_limits<double>::quiet_NaN(), 1.0, 0.7)),
                    std::invalid_argument);
    const Eigen::Array4d void_fraction(0.4, 0.4, 0.25, 0.6), ones = Eigen::Array4d::Ones();
    CHECK_THROWS_WITH(static_cast<void>(raising.nusselt(void_fraction, ones, ones)),
                      "hearth: void_fraction of closure gunn, lane 2 is 0.25, allowed: in [0.35, 1]");
}

TEST_CASE("checked: stands in for a drag closure, with or without state") {
    const bed_flow<double> flow{0.4, 1, 1.2, 1.8e-5, 0.014};
    CHECK(pressure_gradient(checked<ergun, raise>{}, flow) == pressure_gradient(ergun{}, flow));
    const eisfeld_schnitzlein walled(5);
    CHECK(pressure_gradient(checked<eisfeld_schnitzlein, raise>{walled}, flow) == pressure_gradient(walled, flow));
    const bed_flow<double> thin{0.95, 1, 1.2, 1.8e-5, 0.014};
    CHECK_THROWS_AS(static_cast<void>(pressure_gradient(checked<ergun, raise>{}, thin)), std::invalid_argument);
}

TEST_CASE("checked: stands in for a view factor") {
    using fit = feng_han::monte_carlo_fit;
    CHECK(checked<fit, raise>{fit(0.62)}.view_factor(1.3) == fit(0.62).view_factor(1.3));
    CHECK_THROWS_AS(static_cast<void>(checked<fit, raise>{}.view_factor(5.0)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(checked<fit, raise>{}.view_factor(1.2, 0.4)), std::invalid_argument);
    CHECK(checked<fit, closure::clamp>{}.view_factor(1.2, 0.4) == fit::view_factor(1.2, 0.57));
}
