// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <hearth/core/lattice.hpp>
#include <hearth/voidage/vfs.hpp>

#include "support/meshes.hpp"
#include "support/vfs_cases.hpp"

using namespace hearth;
using namespace hearth::test;

TEST_CASE("vfs completion: a ring takes what is stuck in proportion to its room") {
    // A star whose hub and leaves 1, 2 are over-full: the hub gives 0.6 to leaves 3 and 4; leaves 1 and 2 are stuck with
    // 0.3 and 0.2, reach the hub together, which has no room, and then leaves 3 and 4, which have room for 0.5 and 0.3.
    listed_graph graph;
    graph.volumes = {1, 1, 1, 1, 1};
    for (std::size_t leaf = 1; leaf < 5; ++leaf) graph.link(0, leaf);
    std::vector<double> field{1.5, 1.2, 1.1, 0.1, 0.3};
    const vfs_report report = smooth_volume_fraction(graph, field, {0.9});
    CHECK(report.stuck_cells == 2);
    CHECK(report.rings == 2);
    // Of that room the 0.5 that was stuck takes 5/8.
    CHECK(field[3] == doctest::Approx(0.4 + 0.5 * 5 / 8).epsilon(1e-14));
    CHECK(field[4] == doctest::Approx(0.6 + 0.3 * 5 / 8).epsilon(1e-14));
    CHECK(field[0] == 0.9);
    CHECK(field[1] == 0.9);
    CHECK(field[2] == 0.9);
}

TEST_CASE("vfs completion: regions that meet share their room, wherever each came from") {
    // Two blocks of three over-full cells, each with a stuck cell in its middle.  The one cell between them cannot hold
    // what the two inner cells give it, and is stuck as well.
    const lattice mesh{{{13, 1, 1}}};
    std::vector<double> field(13, 0.0);
    for (const std::size_t c : {3u, 4u, 5u, 7u, 8u, 9u}) field[c] = 2;
    const vfs_report report = smooth_volume_fraction(mesh, field, {1.0});
    CHECK(report.maximum == 1);
    for (std::size_t c = 0; c < 13; ++c) CHECK(field[c] == doctest::Approx(field[12 - c]).epsilon(1e-15));
    double sum = 0;
    for (const double s : field) sum += s;
    CHECK(sum == doctest::Approx(12).epsilon(1e-15));
}

TEST_CASE("vfs completion: what is stuck stays near, where there is room") {
    // A ball of 7 over-full cells in an empty lattice: only its centre is stuck, and its solid must not go farther than
    // the ring that has room for it.
    const lattice mesh{{{15, 15, 15}}};
    std::vector<double> field(3375, 0.0);
    const std::size_t centre = 7 + 15 * (7 + 15 * 7);
    for (const std::size_t c : {centre, centre - 1, centre + 1, centre - 15, centre + 15, centre - 225, centre + 225}) field[c] = 1.5;
    const vfs_report report = smooth_volume_fraction(mesh, field, {0.9});
    CHECK(report.stuck_cells == 1);
    CHECK(report.rings == 2);
    for (std::size_t c = 0; c < 3375; ++c) {
        const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
        const std::size_t distance = apart(c % 15, 7) + apart(c / 15 % 15, 7) + apart(c / 225, 7);
        if (distance > 2) CHECK(field[c] == 0);
    }
}

TEST_CASE("vfs completion: moves solid a few cells, not through the mesh") {
    // On a chain the net flux through each face is known from the fields before and after; its sum over the faces is the
    // way that the solid went.  Each unit of excess has to pass one face at least.
    seeded random(17);
    double moved = 0, least = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const int cells = 40;
        const lattice mesh{{{cells, 1, 1}}};
        std::vector<double> field(static_cast<std::size_t>(cells));
        double sum = 0;
        for (double& s : field) sum += s = random.uniform(0, 1) < 0.3 ? random.uniform(0.9, 3) : random.uniform(0, 0.4);
        if (sum > 0.85 * cells) continue;
        auto after = field;
        (void)smooth_volume_fraction(mesh, after, {0.9});
        double flux = 0;
        for (std::size_t c = 0; c < field.size(); ++c) {
            flux += field[c] - after[c];
            moved += std::abs(flux);
        }
        for (const double s : field) least += std::max(0.0, s - 0.9);
    }
    CHECK(moved >= least);
    CHECK(moved <= 6 * least);  // at a mean load of 84 % of the threshold the next room is some cells away
}

TEST_CASE("vfs completion: ends on graphs made to be hard, with work linear in the cells") {
    const auto run = [](const listed_graph& graph, std::vector<double> field, double threshold) {
        const vfs_report report = smooth_volume_fraction(graph, field, {threshold});
        CHECK(report.maximum <= threshold * (1 + 1e-14));
        CHECK(report.visited_cells <= graph.cell_count());
        return report;
    };
    const std::size_t n = 100000;
    SUBCASE("all over-full but the far end of a chain") {
        const listed_graph graph = random_graph(graph_kind::chain, n, 1, 1);
        std::vector<double> field(n, 1.0);
        std::fill(field.begin() + n / 2, field.end(), 0.0);
        const vfs_report report = run(graph, field, 0.5);
        CHECK(report.stuck_cells == n / 2 - 1);
    }
    SUBCASE("a star with a heap on every leaf but one") {
        const listed_graph graph = random_graph(graph_kind::star, n, 1e6, 2);
        std::vector<double> field(n, 0.5 + 1e-9);
        field[n / 2] = field[0] = 0;
        (void)run(graph, field, 0.5);
    }
    SUBCASE("tubes of all lengths that meet in one reservoir, each with a heap at its end") {
        listed_graph graph;
        graph.volumes = {1e5};
        std::vector<double> field{0.1};
        for (std::size_t length = 2; length < 400; ++length) {
            std::size_t last = 0;
            for (std::size_t k = 0; k < length; ++k) {
                graph.volumes.push_back(1);
                field.push_back(0.9);
                graph.link(last, field.size() - 1);
                last = field.size() - 1;
            }
            field.back() = 0.95;
        }
        const vfs_report report = run(graph, field, 0.9);
        CHECK(report.sweeps >= 399);
    }
    SUBCASE("combs full of dead ends, exactly full") {
        listed_graph graph = random_graph(graph_kind::comb, n, 1e6, 3);
        std::vector<double> field(graph.volumes.size(), 0.0);
        field[n / 2] = 0.7 * graph.volume() / graph.volumes[n / 2];
        (void)run(graph, field, 0.7);
    }
}
