// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/closure/ergun.hpp>
#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/closure/wen_yu.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/drag.hpp>
#include <hearth/transfer/radiation.hpp>
#include <hearth/transfer/species.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

test::packing small_bed() {
    test::packing_settings settings;
    settings.solid_fraction = 0.57;
    settings.size = {5, 5, 5};
    return test::make_packing(settings);
}

TEST_CASE("scene: what is absent weighs nothing") {
    static_assert(std::is_empty_v<scene<>>);
    static_assert(std::is_empty_v<scene<drag<closure::ergun>>>);
    static_assert(std::is_empty_v<scene<drag<closure::ergun>, convection<closure::gunn>>>);
    static_assert(std::is_empty_v<scene<convection<closure::gunn>, convection<closure::gunn>>>);
    static_assert(sizeof(scene<conduction<closure::zhang::constriction>>) == sizeof(contact_materials));
    // Without radiation a list holds no coefficient of T^4, without conduction none of T.
    static_assert(std::is_same_v<scene<conduction<closure::zhang::constriction>>::link, conductive_link<double>>);
    static_assert(std::is_same_v<scene<radiation<closure::feng_han::monte_carlo_fit>>::link, radiative_link<double>>);
    static_assert(sizeof(linked_pair<conductive_link<double>>) == 16);
    warm_bed bed(2);
    gas_samples gas(2);
    (void)scene<>{}.accumulate(bed, gas);
    CHECK(bed.heat_rate[0] == 0);
}

TEST_CASE("scene: two equal terms with different parameters compose") {
    contact_materials stiff, soft;
    soft.particle.youngs_modulus = 2e10;
    const auto packed = small_bed();
    const warm_bed bed(packed, 0.01, 1.2);
    const conduction a{closure::zhang::constriction{}, stiff}, b{closure::zhang::constriction{}, soft};
    const auto both = scene{a, b}.links(bed, bed), first = scene{a}.links(bed, bed), second = scene{b}.links(bed, bed);
    CHECK(both.pairs.size() == first.pairs.size() + second.pairs.size());
    // cbrt(10): the softer one touches over the larger circle.
    CHECK(second.pairs[0].link.conductance == doctest::Approx(std::cbrt(10.0) * first.pairs[0].link.conductance));
    double sum = 0, parts = 0;
    for (const auto& pair : both.pairs) sum += pair.link.conductance;
    for (const auto& pair : first.pairs) parts += pair.link.conductance;
    for (const auto& pair : second.pairs) parts += pair.link.conductance;
    CHECK(sum == doctest::Approx(parts).epsilon(1e-12));

    warm_bed particles(3);
    gas_samples gas(3);
    const auto books = scene{convection{closure::gunn{}}, convection{closure::gunn{}}}.accumulate(particles, gas);
    CHECK(books[0].heat_from_gas == books[1].heat_from_gas);
    CHECK(particles.heat_rate[0] * 3 == doctest::Approx(2 * books[0].heat_from_gas));
}

TEST_CASE("scene: terms do not depend on their order, and a scene is the sum of its terms") {
    warm_bed one(20), other(20), alone(20);
    gas_samples gas_one(20), gas_other(20), gas_alone(20);
    const convection heat{closure::gunn{}};
    const drag push{closure::wen_yu{}};
    (void)scene{heat, push}.accumulate(one, gas_one, tssm(200));
    (void)scene{push, heat}.accumulate(other, gas_other, tssm(200));
    (void)scene{heat}.accumulate(alone, gas_alone, tssm(200));
    CHECK(one.heat_rate == other.heat_rate);
    CHECK(one.force == other.force);
    CHECK(alone.heat_rate == one.heat_rate);
    CHECK(alone.force[0][2] == 0);
}

TEST_CASE("scene: explicit rates, implicit step and step limit read the same statements") {
    const auto packed = small_bed();
    warm_bed bed(packed, 0.018, 2.5);
    const std::size_t count = bed.radius.size();
    gas_samples gas(count);
    bed.wall_temperatures.assign(6, 900.0);
    seeded random(4);
    for (double& t : bed.temperature) t = random.uniform(800, 1600);
    gas.temperature.assign(count, 1000.0);
    contact_materials materials;
    materials.wall_conductivity = 2;
    const scene kiln{convection{closure::gunn{}}, conduction{closure::zhang::constriction{}, materials},
                     radiation{closure::feng_han::monte_carlo_fit{}}};
    const auto list = kiln.links(bed, bed, gas);
    const tssm clock(200);
    const auto baths = kiln.baths(bed, bed, gas, list, clock);

    std::vector<double> mass(count), capacity(count);
    for (std::size_t i = 0; i < count; ++i) {
        mass[i] = 3580 * 4.18879 * std::pow(bed.radius[i], 3);
        capacity[i] = 1000 * mass[i];
    }
    const double limit = kiln.largest_step(list, baths, capacity, bed.temperature, clock);

    // A short implicit step changes temperatures as the explicit rates say: relative error of some steps over limits.
    std::vector<double> heat(count, 0.0), t = bed.temperature;
    const auto wall_temperature = [&](int patch) { return bed.wall_temperatures[warm_bed::at(patch)]; };
    const auto link_books = accumulate(list, bed.temperature, wall_temperature, heat);
    const auto books = kiln.accumulate(bed, gas, clock);
    const double step = 1e-5 * limit;
    const constant_specific_heat<> caloric{1000};
    std::vector<particle_step<double>> taken;
    const auto report = thermal_network().advance(
        list.pairs, baths, mass, [&](std::size_t) { return caloric; }, clock, step, t, taken);
    REQUIRE(report.converged);
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::fabs(200 * heat[i] + bed.heat_rate[i]));
    for (std::size_t i = 0; i < count; ++i)
        CHECK(taken[i].heat ==
              doctest::Approx((200 * heat[i] + bed.heat_rate[i]) * step).epsilon(1e-4).scale(largest * step));

    // What particles gained is what gas, walls and surroundings gave, in the ledger and by the shares of the baths.
    double gained = 0, from_bath = 0, explicit_gain = 0;
    for (std::size_t i = 0; i < count; ++i) {
        gained += taken[i].heat / 200;
        from_bath += (taken[i].conducted + taken[i].radiated) / 200;
        explicit_gain += (heat[i] + bed.heat_rate[i] / 200);
    }
    double supplied = books[0].heat_from_gas;
    for (const auto& book : link_books) supplied += book.from_walls + book.from_surroundings;
    CHECK(explicit_gain == doctest::Approx(supplied).epsilon(1e-10));
    CHECK(gained == doctest::Approx(from_bath).epsilon(1e-9));

    // And the limit is that of the explicit scheme: stable at it, within Gershgorin's factor of 2 of unstable.
    const auto grows = [&](double dt) {
        std::vector<double> x(count, 1000.0);
        for (std::size_t i = 0; i < count; ++i) x[i] += i % 2 == 0 ? 1e-3 : -1e-3;
        std::vector<double> q(count);
        const auto cool = [](int) { return 1000.0; };
        const auto spread = [&] {
            double far = 0;
            for (const double value : x) far = std::max(far, std::fabs(value - 1000));
            return far;
        };
        for (int n = 0; n < 400 && spread() < 10; ++n) {
            std::fill(q.begin(), q.end(), 0.0);
            (void)accumulate(list, x, cool, q);
            for (std::size_t i = 0; i < count; ++i) x[i] += dt * 200 * q[i] / capacity[i];
        }
        return spread() >= 10;
    };
    std::vector<heat_bath<double>> walls(count);
    for (const auto& wall : list.walls) walls[warm_bed::at(wall.particle)].add(wall.link, 1000.0);
    for (const auto& open : list.surroundings) walls[warm_bed::at(open.particle)].add(open.link, 1000.0);
    const double rest_limit = kiln.largest_step(list, walls, capacity, std::vector<double>(count, 1000.0), clock);
    CHECK_FALSE(grows(rest_limit));
    CHECK(grows(2.5 * rest_limit));
}

TEST_CASE("scene: two spheres of different Gamma exchange by radiation and contact, and the increments balance") {
    warm_bed bed(2);
    bed.near = {{0, 1, 0.00999}};
    bed.temperature = {900, 1500};
    const scene s{conduction{closure::zhang::constriction{}}, radiation{closure::feng_han::monte_carlo_fit{}}};
    const auto list = s.links(bed, bed);
    CHECK(list.pairs.size() == 2);
    const std::vector<double> factors{1.0, 678.0}, mass{1e-3, 1e-3};
    std::vector<heat_bath<double>> none(2);
    std::vector<particle_step<double>> taken;
    const constant_specific_heat<> caloric{1000};
    (void)thermal_network().advance(
        list.pairs, none, mass, [&](std::size_t) { return caloric; }, tssm_per_particle(678.0, factors), 0.01,
        bed.temperature, taken);
    CHECK(taken[0].heat > 0);
    CHECK(taken[0].heat + taken[1].heat / 678 == doctest::Approx(0).scale(taken[0].heat).epsilon(1e-10));
}

TEST_CASE("scene: a NaN among the particles is refused by the step, and named") {
    warm_bed bed(2);
    bed.near = {{0, 1, 0.00999}};
    bed.conductivity[1] = std::nan("");
    const scene s{conduction{closure::zhang::constriction{}}};
    const auto list = s.links(bed, bed);
    std::vector<particle_step<double>> taken;
    const constant_specific_heat<> caloric{1000};
    try {
        (void)thermal_network().advance(
            list.pairs, std::vector<heat_bath<double>>(2), std::vector<double>(2, 1.0),
            [&](std::size_t) { return caloric; }, unsplit{}, 1.0, bed.temperature, taken);
        FAIL_CHECK("accepted");
    } catch (const bad_value& error) {
        CHECK(error.place == "conductance of pair");
        CHECK(error.index == 0);
    }
}

TEST_CASE("scene: no particles, no exchange") {
    warm_bed bed(0);
    gas_samples gas(0);
    const scene kiln{drag{closure::ergun{}}, convection{closure::gunn{}},
                     radiation{closure::feng_han::monte_carlo_fit{}}, conduction{closure::zhang::constriction{}},
                     drying{closure::gunn{}}};
    const auto books = kiln.accumulate(bed, gas);
    CHECK(books[1].heat_from_gas == 0);
    const auto list = kiln.links(bed, bed, gas);
    CHECK(list.pairs.empty());
    CHECK(kiln.baths(bed, bed, gas, list).empty());
}

}  // namespace
