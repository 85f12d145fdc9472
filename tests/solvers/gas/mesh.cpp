// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include <hearth/core/conformance.hpp>
#include <hearth/gas/generate.hpp>
#include <hearth/gas/mesh.hpp>
#include <hearth/gas/mesh_traits.hpp>

using namespace hearth::gas;

namespace {

const double pi = std::acos(-1.0);

double total_volume(const mesh& m) {
    double sum = 0;
    for (const double v : m.volume) sum += v;
    return sum;
}

polyhedra small_box() { return box(graded(1, 3), graded(1, 2), graded(1, 2)); }

/// Runs the check on a broken box and returns what it says.
template <class Break>
mesh_error broken(Break&& damage) {
    polyhedra p = small_box();
    damage(p);
    try {
        mesh m(std::move(p));
    } catch (const mesh_error& e) {
        return e;
    }
    FAIL("the mesh was accepted");
    return {"", -1, -1};
}

}  // namespace

TEST_CASE("mesh: a graded box has its volume, its patches and straight conductances") {
    const mesh m(box(graded(2, 7, 5.0), graded(3, 4), graded(0.5, 3, 0.2)));
    CHECK(m.owned_cells() == 7 * 4 * 3);
    CHECK(total_volume(m) == doctest::Approx(3).epsilon(1e-13));  // 84 cells times a few ulp
    CHECK(m.area_of(m.find_patch("x_min")) == doctest::Approx(1.5).epsilon(1e-13));
    CHECK(m.area_of(m.find_patch("z_max")) == doctest::Approx(6).epsilon(1e-13));
    CHECK(m.largest_angle < 1e-5);  // acos(1 - ulp) is 1e-6 degree
    CHECK_THROWS_WITH_AS(m.find_patch("lid"), doctest::Contains("x_min, y_min"), std::invalid_argument);
}

TEST_CASE("mesh: a warped box still has closed cells and the volume that its outer faces enclose") {
    const auto warp = [](const vector3& p) {
        const double bump = 0.08 * std::sin(pi * p.x) * std::sin(pi * p.y) * std::sin(pi * p.z);
        return vector3{p.x + bump, p.y - bump, p.z + 0.5 * bump};
    };
    const mesh m(box(graded(1, 8), graded(1, 8), graded(1, 8), warp));
    CHECK(total_volume(m) == doctest::Approx(1).epsilon(1e-12));  // 512 cells, faces shared exactly
    CHECK(m.largest_angle > 5);
}

TEST_CASE("mesh: check names the place of each fault") {
    CHECK(broken([](polyhedra& p) { std::swap(p.owner[2], p.neighbour[2]); }).face == 2);
    CHECK(broken([](polyhedra& p) { p.points[4].x = std::nan(""); }).what() == doctest::Contains("point 4"));
    CHECK(broken([](polyhedra& p) { p.patches[1].count -= 1; }).what() == doctest::Contains("patch"));
    CHECK(broken([](polyhedra& p) { p.patches.pop_back(); }).what() == doctest::Contains("the patches end"));
    CHECK(broken([](polyhedra& p) { p.face_points[0] = 999; }).face == 0);
    CHECK(broken([](polyhedra& p) { p.owner[p.owner.size() - 1] = 0; }).cell >= 0);       // open cell
    CHECK(broken([](polyhedra& p) { p.points[5].x = -3; }).cell >= 0);                     // folded over
    CHECK(broken([](polyhedra& p) { for (auto& q : p.points) q.z = -q.z; }).cell >= 0);    // inside out
    CHECK(broken([](polyhedra& p) { for (auto& q : p.points) q.z = 0; }).face >= 0);       // flat
}

TEST_CASE("mesh: find_cell finds every centre, points near corners, and nothing outside") {
    shaft s;
    s.profile = {{0, 0.4}, {1, 0.4}, {1.5, 0.8}};
    s.axial_size = {{0, 0.1}};
    s.cross_size = 0.1;
    const mesh m(make(s));
    for (int c = 0; c < m.owned_cells(); ++c) CHECK(m.find_cell(m.centre[c]) == c);
    std::mt19937_64 random(7);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < 5000; ++i) {
        const double r = 0.39 * std::sqrt(uniform()), a = 2 * pi * uniform(), z = uniform();
        const vector3 x{r * std::cos(a), r * std::sin(a), z};
        CAPTURE(x.x); CAPTURE(x.y); CAPTURE(x.z);
        CHECK(m.find_cell(x) >= 0);
    }
    CHECK(m.find_cell({0.6, 0, 0.5}) == -1);
    CHECK(m.find_cell({0, 0, -0.01}) == -1);
    CHECK(m.find_cell({std::nan(""), 0, 0}) == -1);

    mesh early = m;  // a search that exists needs no points, a new one does
    early.release_shape();
    CHECK(early.find_cell(m.centre[7]) == 7);
    mesh never(box(graded(1, 2), graded(1, 2), graded(1, 2)));
    never.release_shape();
    CHECK_THROWS_AS(never.find_cell({0.5, 0.5, 0.5}), std::logic_error);
    CHECK_THROWS_AS(mesh(never, array<int>(8, 0), 0), std::logic_error);
}

TEST_CASE("mesh: renumbering keeps geometry and patches and narrows the band") {
    polyhedra p = box(graded(1, 6), graded(1, 5), graded(1, 4));
    array<int> shuffle(120);
    for (int i = 0; i < 120; ++i) shuffle[i] = (i * 77) % 120;  // 77 and 120 share no factor: a permutation
    for (std::size_t f = 0; f < p.owner.size(); ++f) {
        p.owner[f] = shuffle[p.owner[f]];
        if (f < p.neighbour.size()) {
            p.neighbour[f] = shuffle[p.neighbour[f]];
            if (p.owner[f] > p.neighbour[f]) {
                std::swap(p.owner[f], p.neighbour[f]);
                std::reverse(&p.face_points[p.face_first[f]], &p.face_points[p.face_first[f + 1] - 1] + 1);
            }
        }
    }
    const mesh before(p);
    array<int> number;
    const mesh after(renumbered(p, &number));
    const auto band = [](const mesh& m) {
        int widest = 0;
        for (int f = 0; f < m.internal_faces(); ++f) widest = std::max(widest, m.neighbour[f] - m.owner[f]);
        return widest;
    };
    CHECK(band(before) > 60);
    CHECK(band(after) <= 30);  // the largest cross section of a 4 x 5 x 6 box by levels is below 30
    for (int c = 0; c < 120; ++c) CHECK(norm(before.centre[c] - after.centre[number[c]]) < 1e-14);
    for (const patch& q : before.patches)
        CHECK(after.area_of(after.find_patch(q.name)) == doctest::Approx(before.area_of(q)).epsilon(1e-14));
}

TEST_CASE("shaft: volume, wall, burners and outlet have their true sizes") {
    shaft s;
    s.profile = {{0, 0.425}, {10, 0.425}, {11, 1.0}};
    s.axial_size = {{0, 0.02}, {1, 0.1}, {7.9, 0.02}, {8.1, 0.02}, {10, 0.1}};
    s.cross_size = 0.05;
    s.burners = s.outlet = true;
    const mesh m(make(s));
    const double cone = pi / 3 * (0.425 * 0.425 + 0.425 * 1.0 + 1.0);
    CHECK(total_volume(m) == doctest::Approx(pi * 0.425 * 0.425 * 10 + cone).epsilon(1e-10));
    CHECK(m.area_of(m.find_patch("bottom")) == doctest::Approx(pi * 0.425 * 0.425).epsilon(1e-12));
    for (int i = 0; i < 12; ++i) {
        const double area = m.area_of(m.find_patch("burner_" + std::to_string(i)));
        CHECK(area == doctest::Approx(pi / 4 * 0.015 * 0.015).epsilon(1e-10));
    }
    CHECK(m.area_of(m.find_patch("outlet")) == doctest::Approx(pi / 4 * 0.16).epsilon(1e-10));
    const double slant = pi * 1.425 * std::sqrt(1 + 0.575 * 0.575);
    double side = m.area_of(m.find_patch("wall")) + m.area_of(m.find_patch("outlet"));
    for (int i = 0; i < 12; ++i) side += m.area_of(m.find_patch("burner_" + std::to_string(i)));
    // perimeter of an N-gon of the circle's area exceeds the circle's by pi^2/(6 N^2): 0.05 % at N = 60
    CHECK(side == doctest::Approx(2 * pi * 0.425 * 10 + slant).epsilon(1.5e-3));
    CHECK(m.largest_angle < 60);
    const auto& p = m.find_patch("burner_0");
    CHECK(std::abs(m.face_centre[p.first].z - 8) < 0.01);
}

TEST_CASE("shaft: settings that make no mesh are refused") {
    shaft s;
    s.profile = {{0, 0.4}};
    CHECK_THROWS_AS(make(s), std::invalid_argument);
    s.profile = {{0, 0.4}, {1, -0.4}};
    CHECK_THROWS_AS(make(s), std::invalid_argument);
    s.profile = {{0, 0.4}, {1, 0.4}};
    s.burners = true;  // at 8 m: outside
    CHECK_THROWS_AS(make(s), std::invalid_argument);
    s.burner.count = 7;
    CHECK_THROWS_AS(make(s), std::invalid_argument);
}

TEST_CASE("mesh: conforms to the library's mesh traits, all tiers") {
    shaft s;
    s.profile = {{0, 0.4}, {1, 0.4}, {1.3, 0.6}};
    s.axial_size = {{0, 0.1}};
    s.cross_size = 0.1;
    const mesh m(make(s));
    static_assert(hearth::is_located_mesh_v<mesh> && hearth::is_faced_mesh_v<mesh> && hearth::has_global_index_v<mesh>);
    const hearth::conformance_report found = hearth::conformance(m);
    for (const auto& failure : found.failures) MESSAGE(failure);
    CHECK(found.passed());
    CHECK(found.checks > m.cells());
}
