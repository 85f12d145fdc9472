// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <hearth/voidage/vfs.hpp>

#include "support/meshes.hpp"
#include "support/vfs_cases.hpp"

using namespace hearth;
using namespace hearth::test;

namespace {

/// A smoothed case with its log.
struct smoothed_case {
    vfs_case example;
    cell_graph<> graph;
    volume_fraction_smoother<cell_graph<>> smoother;
    std::vector<double> field;
    vfs_report report;

    explicit smoothed_case(int seed, vfs_variant variant = vfs_variant::completed)
        : example(static_cast<std::uint64_t>(seed), 3000),
          graph(example.graph),
          smoother(graph, {example.threshold, variant}),
          field(example.solid_fraction),
          report(smoother.smooth(field)) {}
};

std::vector<double> random_field(std::size_t size, seeded& random) {
    std::vector<double> field(size);
    for (double& v : field) v = random.uniform(-1, 1);
    return field;
}

}  // namespace

TEST_CASE("vfs transfer: the volume scattered by its own log is the smoothed field") {
    for (int seed = 1; seed <= 300; ++seed) {
        CAPTURE(seed);
        smoothed_case run(seed, seed % 3 == 0 ? vfs_variant::paper : vfs_variant::completed);
        const auto& volumes = run.example.graph.volumes;
        std::vector<double> amounts(volumes.size());
        for (std::size_t c = 0; c < amounts.size(); ++c) amounts[c] = run.example.solid_fraction[c] * volumes[c];
        run.smoother.scatter(amounts);
        const auto solid = volumes_of_components(run.example.graph, run.example.labels, run.field);
        // The replay rounds at each of its steps, and round-off that a full component carries above its threshold stays
        // where it was: both within 1e-13 of what the component holds.
        for (std::size_t c = 0; c < amounts.size(); ++c) {
            const auto all = static_cast<double>(solid[static_cast<std::size_t>(run.example.labels[c])]);
            CHECK(std::abs(amounts[c] - run.field[c] * volumes[c]) <= 1e-13 * all);
        }
    }
}

TEST_CASE("vfs transfer: sums stay, constants stay, and gather is the transpose of scatter") {
    seeded random(8);
    int completed = 0;
    for (int seed = 1; seed <= 300; ++seed) {
        CAPTURE(seed);
        smoothed_case run(seed);
        const std::size_t cells = run.field.size();
        const auto amounts = random_field(cells, random), values = random_field(cells, random);
        auto scattered = amounts, gathered = values;
        run.smoother.scatter(scattered);
        run.smoother.gather(gathered);
        long double sum = 0, scattered_sum = 0, forward = 0, backward = 0, scale = 0;
        for (std::size_t c = 0; c < cells; ++c) {
            sum += static_cast<long double>(amounts[c]);
            scattered_sum += static_cast<long double>(scattered[c]);
            scale += static_cast<long double>(std::abs(amounts[c]));
            forward += static_cast<long double>(scattered[c]) * static_cast<long double>(values[c]);
            backward += static_cast<long double>(amounts[c]) * static_cast<long double>(gathered[c]);
        }
        CHECK(std::abs(scattered_sum - sum) <= 1e-13L * scale);
        CHECK(std::abs(forward - backward) <= 1e-12L * scale);
        // Column sums: the transpose of ones.
        std::vector<double> ones(cells, 1.0);
        run.smoother.gather(ones);
        for (const double one : ones) CHECK(std::abs(one - 1) <= 1e-13);
        // A mean never leaves the bounds of what it is taken of.
        const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
        for (const double v : gathered) CHECK((v >= *lowest - 1e-13 && v <= *highest + 1e-13));
        completed += run.report.stuck_cells > 0 ? 1 : 0;
    }
    CHECK(completed > 100);
}

TEST_CASE("vfs transfer: what is positive stays positive") {
    for (int seed = 1; seed <= 100; ++seed) {
        CAPTURE(seed);
        smoothed_case run(seed);
        std::vector<double> amounts(run.field.size(), 0.0);
        amounts[static_cast<std::size_t>(seed) % amounts.size()] = 1;
        run.smoother.scatter(amounts);
        for (const double a : amounts) CHECK(a >= 0);
    }
}

TEST_CASE("vfs transfer: without a former call, and after an idle one, nothing moves") {
    smoothed_case run(1);
    volume_fraction_smoother<cell_graph<>> fresh(run.graph, {1.0});
    seeded random(4);
    const auto before = random_field(run.field.size(), random);
    auto amounts = before;
    fresh.scatter(amounts);
    fresh.gather(amounts);
    CHECK(amounts == before);
    std::vector<double> low(run.field.size(), 0.1);
    (void)run.smoother.smooth(low);
    run.smoother.scatter(amounts);
    CHECK(amounts == before);
}

TEST_CASE("vfs transfer: what is not finite is refused by its cell, and the field stays") {
    const double infinite = std::numeric_limits<double>::infinity();
    seeded random(12);
    int refused = 0;
    for (int seed = 1; seed <= 100; ++seed) {
        CAPTURE(seed);
        smoothed_case run(seed);
        const auto good = random_field(run.field.size(), random);
        const std::size_t at = random.index(good.size());
        CAPTURE(at);
        const auto refuses = [&](auto&& call, const char* what) {
            auto spoilt = good;
            spoilt[at] = infinite;
            try {
                call(spoilt);
                // Allowed where the map leaves the cell alone: nothing else may have been touched by it.
                for (const double v : spoilt) CHECK_FALSE(std::isnan(v));
                CHECK(std::count(spoilt.begin(), spoilt.end(), infinite) == 1);
            } catch (const bad_value& error) {
                ++refused;
                CHECK(error.place == what);
                CHECK(error.index == static_cast<std::int64_t>(at));
                CHECK(error.value == infinite);
                spoilt[at] = good[at];
                CHECK(spoilt == good);
            }
        };
        refuses([&](auto& field) { run.smoother.scatter(field); }, "amount of cell");
        refuses([&](auto& field) { run.smoother.gather(field); }, "value of cell");
    }
    CHECK(refused > 50);
}

TEST_CASE("vfs transfer: fields of float too") {
    smoothed_case run(7);
    seeded random(9);
    const auto amounts = random_field(run.field.size(), random);
    auto exact = amounts;
    run.smoother.scatter(exact);
    std::vector<float> single(amounts.begin(), amounts.end());
    run.smoother.scatter(single);
    // Every step rounds to 2^-24; a cell is met in a handful of them.
    for (std::size_t c = 0; c < exact.size(); ++c) CHECK(std::abs(static_cast<double>(single[c]) - exact[c]) <= 1e-5);
}
