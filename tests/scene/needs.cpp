// SPDX-License-Identifier: MIT
#include <string>
#include <type_traits>

#include <doctest/doctest.h>

#include <hearth/closure/ergun.hpp>
#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/drag.hpp>
#include <hearth/transfer/radiation.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;

namespace {

/// Particles without temperature.
struct cold_cloud {
    std::array<double, 3> pushed{};
};
struct cold_gas {
    std::array<double, 3> pushed{};
};

using cold = scene<drag<closure::ergun>>;
using warm = scene<drag<closure::ergun>, convection<closure::gunn>>;

}  // namespace

template <>
struct hearth::particle_traits<cold_cloud> {
    using index = int;
    using scalar = float;
    static index particle_count(const cold_cloud&) { return 1; }
    static float get(quantity::radius, const cold_cloud&, index) { return 0.005f; }
    static std::array<float, 3> get(quantity::velocity, const cold_cloud&, index) { return {}; }
    static void add(quantity::force, cold_cloud& c, index, const std::array<double, 3>& f) { c.pushed = f; }
};
template <>
struct hearth::particle_traits<cold_gas> {
    using index = int;
    using scalar = double;
    static index particle_count(const cold_gas&) { return 1; }
    static double get(quantity::void_fraction, const cold_gas&, index) { return 0.4; }
    static double get(quantity::gas_density, const cold_gas&, index) { return 1.2; }
    static double get(quantity::gas_viscosity, const cold_gas&, index) { return 1.8e-5; }
    static std::array<double, 3> get(quantity::gas_velocity, const cold_gas&, index) { return {0, 0, 1}; }
    static std::array<double, 3> get(quantity::pressure_gradient, const cold_gas&, index) { return {0, 0, -10}; }
    static void add(quantity::gas_force, cold_gas& g, index, const std::array<double, 3>& f) { g.pushed = f; }
};

TEST_CASE("needs: the union of what the terms read and write, each once") {
    static_assert(std::is_same_v<cold::needs::reads, quantities<quantity::radius, quantity::velocity>>);
    static_assert(std::is_same_v<cold::needs::writes, quantities<quantity::force>>);
    static_assert(
        std::is_same_v<warm::needs::reads, quantities<quantity::radius, quantity::velocity, quantity::temperature>>);
    static_assert(std::is_same_v<warm::needs::writes, quantities<quantity::force, quantity::heat_rate>>);
    static_assert(std::is_same_v<scene<>::needs::reads, quantities<>>);
}

TEST_CASE("needs: a host without temperature runs the cold scene and is known not to run the warm one") {
    static_assert(cold::needs::are_met_by<cold_cloud, cold_gas>());
    static_assert(!warm::needs::are_met_by<cold_cloud, cold_gas>());
    static_assert(warm::needs::are_met_by<hearth_test::warm_bed, hearth_test::gas_samples>());
    cold_cloud cloud;
    cold_gas gas;
    (void)cold{drag{closure::ergun{}}}.accumulate(cloud, gas);
    CHECK(cloud.pushed[2] > 0);
    CHECK(gas.pushed[2] < 0);
}

TEST_CASE("needs: a list of links asks what its terms ask, no temperature and no neighbours that nobody wants") {
    using touching = conduction<closure::zhang::constriction>;
    using shining = radiation<closure::feng_han::monte_carlo_fit>;
    using wet = convection<closure::gunn>;
    static_assert(std::is_same_v<link_needs<touching>::reads, quantities<quantity::radius, quantity::conductivity>>);
    static_assert(std::is_same_v<link_needs<shining, wet>::reads, quantities<quantity::radius>>);
    static_assert(std::is_same_v<link_needs<wet>::reads, quantities<>>);
    static_assert(std::is_same_v<link_needs<film_conduction<>>::gas_reads,
                                 quantities<quantity::void_fraction, quantity::gas_conductivity>>);
    // cold_cloud knows its radius; neither it nor cold_gas knows who touches whom.
    static_assert(!link_needs<shining>::are_met_by<cold_cloud, cold_cloud, no_gas>());
    static_assert(link_needs<shining>::are_met_by<cold_cloud, hearth_test::warm_bed, no_gas>());
    static_assert(!link_needs<touching>::are_met_by<cold_cloud, hearth_test::warm_bed, no_gas>());
    static_assert(!link_needs<film_conduction<>>::are_met_by<hearth_test::warm_bed, hearth_test::warm_bed, no_gas>());
    const auto list = cold{drag{closure::ergun{}}}.links(cold_cloud{}, cold_gas{});
    CHECK(list.pairs.empty());
    CHECK(list.parts.empty());
}

TEST_CASE("needs: the message names quantities with symbols and units") {
    const std::string text = warm::needs::text();
    CHECK(text.find("temperature  T [K]") != std::string::npos);
    CHECK(text.find("heat_rate  Q [W]") != std::string::npos);
    CHECK(text.find("gas_velocity  u [m/s]") != std::string::npos);
    CHECK(cold::needs::text().find("[K]") == std::string::npos);
    CHECK(scene<>::needs::text().empty());
}
