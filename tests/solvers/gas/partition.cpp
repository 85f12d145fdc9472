// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include <doctest/doctest.h>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/partition.hpp>

using namespace hearth::gas;

namespace {

mesh furnace() {
    shaft s;
    s.profile = {{0, 0.1}, {0.3, 0.12}, {0.5, 0.2}};
    s.axial_size = {{0, 0.04}, {0.5, 0.06}};
    s.cross_size = 0.06;
    return mesh(make(s));
}

}  // namespace

TEST_CASE("partition: parts of equal size that hang together, cut across the longest side first") {
    const mesh m(box(graded(1, 4), graded(1, 5), graded(3, 13)));
    for (const int parts : {1, 2, 3, 4, 7, 260}) {
        const array<int> part = partition(m, parts);
        array<int> size(parts, 0);
        for (const int p : part) ++size[p];
        CAPTURE(parts);
        CHECK(*std::max_element(size.begin(), size.end()) - *std::min_element(size.begin(), size.end()) <= 1);
        if (parts == 2)  // 130 cells of 20 a layer: whole layers and half of the seventh
            for (int c = 0; c < m.cells(); ++c) CHECK(part[c] == (m.centre[c].z > 1.5 + 1e-9 ? 1 : part[c]));
        int cut = 0;
        for (int f = 0; f < m.internal_faces(); ++f) cut += part[m.owner[f]] != part[m.neighbour[f]];
        if (parts == 2) CHECK(cut <= 20 + 5);  // a layer, and the step inside one
    }
    CHECK_THROWS_AS(partition(m, 0), std::invalid_argument);
    CHECK_THROWS_AS(partition(m, m.cells() + 1), std::invalid_argument);
}

TEST_CASE("partition: the shares hold every cell, face and patch of the whole once, with its geometry to the bit") {
    const mesh whole = furnace();
    for (const int parts : {1, 2, 3, 5}) {
        const array<int> part = partition(whole, parts);
        array<int> owners(whole.cells(), 0);
        double volume = 0, wall = 0;
        int inner = 0, towards_ghosts = 0, boundary = 0;
        std::set<std::pair<std::int64_t, std::int64_t>> cut;
        for (int rank = 0; rank < parts; ++rank) {
            const mesh m(whole, part, rank);
            CAPTURE(parts); CAPTURE(rank);
            CHECK(m.largest_angle == whole.largest_angle);
            array<vector3> closed(m.owned_cells());
            for (int c = 0; c < m.cells(); ++c) {
                const auto g = m.global[c];
                CHECK(part[g] == (c < m.owned_cells() ? rank : m.ghost_rank[c - m.owned_cells()]));
                CHECK(m.volume[c] == whole.volume[g]);
                CHECK(norm(m.centre[c] - whole.centre[g]) == 0);
                if (c < m.owned_cells()) ++owners[g];
                else if (c > m.owned_cells())
                    CHECK(std::make_pair(part[m.global[c - 1]], m.global[c - 1]) < std::make_pair(part[g], g));
            }
            for (int f = 0; f < m.faces(); ++f) {
                CHECK(m.owner[f] < m.owned_cells());
                closed[m.owner[f]] += m.area[f];
                const bool inside = f < m.internal_faces(), ghost = inside && m.neighbour[f] >= m.owned_cells();
                if (inside && !ghost) closed[m.neighbour[f]] -= m.area[f];
                (ghost ? towards_ghosts : inside ? inner : boundary) += 1;
                if (!ghost) continue;
                const auto p = m.global[m.owner[f]], q = m.global[m.neighbour[f]];
                cut.insert({std::min(p, q), std::max(p, q)});
                CHECK(dot(m.area[f], m.centre[m.neighbour[f]] - m.centre[m.owner[f]]) > 0);
            }
            for (int c = 0; c < m.owned_cells(); ++c) {
                CHECK(norm(closed[c]) < 1e-14 * std::cbrt(m.volume[c]));  // round-off of areas below 0.01
                volume += m.volume[c];
                CHECK(m.find_cell(m.centre[c]) == c);
            }
            for (int c = m.owned_cells(); c < m.cells(); ++c) CHECK(m.find_cell(m.centre[c]) == -1);
            wall += m.area_of(m.find_patch("wall"));
        }
        for (const int n : owners) CHECK(n == 1);
        double whole_volume = 0;
        for (const double v : whole.volume) whole_volume += v;
        CHECK(volume == doctest::Approx(whole_volume).epsilon(1e-13));
        CHECK(2 * static_cast<int>(cut.size()) == towards_ghosts);
        CHECK(inner + towards_ghosts / 2 == whole.internal_faces());
        CHECK(boundary == whole.boundary_faces());
        CHECK(wall == doctest::Approx(whole.area_of(whole.find_patch("wall"))).epsilon(1e-13));
    }
    CHECK_THROWS_AS(mesh(whole, partition(whole, 2), 2), std::invalid_argument);
}
