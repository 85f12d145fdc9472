// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/conduction.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

// Two steel spheres of 19.8 mm, 2e11 Pa, 0.29: a = (3 F R* / (4 E*))^(1/3) by hand, H = 2 k a.
const contact_materials steel{{2e11, 0.29}, {2e11, 0.29}, 45.0};

warm_bed two_spheres(double force) {
    warm_bed bed(2);
    bed.radius = {0.0099, 0.0099};
    bed.conductivity = {45, 45};
    bed.near = {{0, 1, 0.0198 - 1e-6}};
    bed.stiffness = force / 1e-6;
    return bed;
}

double pair_conductance(double force) {
    const warm_bed bed = two_spheres(force);
    return scene{conduction{closure::zhang::constriction{}, steel}}.links(bed, bed).pairs.at(0).link.conductance;
}

TEST_CASE("conduction: two steel spheres conduct 2 k a, and grow with the cube root of the force") {
    // 2 * 45 * 3.24e-5 F^(1/3) = 2.916e-3 F^(1/3) W/K, to the three digits of the radius.
    CHECK(pair_conductance(1) == doctest::Approx(2.916e-3).epsilon(2e-3));
    CHECK(pair_conductance(27) / pair_conductance(1) == doctest::Approx(3).epsilon(1e-7));
    const double modulus = 2e11 / (2 * (1 - 0.29 * 0.29)), radius = 0.0099 / 2;
    CHECK(pair_conductance(500) == doctest::Approx(2 * 45 * std::cbrt(0.75 * 500 * radius / modulus)).epsilon(1e-6));
}

TEST_CASE("conduction: depends on the force, not on how soft the motion was") {
    warm_bed stiff = two_spheres(10), soft = two_spheres(10);
    soft.near[0].distance = 0.0198 - 1e-4;
    soft.stiffness = 10 / 1e-4;
    const scene s{conduction{closure::zhang::constriction{}, steel}};
    CHECK(s.links(soft, soft).pairs[0].link.conductance ==
          doctest::Approx(s.links(stiff, stiff).pairs[0].link.conductance).epsilon(1e-6));
}

TEST_CASE("conduction: a wall of the same material is touched over a larger circle, by 2^(1/3)") {
    warm_bed bed(1);
    bed.radius = {0.0099};
    bed.conductivity = {45};
    bed.walls = {{0, 0, 0.0099 * 1.004 - 1e-6}};
    bed.stiffness = 10 / 1e-6;
    bed.wall_temperatures = {350.0};
    const scene s{conduction{closure::zhang::constriction{}, steel}};
    const auto list = s.links(bed, bed);
    REQUIRE(list.walls.size() == 1);
    CHECK(list.walls[0].link.conductance == doctest::Approx(std::cbrt(2.0) * pair_conductance(10)).epsilon(1e-6));
    // A wall that does not conduct is none.
    CHECK(scene{conduction{closure::zhang::constriction{}}}.links(bed, bed).walls.empty());
}

TEST_CASE("conduction: a gap conducts through the gas, and an overlap counts as small as it is in truth") {
    warm_bed bed = two_spheres(0);
    gas_samples gas(2);
    const auto film = [&](double distance, double scale) {
        bed.near[0].distance = distance;
        const scene s{film_conduction{closure::gas_film{}, scale}};
        const auto list = s.links(bed, bed, gas);
        return list.pairs.empty() ? 0.0 : list.pairs[0].link.conductance;
    };
    const double touching = film(0.0198, 1.0);
    CHECK(touching > 0);
    CHECK(film(0.0205, 1.0) < touching);
    CHECK(film(0.0198 * 1.49, 1.0) < 0.2 * touching);
    CHECK(film(0.0198 * 1.51, 1.0) == 0.0);
    // 2 % of softened overlap at a modulus 530 times too low is 0.03 % in truth.
    const double scale = std::pow(3.77e8 / 2e11, 2.0 / 3.0);
    const double gap = -0.02 * 0.0198;
    CHECK(film(0.0198 + gap, scale) == doctest::Approx(film(0.0198 + gap * scale, 1.0)).epsilon(1e-9));
}

TEST_CASE("conduction: one list holds contacts and films, and what one side loses the other gains") {
    test::packing_settings settings;
    settings.solid_fraction = 0.58;
    settings.size = {5, 5, 5};
    const auto packed = test::make_packing(settings);
    warm_bed bed(packed, 0.01, 1.5);
    gas_samples gas(bed.radius.size());
    seeded random(3);
    for (double& t : bed.temperature) t = random.uniform(300, 900);
    const scene s{conduction{closure::zhang::constriction{}, steel}, film_conduction{closure::gas_film{}}};
    const auto list = s.links(bed, bed, gas);
    CHECK(list.pairs.size() > bed.radius.size());
    std::vector<double> heat(bed.radius.size(), 0.0);
    const auto wall_temperature = [&](int patch) { return bed.wall_temperatures[warm_bed::at(patch)]; };
    const auto books = accumulate(list, bed.temperature, wall_temperature, heat);
    REQUIRE(books.size() == 2);
    double sum = 0, moved = 0;
    for (const double q : heat) sum += q;
    for (const auto& ledger : books) {
        CHECK(ledger.between > 0);
        sum -= ledger.from_walls;
        moved += ledger.between + std::fabs(ledger.from_walls);
    }
    CHECK(books[1].from_walls == 0);  // the film is between particles
    CHECK(std::fabs(sum) < 1e-13 * moved);
    // Each term's ledger is what the term does alone.
    std::vector<double> alone(heat.size(), 0.0);
    const auto contacts = scene{conduction{closure::zhang::constriction{}, steel}}.links(bed, bed);
    const auto single = accumulate(contacts, bed.temperature, wall_temperature, alone);
    CHECK(single[0].between == books[0].between);
    CHECK(single[0].from_walls == books[0].from_walls);
}

}  // namespace
