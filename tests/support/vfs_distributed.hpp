// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <hearth/voidage/vfs.hpp>

#include "support/meshes.hpp"
#include "support/vfs_cases.hpp"

/// Checks of the distributed Volume Fraction Smoother that hold for any communicator.  Every rank calls them; each makes
/// the serial run for itself and compares its own cells.  They return what is wrong, or nothing, after all ranks have
/// made all calls: doctest's checks are for the thread that runs the test, and a rank that stops early leaves the others
/// waiting.
namespace hearth::test {

struct findings {
    std::string text;
    void require(bool holds, const char* otherwise) {
        if (!holds) text += std::string(otherwise) + "; ";
    }
};

template <class Communicator>
std::string compare_with_serial(const vfs_case& example, std::uint64_t seed, const Communicator& communicator) {
    const std::size_t cells = example.solid_fraction.size();
    const std::vector<int> owners = random_owners(cells, communicator.size(), seed);
    const partitioned_mesh<listed_graph> part(example.graph, owners, communicator.rank(), seed + 1);
    seeded random(seed);
    std::vector<double> amounts(cells), values(cells);
    for (double& a : amounts) a = random.uniform(-1, 1);
    for (double& v : values) v = random.uniform(-1, 1);

    findings found;
    for (const vfs_variant variant : {vfs_variant::completed, vfs_variant::paper}) {
        const cell_graph<> whole(example.graph);
        volume_fraction_smoother<cell_graph<>> serial(whole, {example.threshold, variant});
        auto field = example.solid_fraction, scattered = amounts, gathered = values;
        const vfs_report report = serial.smooth(field);
        serial.scatter(scattered);
        serial.gather(gathered);

        const cell_graph<Communicator> graph(part, communicator);
        volume_fraction_smoother<cell_graph<Communicator>> smoother(graph, {example.threshold, variant});
        auto mine = part.take(example.solid_fraction), my_amounts = part.take(amounts), my_values = part.take(values);
        const vfs_report same = smoother.smooth(mine);
        smoother.scatter(my_amounts);
        smoother.gather(my_values);
        found.require(mine == part.take(field), "the field differs");
        found.require(my_amounts == part.take(scattered), "scattered amounts differ");
        found.require(my_values == part.take(gathered), "gathered values differ");
        found.require(same.sweeps == report.sweeps && same.rings == report.rings, "sweeps or rings differ");
        found.require(same.maximum == report.maximum && same.stranded_volume == report.stranded_volume,
                      "maximum or stranded volume differs");
        // Ranks share the work and repeat none of it.
        found.require(same.touched_cells == report.touched_cells && same.smoothed_cells == report.smoothed_cells &&
                          same.stuck_cells == report.stuck_cells && same.visited_cells == report.visited_cells,
                      "the counts differ");

        // Again with the cells that a host touched, on the same object.
        std::vector<std::int32_t> touched;
        mine = part.take(example.solid_fraction);
        for (std::int32_t c = 0; c < graph.cell_count(); ++c) {
            if (mine[static_cast<std::size_t>(c)] > example.threshold) touched.push_back(c);
        }
        (void)smoother.smooth(mine, touched);
        found.require(mine == part.take(field), "the field differs when only touched cells are named");
    }
    return found.text;
}

/// One bad value, or one component that is too full, on one rank: all throw the same, and no field changes.
template <class Communicator>
std::string compare_errors(const vfs_case& example, std::uint64_t seed, const Communicator& communicator) {
    const std::size_t cells = example.solid_fraction.size();
    const std::vector<int> owners = random_owners(cells, communicator.size(), seed);
    const partitioned_mesh<listed_graph> part(example.graph, owners, communicator.rank(), seed + 1);
    const cell_graph<Communicator> graph(part, communicator);
    volume_fraction_smoother<cell_graph<Communicator>> smoother(graph, {example.threshold});
    seeded random(seed);
    const std::size_t at = random.index(cells);
    findings found;

    auto spoilt = example.solid_fraction;
    spoilt[at] = random.uniform(0, 1) < 0.5 ? -1.0 : std::nan("");
    auto mine = part.take(spoilt);
    const auto before = mine;
    std::int64_t named = -1;
    try {
        (void)smoother.smooth(mine);
    } catch (const bad_value& error) {
        named = error.index;
    }
    found.require(named == static_cast<std::int64_t>(at), "a bad value was not refused by its index");
    for (std::size_t c = 0; c < mine.size(); ++c) {
        found.require(mine[c] == before[c] || (std::isnan(mine[c]) && std::isnan(before[c])), "a refused field was changed");
    }

    spoilt = example.solid_fraction;
    spoilt[at] += 2 * example.graph.volume() / example.graph.volumes[at];
    mine = part.take(spoilt);
    const auto refusal = [](auto&& run) {
        try {
            run();
        } catch (const infeasible_volume& error) {
            return std::tuple(error.component, error.capacity, error.excess);
        }
        return std::tuple(std::int64_t{-1}, 0.0, 0.0);
    };
    auto whole = spoilt;
    const auto serial = refusal([&] { (void)smooth_volume_fraction(example.graph, whole, {example.threshold}); });
    const auto same = refusal([&] { (void)smoother.smooth(mine); });
    found.require(std::get<0>(serial) >= 0, "the serial run accepted too much");
    found.require(same == serial, "too much was not refused as by the serial run");
    found.require(mine == part.take(spoilt), "a field that cannot be placed was changed");

    double refused = 0;
    try {
        volume_fraction_smoother<cell_graph<Communicator>>(graph, {communicator.rank() == 0 ? 2.0 : 0.5});
    } catch (const bad_value& error) {
        refused = error.value;
    }
    found.require(refused == 2.0, "a bad threshold of one rank was not refused by all");
    return found.text;
}

/// A heap in one corner of a long lattice cut into slabs: what a rank does and holds beyond its cells.
template <class Communicator>
std::string compare_work(const Communicator& communicator) {
    const int ranks = communicator.size();
    const lattice mesh{{{8, 8, 20 * ranks}}};
    std::vector<int> owners(static_cast<std::size_t>(mesh.count()));
    for (std::size_t c = 0; c < owners.size(); ++c) owners[c] = static_cast<int>(c / 1280);
    const partitioned_mesh<lattice> part(mesh, owners, communicator.rank());
    const cell_graph<Communicator> graph(part, communicator);
    volume_fraction_smoother<cell_graph<Communicator>> smoother(graph, {0.9});
    const auto cells = static_cast<std::size_t>(graph.total_count());
    const std::size_t before = smoother.memory();
    std::vector<double> field(owners.size(), 0.0);
    for (std::size_t c = 0; c < 64 * 6; ++c) field[c] = 1.5;
    auto mine = part.take(field);
    const vfs_report report = smoother.smooth(mine);
    findings found;
    // 16 bytes of content, 16 of shares with ghosts, 8 of order, and the rows of the ghosts.
    found.require(before <= 48 * cells, "more than 48 bytes a cell before the first call");
    found.require(report.stuck_cells > 0, "nothing was stuck");
    found.require(report.visited_cells <= 64 * 24, "the completion visited more than the neighbourhood of the heap");
    // The heap is in the first slab: ranks beyond the second cannot have heard of it.  The completion keeps 12 bytes for
    // each cell that it might visit.
    if (communicator.rank() > 1) {
        found.require(smoother.memory() <= before + 12 * cells + 1000, "a rank far from the heap holds more");
        found.require(smoother.log_memory() <= 200, "a rank far from the heap logs something");
    }
    found.require(smoother.log_memory() <= 20 * cells, "more than 20 bytes of log a cell");
    return found.text;
}

}  // namespace hearth::test
