// SPDX-License-Identifier: MIT
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/hertz.hpp>

using namespace hearth::closure;

namespace {

constexpr elastic<double> steel{2.0e11, 0.29};
constexpr double radius = 9.9e-3;  // the spheres of the paper's Fig. 1

double steel_contact(double force) {
    return hertz::contact_radius(force, hertz::effective_radius(radius, radius),
                                 hertz::effective_modulus(steel, steel));
}

}  // namespace

TEST_CASE("hertz: contact of two steel spheres of 19.8 mm") {
    struct row {
        double force, contact_radius, area, overlap;
    };
    // computed elsewhere, printed with seven digits
    constexpr row rows[]{{0.01, 6.979723e-06, 1.530475e-10, 9.841723e-09},
                         {1, 3.239700e-05, 3.297308e-09, 2.120335e-07},
                         {20, 8.793900e-05, 2.429478e-08, 1.562276e-06},
                         {500, 2.571352e-04, 2.077174e-07, 1.335727e-05}};
    for (const row& r : rows) {
        const double a = steel_contact(r.force);
        CHECK(a == doctest::Approx(r.contact_radius).epsilon(5e-7));
        CHECK(hertz::contact_area(a) == doctest::Approx(r.area).epsilon(5e-7));
        CHECK(hertz::overlap(a, radius / 2) == doctest::Approx(r.overlap).epsilon(5e-7));
    }
}

TEST_CASE("hertz: hand values of the effective modulus and radius") {
    // 2e11 / (2 (1 - 0.0841))
    CHECK(hertz::effective_modulus(steel, steel) == doctest::Approx(1.0918222513374823e11).epsilon(1e-15));
    CHECK(hertz::effective_radius(2.0, 2.0) == 1);
    CHECK(hertz::effective_radius(1.0, 3.0) == 0.75);
}

TEST_CASE("hertz: the radius grows with the cube root of the force") {
    for (double force = 1e-6; force < 1e4; force *= 10)
        CHECK(steel_contact(8 * force) == doctest::Approx(2 * steel_contact(force)).epsilon(1e-15));
}

TEST_CASE("hertz: no contact without a pressing force") {
    CHECK(steel_contact(0) == 0);
    CHECK(steel_contact(-5) == 0);
    CHECK(hertz::normal_force(0.0, radius, 1e11) == 0);
    CHECK(hertz::normal_force(-1e-6, radius, 1e11) == 0);
}

TEST_CASE("hertz: a wall of the same material widens the contact by the cube root of two") {
    const double modulus = hertz::effective_modulus(steel, steel);
    CHECK(hertz::contact_radius(3.0, radius, modulus) / steel_contact(3) ==
          doctest::Approx(std::cbrt(2.0)).epsilon(1e-15));
}

TEST_CASE("hertz: force, overlap and radius of one contact agree") {
    const double modulus = hertz::effective_modulus(steel, steel), effective = radius / 2;
    for (double force = 1e-3; force < 1e3; force *= 7) {
        const double a = hertz::contact_radius(force, effective, modulus);
        CHECK(hertz::normal_force(hertz::overlap(a, effective), effective, modulus) ==
              doctest::Approx(force).epsilon(1e-14));
    }
}

TEST_CASE("hertz: the true contact does not depend on how far the motion was softened") {
    const double effective = radius / 2, force = 20;
    const auto modulus = [](double youngs) {
        const elastic<double> material{youngs, 0.29};
        return hertz::effective_modulus(material, material);
    };
    const double true_modulus = modulus(2e11), expected = hertz::contact_radius(force, effective, true_modulus);
    constexpr double softened_moduli[]{1e6, 3.77e8, 1e10, 2e11};
    for (const double softened : softened_moduli) {
        CAPTURE(softened);
        const double soft = hertz::contact_radius(force, effective, modulus(softened));
        CHECK(hertz::true_contact_radius(soft, modulus(softened), true_modulus) ==
              doctest::Approx(expected).epsilon(1e-14));
        const double overlap = hertz::true_overlap(hertz::overlap(soft, effective), modulus(softened), true_modulus);
        CHECK(overlap == doctest::Approx(hertz::overlap(expected, effective)).epsilon(1e-14));
    }
    // the paper's 2e11 Pa softened to 3.77e8 Pa
    CHECK(hertz::true_contact_radius(1.0, 3.77e8, 2e11) == doctest::Approx(0.1235).epsilon(1e-3));
    CHECK(hertz::true_overlap(1.0, 3.77e8, 2e11) == doctest::Approx(0.01526).epsilon(1e-3));
}
