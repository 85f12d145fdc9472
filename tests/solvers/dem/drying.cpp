// SPDX-License-Identifier: MIT
// Water on the particles of a moving bed.
#include <hearth/dem/wet_bed.hpp>

#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/gunn.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/tssm.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/species.hpp>

#include "solvers/dem/packed.hpp"
#include "support/warm_bed.hpp"

using namespace hearth::dem;
using hearth_test::gas_samples;

namespace {

constexpr double d = 0.018;
const hearth::drying water_term{hearth::closure::gunn{}};
const hearth::scene hot_air{hearth::convection{hearth::closure::gunn{}}};
const hearth::constant_specific_heat<> cp{840};
const auto caloric = [](std::size_t) -> const hearth::constant_specific_heat<>& { return cp; };

/// What air of 400 K gives to each parcel.
std::vector<hearth::heat_bath<double>> baths_of(thermal_bed& heated, const gas_samples& gas) {
    auto cloud = grains(heated);
    std::vector<double> conductance;
    hot_air.gas_conductances(cloud, gas, conductance);
    std::vector<hearth::heat_bath<double>> baths(conductance.size());
    for (std::size_t i = 0; i < baths.size(); ++i)
        baths[i].add(hearth::conductive_link<double>{cloud.count() * conductance[i]}, gas.temperature[i]);
    return baths;
}

}  // namespace

TEST_CASE("a moving, fed and discharged bed dries: water and heat are accounted for to round-off") {
    bed b = hearth_test::tube_on_floor(hearth_test::soft_settings(0.5, 0.3), 4 * d, 2);
    auto source = hearth_test::feed_into({{0, 0, 8 * d}, 4 * d, 6 * d}, 3580, 0.016, 0.0195, 1.0);
    fill_to_level(b, source, {{0, 0, 0}, 4 * d, 6 * d}, 6 * d, 20000);
    thermal_bed heated(b, {840, 4, 1});
    wet_bed wet(heated, 0.02);
    CHECK(wet.water() == doctest::Approx(wet.water_brought()).epsilon(1e-12));
    outflow sink({0, 0, 1.0});
    double evaporated = 0;
    const auto rebuilds = b.rebuilds();
    const auto heat_content = [&] {
        double sum = 0;
        for (std::int32_t i = 0; i < b.size(); ++i) {
            const auto& c = wet.contents()[static_cast<std::size_t>(i)];
            sum += c.dry * cp.enthalpy(b.temperatures()[i]) + c.water * water_term.liquid_enthalpy(b.temperatures()[i]);
        }
        return sum;
    };
    for (int k = 0; k < 40; ++k) {
        b.advance(100);
        source.update(b, 100 * b.settings().step);
        sink.update(b, 100 * b.settings().step);
        wet.follow();
        heated.clear_rates();
        gas_samples gas(static_cast<std::size_t>(b.size()));
        const double before = heat_content();
        const auto books = wet.dry(water_term, gas, baths_of(heated, gas), caloric, hearth::tssm(200.0), 0.008);
        evaporated += books.evaporated;
        CHECK(std::fabs(heat_content() - before - books.heat + books.vapour_enthalpy) <
              1e-12 * (std::fabs(before) + std::fabs(books.vapour_enthalpy)));
    }
    CHECK(b.rebuilds() > rebuilds);  // indices have changed
    CHECK(evaporated > 0.05 * wet.water_brought());
    CHECK(wet.water_carried_out() > 0);
    CHECK(std::fabs(wet.water_brought() - wet.water_carried_out() - evaporated - wet.water()) < 1e-12 * wet.water_brought());
    for (std::int32_t i = 0; i < b.size(); ++i) {
        const auto& c = wet.contents()[static_cast<std::size_t>(i)];
        CHECK(b.mass(i) == doctest::Approx(c.dry + c.water).epsilon(1e-12));
        CHECK((c.water >= 0 && c.water <= 0.02 * c.dry * (1 + 1e-12)));
    }
}

TEST_CASE("a dry particle is heated as one that never held water, and a parcel dries as its grains") {
    bed_settings s;
    s.gravity = {};
    bed one(s), three(s);
    particle p;
    p.radius = d / 2;
    p.density = 3580;
    one.insert({p});
    p.radius = 3 * d / 2;
    three.insert({p});
    thermal_bed grain(one, {840, 4, 1}), parcel(three, {840, 4, 1}, 3);
    wet_bed wet_grain(grain, 0.01), wet_parcel(parcel, 0.01);
    const gas_samples gas(1);
    for (int k = 0; k < 200; ++k) {
        const auto of_grain = wet_grain.dry(water_term, gas, baths_of(grain, gas), caloric, hearth::tssm(1.0), 3.0);
        const auto of_parcel = wet_parcel.dry(water_term, gas, baths_of(parcel, gas), caloric, hearth::tssm(1.0), 3.0);
        CHECK(one.temperatures()[0] == doctest::Approx(three.temperatures()[0]).epsilon(1e-9));
        CHECK(std::fabs(27 * of_grain.evaporated - of_parcel.evaporated) < 1e-9 * 0.01 * three.mass(0));
    }
    CHECK(wet_grain.water() == 0);  // dry in the end, and then hot
    CHECK(one.temperatures()[0] > 380);
    CHECK(one.mass(0) == doctest::Approx(wet_grain.contents()[0].dry).epsilon(1e-14));
    CHECK_THROWS_AS(wet_bed(grain, -1), hearth::bad_value);
    CHECK_THROWS_AS(wet_grain.dry(water_term, gas, {}, caloric, hearth::tssm(1.0), 3.0), hearth::bad_value);
    CHECK_THROWS_AS(wet_grain.dry(water_term, gas, baths_of(grain, gas), caloric, hearth::tssm(1.0), -3.0), hearth::bad_value);
    CHECK_THROWS_AS(one.set_mass(0, 0), hearth::bad_value);
}

TEST_CASE("values by id follow their particles wherever they are sorted, and are told from those that left") {
    bed b = hearth_test::tube_on_floor(hearth_test::soft_settings(0.5, 0.3), 4 * d, 2);
    hearth_test::feed_into({{0, 0, 0.1}, 4 * d, 6 * d}, 3580, d, d).fill(b);
    per_particle<std::int64_t> marks;
    std::int64_t gone = 0, made = 0;
    const auto follow = [&] {
        marks.follow(
            b, [&](std::int32_t i) { return ++made, b.ids()[i]; }, [&](std::int64_t) { ++gone; });
        for (std::int32_t i = 0; i < b.size(); ++i) CHECK(marks.values()[static_cast<std::size_t>(i)] == b.ids()[i]);
    };
    follow();
    const auto at_first = made;
    for (int k = 0; k < 10; ++k) {
        b.advance(200);
        b.remove({0, b.size() - 1});
        follow();
    }
    CHECK(made == at_first);
    CHECK(gone == 20);
}
