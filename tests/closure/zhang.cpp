// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <hearth/closure/hertz.hpp>
#include <hearth/closure/zhang.hpp>

#include "support/random.hpp"

using namespace hearth::closure;

namespace {

constexpr double pi = 3.14159265358979324;

/// Two steel spheres of 19.8 mm: the paper's Fig. 1.
contact_pair<double> steel(double force, double conductivity) {
    const elastic<double> material{2.0e11, 0.29};
    const double radius = 9.9e-3;
    const double a = hertz::contact_radius(force, radius / 2, hertz::effective_modulus(material, material));
    return {a, force, conductivity, conductivity, radius, radius};
}

contact_pair<double> swapped(const contact_pair<double>& p) {
    return {p.contact_radius, p.normal_force, p.conductivity_j, p.conductivity_i, p.radius_j, p.radius_i};
}

}  // namespace

TEST_CASE("zhang: conductances of two steel spheres computed elsewhere") {
    struct row {
        double force, constriction_45, constriction_16, series_45;
    };
    // printed with seven digits
    constexpr row rows[]{{0.01, 6.281751e-04, 2.233511e-04, 3.478352e-07},
                         {1, 2.915730e-03, 1.036704e-03, 7.493882e-06},
                         {20, 7.914510e-03, 2.814048e-03, 5.521540e-05},
                         {500, 2.314217e-02, 8.228326e-03, 4.720850e-04}};
    for (const row& r : rows) {
        CHECK(zhang::constriction::conductance(steel(r.force, 45)) == doctest::Approx(r.constriction_45).epsilon(5e-7));
        CHECK(zhang::constriction::conductance(steel(r.force, 16)) == doctest::Approx(r.constriction_16).epsilon(5e-7));
        CHECK(zhang::series().conductance(steel(r.force, 45)) == doctest::Approx(r.series_45).epsilon(5e-7));
    }
}

TEST_CASE("zhang: what one body gains the other loses, to the last bit") {
    hearth_test::seeded random(21);
    const zhang::series series(2e-5);
    const zhang::micro_gap micro_gap({1e-6, 0.1, 2e9});
    for (int n = 0; n < 1000; ++n) {
        const contact_pair<double> p{random.log_uniform(1e-6, 1e-3), random.log_uniform(1e-3, 1e3),
                                     random.log_uniform(0.1, 100),   random.log_uniform(0.1, 100),
                                     random.log_uniform(1e-3, 1e-1), random.log_uniform(1e-3, 1e-1)};
        // one rounding where a compiler fuses the sum of two products
        CHECK(zhang::constriction::conductance(p) == zhang::constriction::conductance(swapped(p)));
        CHECK(series.conductance(p) == doctest::Approx(series.conductance(swapped(p))).epsilon(3e-16));
        CHECK(micro_gap.conductance(p) == micro_gap.conductance(swapped(p)));
    }
}

TEST_CASE("zhang: constriction grows with the cube root of the force") {
    CHECK(zhang::constriction::conductance(steel(8, 45)) ==
          doctest::Approx(2 * zhang::constriction::conductance(steel(1, 45))).epsilon(1e-15));
}

TEST_CASE("zhang: nothing is conducted without contact") {
    CHECK(zhang::constriction::conductance(steel(0, 45)) == 0);
    CHECK(zhang::series().conductance(steel(0, 45)) == 0);
    CHECK(zhang::micro_gap({1e-6, 0.1, 2e9}).conductance(steel(0, 45)) == 0);
    CHECK(zhang::micro_gap({1e-6, 0.1, 2e9}).conductance(steel(-1, 45)) == 0);
}

TEST_CASE("zhang: two conductivities act by their harmonic mean") {
    contact_pair<double> p = steel(1, 10);
    p.conductivity_j = 40;
    CHECK(zhang::mean_conductivity(p) == 16);
    p.conductivity_j = 1e300;  // a perfect conductor on the other side leaves half the resistance
    CHECK(zhang::constriction::conductance(p) ==
          doctest::Approx(2 * zhang::constriction::conductance(steel(1, 10))).epsilon(1e-15));
}

TEST_CASE("zhang::series: resistances of the two columns and of the faces add up") {
    const contact_pair<double> p{1e-4, 1, 2, 5, 0.01, 0.02};
    const double area = pi * 1e-8;
    CHECK(zhang::series(0.003).conductance(p) == doctest::Approx(area / (0.005 + 0.004 + 0.003)).epsilon(1e-14));
    const contact_pair<double> wall{1e-4, 1, 2, 50, 0.01, 0};
    CHECK(zhang::series().conductance(wall) == doctest::Approx(area / 0.005).epsilon(1e-14));
}

TEST_CASE("zhang::micro_gap: resistance of the faces, and smooth faces") {
    const contact_pair<double> p = steel(10, 45);
    const double area = pi * p.contact_radius * p.contact_radius;
    const double h = 1.25 * 45 * (0.1 / 1e-6) * std::pow(10 / area / 2e9, 0.95);
    const double resistance = 1 / zhang::constriction::conductance(p) + 1 / (h * area);
    CHECK(zhang::micro_gap({1e-6, 0.1, 2e9}).conductance(p) == doctest::Approx(1 / resistance).epsilon(1e-13));
    // Roughness of 1e-20 m leaves 1e-14 of its resistance.
    CHECK(zhang::micro_gap({1e-20, 0.1, 2e9}).conductance(p) ==
          doctest::Approx(zhang::constriction::conductance(p)).epsilon(1e-12));
}

TEST_CASE("zhang::micro_gap: keeps its units, roughness and hardness rescaled with the rest") {
    // 3 lengths, 5 masses, 7 times, 2 temperatures; the slope has no unit
    const contact_pair<double> p = steel(10, 45);
    const double force = 3 * 5 / 49.0, conductivity = 3 * 5 / 343.0 / 2, pressure = 5 / 3.0 / 49;
    const contact_pair<double> q{
        3 * p.contact_radius, force * p.normal_force, conductivity * p.conductivity_i, conductivity * p.conductivity_j,
        3 * p.radius_i,       3 * p.radius_j};
    CHECK(zhang::micro_gap({3e-6, 0.1, pressure * 2e9}).conductance(q) ==
          doctest::Approx(3 * conductivity * zhang::micro_gap({1e-6, 0.1, 2e9}).conductance(p)).epsilon(1e-13));
    const double resistance = 1 / conductivity * 3;  // m^2 K/W
    CHECK(zhang::series(1e-5 * resistance).conductance(q) ==
          doctest::Approx(3 * conductivity * zhang::series(1e-5).conductance(p)).epsilon(1e-13));
}

TEST_CASE("zhang: settings without meaning are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {-1e-9, nan, infinity}) CHECK_THROWS_AS(zhang::series{bad}, std::invalid_argument);
    for (const double bad : {0.0, -1.0, nan}) {
        CHECK_THROWS_AS(zhang::micro_gap({bad, 0.1, 2e9}), std::invalid_argument);
        CHECK_THROWS_AS(zhang::micro_gap({1e-6, bad, 2e9}), std::invalid_argument);
        CHECK_THROWS_AS(zhang::micro_gap({1e-6, 0.1, bad}), std::invalid_argument);
    }
    CHECK_THROWS_WITH(zhang::micro_gap({0, 0.1, 2e9}),
                      "hearth: rms_height of closure zhang::micro_gap is 0, allowed: > 0 [m]");
}
