// SPDX-License-Identifier: MIT
#include <hearth/dem/wall.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include <hearth/core/error.hpp>

#include <hearth/dem/bed.hpp>

#include "support/random.hpp"

namespace {

using namespace hearth::dem;

bed_settings settings_of() {
    bed_settings s;
    s.step = 1e-5;
    s.gravity = {0, 0, 0};
    s.contact.damping = 0.3;
    return s;
}

wall wall_of(std::vector<facet> facets) {
    wall w;
    w.facets = std::move(facets);
    w.contact = settings_of().contact;
    return w;
}

particle ball(vector3 position, vector3 velocity = {}, double radius = 0.01) {
    particle p;
    p.position = position;
    p.velocity = velocity;
    p.radius = radius;
    p.density = 3000;
    return p;
}

double distance_to(const std::vector<facet>& facets, const vector3& x) {
    double least = 1e300;
    for (const facet& f : facets) least = std::fmin(least, norm(x - closest_point(f, x)));
    return least;
}

/// Points of the surface, from many rays, can only be farther away than the closest one.
void check_closest(const facet& f, const vector3& x, const vector3& some_point_of_it) {
    const double d = norm(x - closest_point(f, x));
    CHECK(d <= norm(x - some_point_of_it) + 1e-12);
}

}  // namespace

TEST_CASE("closest points of every shape, inside and outside, on axis and edges") {
    const auto pipe = shape::cylinder({0, 0, 0}, {0, 0, 2}, 0.5);
    CHECK(distance_to(pipe, {0.2, 0, 1}) == doctest::Approx(0.3));
    CHECK(distance_to(pipe, {0, 0, 1}) == doctest::Approx(0.5));           // on the axis
    CHECK(distance_to(pipe, {0.9, 0, 1}) == doctest::Approx(0.4));
    CHECK(distance_to(pipe, {0.5, 0, 2.3}) == doctest::Approx(0.3));       // above its rim
    CHECK(distance_to(pipe, {0, 0.1, 2.3}) == doctest::Approx(0.5));
    const auto hopper = shape::cone({0, 0, 0}, {0, 0, 1}, 0, 1);
    CHECK(distance_to(hopper, {0, 0, 1}) == doctest::Approx(std::sqrt(0.5)));
    CHECK(distance_to(hopper, {0, 0, -1}) == doctest::Approx(1.0));
    const auto plate = shape::disc({0, 0, 0}, {0, 0, 2}, 1, {{{0.5, 0, 0}, 0.2}});
    CHECK(distance_to(plate, {0, 0, 0.3}) == doctest::Approx(0.3));
    CHECK(distance_to(plate, {0.5, 0, 0}) == doctest::Approx(0.2));        // centre of the hole
    CHECK(distance_to(plate, {0.6, 0, 0.1}) == doctest::Approx(std::hypot(0.1, 0.1)));
    CHECK(distance_to(plate, {2, 0, 1}) == doctest::Approx(std::hypot(1, 1)));
    const auto thick = shape::tube({0, 0, 0}, {0, 0, 1}, 0.5, 0.6);
    CHECK(distance_to(thick, {0.3, 0, 0.5}) == doctest::Approx(0.2));
    CHECK(distance_to(thick, {0.9, 0, 0.5}) == doctest::Approx(0.3));
    CHECK(distance_to(thick, {0.55, 0, 1.2}) == doctest::Approx(0.2));
    const auto crate = shape::box({0, 0, 0}, {1, 2, 3});
    CHECK(distance_to(crate, {0.1, 1, 1.5}) == doctest::Approx(0.1));
    CHECK(distance_to(crate, {-1, -1, -1}) == doctest::Approx(std::sqrt(3.0)));

    hearth_test::seeded random(2);
    for (int k = 0; k < 2000; ++k) {
        const vector3 x{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
        const triangle t{{0, 0, 0}, {1, 0.2, 0}, {0.3, 1, 0.5}};
        const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u), a = random.uniform(0, 6.28);
        check_closest(t, x, t.a + u * (t.b - t.a) + v * (t.c - t.a));
        const swept s{{0.1, 0, 0}, unit({1, 1, 0}), 0.2, 0.5, 1.0, 0.1};
        const vector3 e = s.across(), f = cross(s.axis, e);
        const vector3 out = std::cos(a) * e + std::sin(a) * f;
        check_closest(s, x, s.origin + (0.2 + 0.8 * u) * s.axis + (0.5 - 0.4 * u) * out);
    }
}

TEST_CASE("bad shapes are refused") {
    CHECK_THROWS_AS(shape::plane({}, {0, 0, 0}), hearth::bad_value);
    CHECK_THROWS_AS(shape::cylinder({}, {0, 0, 1}, 0), hearth::bad_value);
    CHECK_THROWS_AS(shape::cylinder({}, {0, 0, 0}, 1), hearth::bad_value);
    CHECK_THROWS_AS(shape::cone({}, {0, 0, 1}, 0, 0), hearth::bad_value);
    CHECK_THROWS_AS(shape::tube({}, {0, 0, 1}, 0.5, 0.5), hearth::bad_value);
    CHECK_THROWS_AS(shape::box({0, 0, 0}, {1, 1, 0}), hearth::bad_value);
    CHECK_THROWS_AS(shape::disc({}, {0, 0, 1}, 1, {{{0.9, 0, 0}, 0.2}}), hearth::bad_value);
    CHECK_THROWS_AS(shape::disc({}, {0, 0, 1}, 1, {{{0.1, 0, 0}, 0.2}, {{-0.1, 0, 0}, 0.2}}), hearth::bad_value);
    bed b(settings_of());
    CHECK_THROWS_AS(b.add_wall(wall{}), hearth::bad_value);
    wall cold = wall_of(shape::plane({}, {0, 0, 1}));
    cold.temperature = 0;
    CHECK_THROWS_AS(b.add_wall(cold), hearth::bad_value);
}

TEST_CASE("edges and corners count once: a floor of triangles acts as a plane, springs included, where a ball rolls over") {
    const auto run = [](bool triangles) {
        bed_settings s = settings_of();
        s.gravity = {0, 0, -9.81};
        s.contact.friction = 0.3;
        bed b(s);
        std::vector<facet> facets;
        if (triangles) {
            for (int i = -2; i < 8; ++i) {
                for (int j = -3; j < 3; ++j) {
                    const auto at = [&](int k, int l) { return vector3{0.013 * (i + k), 0.011 * (j + l), 0}; };
                    facets.push_back(triangle{at(0, 0), at(1, 0), at(1, 1)});
                    facets.push_back(triangle{at(0, 0), at(1, 1), at(0, 1)});
                }
            }
        } else {
            facets = shape::plane({0, 0, 0}, {0, 0, 1});
        }
        wall w = wall_of(facets);
        w.contact.friction = 0.3;
        b.add_wall(w);
        b.insert({ball({0, 0, 0.0099}, {0.3, 0.02, 0})});
        b.advance(20000);
        return std::make_pair(b.spheres()[0].centre, b.motions()[0].spin);
    };
    const auto flat = run(false), mesh = run(true);
    CHECK(norm(flat.first - mesh.first) < 1e-9);
    CHECK(norm(flat.second - mesh.second) < 1e-6);
}

TEST_CASE("a ball in the corner of a box touches three sides, one on its outer edge one") {
    bed b(settings_of());
    b.add_wall(wall_of(shape::box({0, 0, 0}, {1, 1, 1})));
    const double out = 0.0099 / std::sqrt(2.0);
    b.insert({ball({0.0099, 0.0099, 0.0099}), ball({-out, -out, 0.5}), ball({0.5, 0.3, 0.0099}), ball({0.5, 0.5, 0.0099})});
    int count[4] = {0, 0, 0, 0};
    b.for_each_wall_contact([&](std::int32_t i, int, double, double overlap, const vector3&) {
        ++count[b.ids()[i]];
        CHECK(overlap == doctest::Approx(1e-4).epsilon(1e-9));
    });
    CHECK(count[0] == 3);
    CHECK(count[1] == 1);
    CHECK(count[2] == 1);
    CHECK(count[3] == 1);  // on the diagonal of two triangles
}

TEST_CASE("moving walls: a piston pushes, a turning drum carries along, a belt drags without moving") {
    bed_settings s = settings_of();
    {
        bed b(s);
        wall w = wall_of(shape::plane({0, 0, 0}, {0, 0, 1}));
        w.motion.velocity = {0, 0, 0.5};
        b.add_wall(w);
        b.insert({ball({0, 0, 0.03})});
        b.advance(20000);  // the piston has moved 0.1 m
        CHECK(b.motions()[0].velocity.z >= 0.5);
        CHECK(b.motions()[0].velocity.z == doctest::Approx(0.5 * (1 + restitution_of_damping(0.3))).epsilon(1e-3));
        CHECK(b.spheres()[0].centre.z > 0.1);
    }
    {
        bed b(s);  // a square box that turns about its axis keeps its ball inside
        wall w = wall_of(shape::box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}));
        w.motion.spin = {0, 0, 20};
        b.add_wall(w);
        b.insert({ball({0.038, 0.02, 0})});
        for (int k = 0; k < 100; ++k) {
            b.advance(300);  // a whole turn in all
            const double angle = 20 * b.time(), c = std::cos(angle), d = std::sin(angle);
            const vector3 x = b.spheres()[0].centre;
            CHECK(std::fabs(c * x.x + d * x.y) < 0.0402);  // in the box's own frame
            CHECK(std::fabs(c * x.y - d * x.x) < 0.0402);
        }
        CHECK(norm(b.motions()[0].velocity) > 0.5);
    }
    {
        s.gravity = {0, 0, -9.81};
        bed b(s);
        wall w = wall_of(shape::plane({0, 0, 0}, {0, 0, 1}));
        w.conveys = true;
        w.motion.velocity = {0.2, 0, 0};
        b.add_wall(w);
        b.insert({ball({0, 0, 0.0099})});
        b.advance(100000);
        // Sliding until the surfaces agree: a ball from rest ends at 2/7 of the belt's speed, spinning.
        CHECK(b.motions()[0].velocity.x == doctest::Approx(0.2 * 2 / 7).epsilon(5e-3));
    }
}

TEST_CASE("reaction on walls: a ball at rest presses its weight on the floor") {
    bed_settings s = settings_of();
    s.gravity = {0, 0, -9.81};
    bed b(s);
    b.add_wall(wall_of(shape::plane({0, 0, 0}, {0, 0, 1})));
    b.insert({ball({0, 0, 0.00999})});
    b.advance(100000);
    CHECK(-b.force_on_wall(0).z == doctest::Approx(b.mass(0) * 9.81).epsilon(1e-8));
}

TEST_CASE("STL: text and binary give the same triangles; broken files are refused by name") {
    const auto folder = std::filesystem::temp_directory_path() / "hearth_dem_stl";
    std::filesystem::create_directories(folder);
    const auto put = [&](const std::string& name, const std::string& content) {
        std::ofstream(folder / name, std::ios::binary) << content;
        return (folder / name).string();
    };
    const std::string facet_text =
        "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1.5e0 0\n endloop\nendfacet\n";
    const std::string flat_text =
        "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 2 0 0\n endloop\nendfacet\n";
    const std::string text = put("a.stl", "solid part one\n" + facet_text + flat_text + "endsolid part one\n");
    std::string bytes(80, ' ');
    bytes.replace(0, 5, "solid");  // as some programs write it
    const std::uint32_t count = 1;
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    const float numbers[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1.5f, 0};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
    const std::string binary = put("b.stl", bytes);

    std::size_t degenerate = 0;
    const auto one = shape::stl(text, 0.001, &degenerate);
    CHECK(degenerate == 1);
    const auto two = shape::stl(binary, 0.001);
    REQUIRE(one.size() == 1);
    REQUIRE(two.size() == 1);
    for (const auto& facets : {one, two}) CHECK(std::get<triangle>(facets[0]).c.y == doctest::Approx(0.0015));

    CHECK_THROWS_AS(shape::stl((folder / "missing.stl").string()), std::runtime_error);
    CHECK_THROWS_AS(shape::stl(text, -1.0), hearth::bad_value);
    for (const std::string& broken :
         {std::string("solid x\n" + facet_text), std::string("solid x\nfacet\nvertex 1 2\nendfacet\nendsolid"),
          std::string("solid x\nendsolid x\n"), std::string("junk"), std::string(),
          std::string("solid x\nfacet vertex 0 0 0 vertex 1 0 0 endfacet endsolid"),
          bytes.substr(0, bytes.size() - 1), std::string("solid\nfacet vertex nan 0 0 vertex 1 0 0 vertex 0 1 0 endfacet endsolid")}) {
        const std::string path = put("broken.stl", broken);
        CAPTURE(broken);
        CHECK_THROWS_AS(shape::stl(path), std::runtime_error);
        try {
            shape::stl(path);
        } catch (const std::runtime_error& error) {
            CHECK(std::string(error.what()).find("broken.stl") != std::string::npos);
        }
    }
    std::filesystem::remove_all(folder);
}
