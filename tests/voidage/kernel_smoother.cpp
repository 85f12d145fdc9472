// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/csr_graph.hpp>
#include <hearth/core/lattice.hpp>
#include <hearth/voidage/kernel_smoother.hpp>

#include "support/box_mesh.hpp"
#include "support/complaint.hpp"
#include "support/random.hpp"
#include "support/thread_communicator.hpp"

namespace {

using namespace hearth::test;
using hearth::point;
using hearth_test::seeded;

box_mesh random_mesh(seeded& random) {
    std::array<std::vector<double>, 3> planes;
    std::array<bool, 3> periodic{};
    for (std::size_t a = 0; a < 3; ++a) {
        planes[a] = graded_planes(random.log_uniform(0.2, 5), 1 + static_cast<int>(random.index(9)),
                                  random.log_uniform(0.5, 2));
        periodic[a] = random.index(2) == 0;
    }
    const auto salt = random.index(5);
    return box_mesh(std::move(planes), periodic,
                    [&](int i, int j, int k) { return (static_cast<std::size_t>(i + 3 * j + 7 * k) + salt) % 5 == 0; });
}

std::vector<double> random_field(seeded& random, int count) {
    std::vector<double> field;
    for (int c = 0; c < count; ++c) field.push_back(random.uniform(0, 1) * (random.index(4) == 0 ? 10 : 1));
    return field;
}

template <class Graph>
long double inner(const Graph& graph, const std::vector<double>& f, const std::vector<double>& g) {
    long double sum = 0;
    for (int c = 0; c < graph.cell_count(); ++c) {
        const auto i = static_cast<std::size_t>(c);
        sum +=
            static_cast<long double>(graph.volume(c)) * static_cast<long double>(f[i]) * static_cast<long double>(g[i]);
    }
    return sum;
}

/// exp(-t L) f by so many small explicit steps of Euler, extrapolated: no Chebyshev, no Clenshaw.
template <class Graph>
std::vector<double> diffused(const Graph& graph, std::vector<double> field, double time, int steps) {
    std::vector<double> next(field.size());
    for (int s = 0; s < steps; ++s) {
        for (int c = 0; c < graph.cell_count(); ++c) {
            const auto i = static_cast<std::size_t>(c);
            double sum = 0;
            for (auto k = graph.row_begin(c); k < graph.row_end(c); ++k) {
                sum += static_cast<double>(graph.conductances()[k]) *
                       (field[static_cast<std::size_t>(graph.neighbours()[k])] - field[i]);
            }
            next[i] = field[i] + time / steps * sum / graph.volume(c);
        }
        field.swap(next);
    }
    return field;
}

}  // namespace

TEST_CASE("kernel smoother: keeps volume, constants and symmetry on any mesh") {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        seeded random(seed);
        const box_mesh mesh = random_mesh(random);
        const hearth::cell_graph graph(mesh);
        hearth::kernel_smoother smoother(graph, random.uniform(0, 0.5));
        CAPTURE(smoother.terms());
        const std::vector<double> f = random_field(random, mesh.size()), g = random_field(random, mesh.size());
        const std::vector<double> ones(f.size(), 1.0);
        auto smooth_f = f, smooth_g = g, constant = std::vector<double>(f.size(), 0.7);
        const auto report = smoother.smooth(smooth_f);
        smoother.smooth(smooth_g);
        smoother.smooth(constant);
        // Each term rounds a cell a few times; errors add up at worst like the number of terms squared (the
        // recurrence).
        const double terms = smoother.terms() + 2;
        const double roundoff = 2.3e-16 * 10 * terms * terms;
        CHECK(inner(graph, smooth_f, ones) / inner(graph, f, ones) == doctest::Approx(1).epsilon(roundoff));
        CHECK(inner(graph, smooth_f, g) / inner(graph, f, smooth_g) ==
              doctest::Approx(1).epsilon(std::min(roundoff, 1e-12)));
        for (const double value : constant) CHECK(value == doctest::Approx(0.7).epsilon(roundoff));
        CHECK(report.lowest >= 0);
        CHECK(report.highest <= 10 * (1 + roundoff));
    }
}

TEST_CASE("kernel smoother: solves the heat equation of the graph") {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        CAPTURE(seed);
        seeded random(seed);
        const box_mesh mesh({graded_planes(1, 6, 1.2), graded_planes(1, 5, 1), graded_planes(1, 4, 0.8)},
                            {false, true, false}, [](int i, int j, int k) { return (i + j + k) % 3 == 0; });
        const hearth::cell_graph graph(mesh);
        const double width = random.uniform(0.05, 0.3), time = 0.5 * width * width;
        auto field = random_field(random, mesh.size());
        // Euler with n steps is off by a/n + b/n^2: two extrapolations leave terms of third order in the step.
        const int n = 4000;
        const auto coarse = diffused(graph, field, time, n), fine = diffused(graph, field, time, 2 * n),
                   finest = diffused(graph, field, time, 4 * n);
        hearth::kernel_smoother(graph, width, {1e-12}).smooth(field);
        for (std::size_t c = 0; c < field.size(); ++c) {
            const double a = 2 * fine[c] - coarse[c], b = 2 * finest[c] - fine[c];
            const double exact = (4 * b - a) / 3;
            // (time lambda)^4 / n^3 with time lambda < 40 here, and 16000 roundings.
            CHECK(std::abs(field[c] - exact) < 1e-8);
        }
    }
}

TEST_CASE("kernel smoother: the second moment is the width squared on cells of any shape") {
    for (const point spacing : {point{1, 1, 1}, point{1, 1, 5}, point{0.2, 1, 3}}) {
        for (const double width : {0.3, 1.0, 3.0}) {
            CAPTURE(spacing[2]);
            CAPTURE(width);
            hearth::lattice mesh;
            std::array<int, 3> middle{};
            for (std::size_t a = 0; a < 3; ++a) {
                // 8 widths to each side: 1e-14 of the kernel is beyond.  Coarse lattices spread at most a cell a term.
                middle[a] = 12 + static_cast<int>(8 * width / spacing[a]);
                mesh.cells[a] = 2 * middle[a] + 1;
                mesh.spacing[a] = spacing[a];
            }
            const hearth::cell_graph graph(mesh);
            hearth::kernel_smoother smoother(graph, width);
            std::vector<double> field(static_cast<std::size_t>(graph.cell_count()), 0.0);
            const int source = middle[0] + mesh.cells[0] * (middle[1] + mesh.cells[1] * middle[2]);
            field[static_cast<std::size_t>(source)] = 1;
            smoother.smooth(field);
            const point from = hearth::mesh_traits<hearth::lattice>::centre(mesh, source);
            point moment{};
            for (int c = 0; c < graph.cell_count(); ++c) {
                const point x = hearth::mesh_traits<hearth::lattice>::centre(mesh, c);
                for (std::size_t a = 0; a < 3; ++a)
                    moment[a] += field[static_cast<std::size_t>(c)] * (x[a] - from[a]) * (x[a] - from[a]);
            }
            // Conductances are floats: 6e-8.
            for (std::size_t a = 0; a < 3; ++a) CHECK(moment[a] == doctest::Approx(width * width).epsilon(1e-7));
        }
    }
}

TEST_CASE("kernel smoother: tends to the Gaussian") {
    hearth::lattice mesh{{{65, 65, 1}, {0.125, 0.125, 1}, {false, false, false}, {-65 * 0.0625, -65 * 0.0625, 0}}};
    const hearth::cell_graph graph(mesh);
    hearth::kernel_smoother smoother(graph, 1.0);
    std::vector<double> field(65 * 65, 0.0);
    field[32 + 65 * 32] = 1 / (0.125 * 0.125);
    smoother.smooth(field);
    for (int c = 0; c < 65 * 65; ++c) {
        const point x = hearth::mesh_traits<hearth::lattice>::centre(mesh, c);
        const double r2 = x[0] * x[0] + x[1] * x[1];
        if (r2 > 4) continue;
        // Second order in h / width = 1/8: the discrete rate is less by h^2 k^4 / 12, which with t = 1/2 takes
        // h^2/24 <k^4> = h^2/24 * 2 * 3 of the peak, 0.4 %.
        CHECK(std::abs(field[static_cast<std::size_t>(c)] - std::exp(-r2 / 2) / (2 * 3.14159265358979)) <
              0.005 / (2 * 3.14159265358979));
    }
}

TEST_CASE("kernel smoother: the lattice path gives the bits of the general path") {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        seeded random(seed);
        hearth::lattice mesh;
        std::array<std::vector<double>, 3> planes;
        for (std::size_t a = 0; a < 3; ++a) {
            mesh.cells[a] = 1 + static_cast<int>(random.index(9));
            mesh.spacing[a] =
                0.25 * static_cast<double>(1 + random.index(4));  // exact, so that both meshes are the same
            mesh.periodic[a] = random.index(2) == 0;
            for (int i = 0; i <= mesh.cells[a]; ++i) planes[a].push_back(i * mesh.spacing[a]);
        }
        const box_mesh boxes(planes, mesh.periodic);
        const hearth::cell_graph on_lattice(mesh);
        const hearth::cell_graph on_boxes(boxes);
        REQUIRE(on_lattice.lattice().has_value());
        const double width = random.uniform(0, 3);
        auto a = random_field(random, boxes.size());
        auto b = a;
        hearth::kernel_smoother(on_lattice, width).smooth(a);
        hearth::kernel_smoother(on_boxes, width).smooth(b);
        CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
    }
}

TEST_CASE("kernel smoother: the same bits on any number of ranks") {
    const box_mesh mesh({graded_planes(2, 8, 1.2), graded_planes(1, 7, 1), graded_planes(1, 6, 0.8)},
                        {false, true, false}, [](int i, int j, int k) { return (i + j + k) % 4 == 0; });
    seeded random(1);
    const std::vector<double> input = random_field(random, mesh.size());
    std::vector<double> expected = input;
    const hearth::cell_graph serial(mesh);
    const auto expected_report = hearth::kernel_smoother(serial, 0.4).smooth(expected);
    for (const int ranks : {1, 2, 3, 4, 5, 8}) {
        CAPTURE(ranks);
        const std::vector<int> owners = random_owners(mesh.size(), ranks, static_cast<std::uint64_t>(ranks));
        std::vector<double> result(expected.size(), -1.0);
        on_ranks(ranks, [&](thread_communicator communicator) {
            const box_share share(mesh, owners, communicator.rank(), 7);
            const hearth::cell_graph graph(share, communicator);
            std::vector<double> field;
            for (const int c : share.cells) field.push_back(input[static_cast<std::size_t>(c)]);
            const auto report = hearth::kernel_smoother(graph, 0.4).smooth(field);
            for (std::size_t c = 0; c < field.size(); ++c) result[static_cast<std::size_t>(share.cells[c])] = field[c];
            if (report.lowest != expected_report.lowest || report.highest != expected_report.highest) {
                throw std::logic_error("the report depends on the ranks");
            }
        });
        CHECK(std::memcmp(result.data(), expected.data(), result.size() * sizeof(double)) == 0);
    }
}

TEST_CASE("kernel smoother: leaves single cells, islands and a width of zero alone") {
    const hearth::lattice single;
    const hearth::cell_graph graph(single);
    std::vector<double> one{0.4};
    CHECK(hearth::kernel_smoother(graph, 10.0).smooth(one).terms == 0);
    CHECK(one[0] == 0.4);
    const box_mesh pair({{{0, 1, 2}, {0, 1}, {0, 1}}}, {false, false, false});
    const hearth::cell_graph two(pair);
    std::vector<float> field{1.0F, 0.0F};
    hearth::kernel_smoother(two, 0.0).smooth(field);
    CHECK(field[0] == 1.0F);
    hearth::kernel_smoother(two, 100.0).smooth(field);
    // Long mixed: the mean, to the tolerance of the series.
    CHECK(static_cast<double>(field[0]) == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(static_cast<double>(field[0] + field[1]) == doctest::Approx(1.0).epsilon(1e-6));
}

TEST_CASE("kernel smoother: bad input is refused on all ranks and the field stays") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const box_mesh mesh({{{0, 1, 2, 3}, {0, 1}, {0, 1}}}, {false, false, false});
    const hearth::cell_graph graph(mesh);
    CHECK(
        says(complaint([&] { hearth::kernel_smoother(graph, -1.0); }), "kernel_smoother width is -1, allowed: finite"));
    CHECK(says(complaint([&] { hearth::kernel_smoother(graph, nan); }), "kernel_smoother width is nan"));
    CHECK(
        says(complaint([&] { hearth::kernel_smoother(graph, 1.0, {0.0}); }), "tolerance is 0, allowed: in (0, 0.01]"));
    CHECK(says(complaint([&] { hearth::kernel_smoother(graph, 1.0, {0.2}); }), "tolerance is 0.2"));
    const std::vector<int> offsets{0, 1, 2}, neighbours{1, 0};
    const std::vector<double> volumes{1, 1};
    const hearth::csr_graph bare{2, offsets.data(), neighbours.data(), volumes.data()};
    const hearth::cell_graph faceless(bare);
    CHECK(says(complaint([&] { hearth::kernel_smoother(faceless, 1.0); }), "mesh_traits need for_each_face"));

    std::vector<std::string> texts(3);
    on_ranks(3, [&](thread_communicator communicator) {
        const box_share share(mesh, {0, 1, 2}, communicator.rank(), 1);
        const hearth::cell_graph part(share, communicator);
        hearth::kernel_smoother smoother(part, 1.0);
        std::vector<double> field{communicator.rank() == 1 ? nan : 0.5};
        texts[static_cast<std::size_t>(communicator.rank())] = complaint([&] { smoother.smooth(field); });
        if (communicator.rank() != 1 && field[0] != 0.5) throw std::logic_error("the field has changed");
    });
    for (const std::string& text : texts) CHECK(says(text, "field to smooth, cell 1 is nan, allowed: finite"));
}
