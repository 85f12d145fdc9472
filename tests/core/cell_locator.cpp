// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/cell_locator.hpp>
#include <hearth/core/lattice.hpp>

#include "support/box_mesh.hpp"
#include "support/complaint.hpp"
#include "support/polyhedra.hpp"
#include "support/random.hpp"

namespace {

using namespace hearth::test;
using hearth::point;
using hearth_test::seeded;

/// How often the search visits each cell, and the distances that it gives.
template <class Locator>
std::map<int, std::vector<point>> found_near(const Locator& locator, const point& x, double radius, double extents) {
    std::map<int, std::vector<point>> found;
    locator.for_each_near(x, radius, extents,
                          [&](int cell, const point& away, const point&) { found[cell].push_back(away); });
    return found;
}

box_mesh random_boxes(seeded& random) {
    std::array<std::vector<double>, 3> planes;
    std::array<bool, 3> periodic{};
    for (std::size_t a = 0; a < 3; ++a) {
        planes[a] = graded_planes(1, 1 + static_cast<int>(random.index(8)), random.log_uniform(0.4, 2.5));
        periodic[a] = random.index(2) == 0;
    }
    return box_mesh(std::move(planes), periodic, [](int i, int j, int k) { return (i + 3 * j + k) % 4 == 0; });
}

}  // namespace

TEST_CASE("cell locator: finds every cell near a sphere, in each periodic image once") {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        CAPTURE(seed);
        seeded random(seed);
        const box_mesh mesh = random_boxes(random);
        const hearth::cell_graph graph(mesh);
        const hearth::cell_locator locator(mesh, graph);
        const point x{random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2)};
        const double radius = random.log_uniform(1e-3, 1), extents = random.uniform(0.5, 2);
        auto found = found_near(locator, x, radius, extents);
        for (auto& [cell, places] : found) {
            std::sort(places.begin(), places.end());
            CHECK(std::adjacent_find(places.begin(), places.end()) == places.end());
        }
        // All images that can be near: two periods either way.
        const point period = mesh.period();
        const auto turns = [&](std::size_t a) { return period[a] > 0 ? 3 : 0; };
        for (int c = 0; c < mesh.size(); ++c) {
            const point& centre = mesh.centres[static_cast<std::size_t>(c)];
            const point& extent = mesh.extents[static_cast<std::size_t>(c)];
            std::size_t expected = 0;
            for (int k = -turns(2); k <= turns(2); ++k) {
                for (int j = -turns(1); j <= turns(1); ++j) {
                    for (int i = -turns(0); i <= turns(0); ++i) {
                        const std::array<int, 3> turn{i, j, k};
                        bool near = true;
                        for (std::size_t a = 0; a < 3; ++a) {
                            const double away = std::abs(centre[a] + turn[a] * period[a] - x[a]);
                            near = near && away <= (radius + extents * extent[a]) * (1 - 1e-12);
                        }
                        expected += near ? 1 : 0;
                    }
                }
            }
            const auto place = found.find(c);
            CHECK((place == found.end() ? 0 : place->second.size()) >= expected);
        }
    }
}

TEST_CASE("cell locator: finds the cell that holds a point, in boxes and in polyhedra") {
    using cells = polyhedral_mesh::cells;
    for (const cells kind : {cells::tetrahedra, cells::polyhedra}) {
        const polyhedral_mesh mesh(kind, 1, 4);
        // The parts fill the box; each lies in its own cell.
        double volume = 0;
        for (const double v : mesh.volumes) volume += v;
        CHECK(volume == doctest::Approx(1).epsilon(1e-13));
        const hearth::cell_graph graph(mesh);
        const hearth::cell_locator locator(mesh, graph);
        for (int c = 0; c < mesh.size(); ++c) {
            for (const auto& part : mesh.pieces[static_cast<std::size_t>(c)]) CHECK(locator.find(part.centroid) == c);
        }
        CHECK(locator.find({0.5, 1.1, 0.5}) == -1);
    }
    seeded random(3);
    for (int trial = 0; trial < 50; ++trial) {
        const box_mesh mesh = random_boxes(random);
        const hearth::cell_graph graph(mesh);
        const hearth::cell_locator locator(mesh, graph);
        for (int c = 0; c < mesh.size(); ++c) CHECK(locator.find(mesh.centres[static_cast<std::size_t>(c)]) == c);
    }
}

TEST_CASE("cell locator: holds about 60 bytes a cell, nothing for a lattice, and knows the volumes") {
    const box_mesh mesh({graded_planes(3, 30, 1.1), graded_planes(2, 20, 1), graded_planes(1, 10, 0.8)},
                        {false, false, false});
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    // 56 a cell, 4 for each of at most two bins a cell.
    CHECK(locator.memory() <= 64 * 6000 + 2000);
    CHECK(locator.total_volume() == doctest::Approx(6).epsilon(1e-14));
    const hearth::lattice regular{{{30, 20, 10}, {0.1, 0.1, 0.1}, {false, false, false}, {0, 0, 0}}};
    const hearth::cell_graph regular_graph(regular);
    CHECK(hearth::cell_locator(regular, regular_graph).memory() < 200);
}

TEST_CASE("cell locator: refuses centres and extents that are none, by cell and value") {
    const box_mesh good({graded_planes(1, 3, 1), graded_planes(1, 3, 1), graded_planes(1, 3, 1)},
                        {false, false, false});
    const hearth::cell_graph graph(good);
    const auto refusal = [&](auto&& spoil) {
        box_mesh mesh = good;
        spoil(mesh);
        return complaint([&] { hearth::cell_locator(mesh, graph); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(says(refusal([&](auto& m) { m.centres[4][1] = nan; }), "centre of cell 4 is nan, allowed: finite [m]"));
    CHECK(says(refusal([&](auto& m) { m.extents[7][2] = 0; }), "extent of cell 7 is 0, allowed: finite and > 0 [m]"));
    CHECK(says(refusal([&](auto& m) { m.extents[7][0] = -nan; }), "extent of cell 7 is"));
}
