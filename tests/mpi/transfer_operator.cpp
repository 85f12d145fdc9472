// SPDX-License-Identifier: MIT
#include <cstdint>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/mpi/communicator.hpp>
#include <hearth/voidage/transfer_operator.hpp>

#include "support/box_mesh.hpp"
#include "support/packing.hpp"
#include "support/random.hpp"

namespace {

using namespace hearth::test;
using hearth_test::seeded;

const std::array<bool, 3> sides{true, false, true};

box_mesh make_mesh() {
    return box_mesh({graded_planes(5, 9, 1.1), graded_planes(5, 8, 0.9), graded_planes(5, 7, 1)}, sides,
                    [](int i, int j, int k) { return (i + 2 * j + k) % 5 == 0; });
}

}  // namespace

TEST_CASE("transfer operator: solid fraction, scattered sources and gathered gas are the bits of one rank") {
    const box_mesh mesh = make_mesh();
    const packing bed = make_packing({0.45, {5, 5, 5}, 0.4, sides, 7});
    const hearth::filtered_fraction_settings settings{std::nullopt, bed.solid_fraction() + 0.03, 1e-5};
    seeded random(8);
    std::vector<double> sources, gas;
    for (std::size_t i = 0; i < bed.radii.size(); ++i) sources.push_back(random.uniform(-1, 1));
    for (std::size_t c = 0; c < mesh.centres.size(); ++c) gas.push_back(random.uniform(300, 2000));

    const hearth::cell_graph serial(mesh);
    const hearth::cell_locator everywhere(mesh, serial);
    hearth::transfer_operator<box_mesh> whole(everywhere, settings);
    std::vector<double> fraction(gas.size()), received(gas.size()), seen(sources.size());
    const auto expected = whole.distribute(bed, fraction);
    REQUIRE(expected.cap.smoothed_cells > 0);
    whole.scatter(sources, received);
    whole.gather(gas, seen);

    const hearth::mpi::communicator communicator;
    const int rank = communicator.rank(), ranks = communicator.size();
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        const box_share share(mesh, random_owners(mesh.size(), ranks, seed), rank, seed + 10);
        const packing_share cloud(bed, rank, ranks, seed + 20);
        const hearth::cell_graph graph(share, communicator);
        const hearth::cell_locator locator(share, graph);
        hearth::transfer_operator<box_share, hearth::mpi::communicator> transfer(locator, settings);
        std::vector<double> field(share.cells.size()), here(share.cells.size()), gas_here, sources_here;
        std::vector<double> seen_here(cloud.ids.size());
        const auto report = transfer.distribute(cloud, field);
        CHECK(report.width == expected.width);
        CHECK(report.maximum == expected.maximum);
        CHECK(report.solid_volume == expected.solid_volume);
        CHECK(report.capped_volume == expected.capped_volume);
        for (const std::int64_t id : cloud.ids) sources_here.push_back(sources[static_cast<std::size_t>(id)]);
        for (const int c : share.cells) gas_here.push_back(gas[static_cast<std::size_t>(c)]);
        transfer.scatter(sources_here, here);
        transfer.gather(gas_here, seen_here);
        for (std::size_t c = 0; c < field.size(); ++c) {
            const auto g = static_cast<std::size_t>(share.cells[c]);
            CHECK(field[c] == fraction[g]);
            CHECK(here[c] == received[g]);
        }
        for (std::size_t i = 0; i < seen_here.size(); ++i)
            CHECK(seen_here[i] == seen[static_cast<std::size_t>(cloud.ids[i])]);
    }
}

TEST_CASE("transfer operator: a particle outside the mesh is refused on every rank, without a hang") {
    const box_mesh mesh = make_mesh();
    packing bed = make_packing({0.3, {5, 5, 5}, 0, sides, 9});
    bed.positions[4][1] = 5.5;
    const hearth::mpi::communicator communicator;
    const box_share share(mesh, random_owners(mesh.size(), communicator.size(), 1), communicator.rank(), 2);
    const packing_share cloud(bed, communicator.rank(), communicator.size(), 3);
    const hearth::cell_graph graph(share, communicator);
    const hearth::cell_locator locator(share, graph);
    hearth::transfer_operator<box_share, hearth::mpi::communicator> transfer(locator);
    std::vector<double> field(share.cells.size(), 0.25);
    std::int64_t refused = -1;
    try {
        transfer.distribute(cloud, field);
    } catch (const hearth::bad_value& error) {
        refused = error.index;
    }
    CHECK(refused == 4);
    for (const double fraction : field) CHECK(fraction == 0.25);
}

TEST_CASE("transfer operator: a rank holds and visits no more than its cells and particles near them ask for") {
    // Slabs of 16 cells and 8 diameters: a rank that knew all would hold `ranks` times as much as one that is alone.
    const hearth::mpi::communicator communicator;
    const int ranks = communicator.size();
    const box_mesh mesh({graded_planes(8.0 * ranks, 16 * ranks, 1), graded_planes(4, 8, 1), graded_planes(4, 8, 1)},
                        {false, false, false});
    const packing bed = make_packing({0.4, {8.0 * ranks, 4, 4}, 0, {false, false, false}, 5});
    std::vector<int> owners;
    for (int c = 0; c < mesh.size(); ++c) owners.push_back((c % (16 * ranks)) / 16);
    const box_share share(mesh, owners, communicator.rank(), 1);
    const packing_share cloud(bed, communicator.rank(), ranks, 2);
    const hearth::cell_graph graph(share, communicator);
    const hearth::cell_locator locator(share, graph);
    const auto cells = static_cast<std::size_t>(graph.cell_count());
    CHECK(cells == 16 * 64);
    CHECK(static_cast<std::size_t>(graph.total_count()) <= cells + 2 * 64);  // a layer of ghosts on two sides

    const hearth::visitors<hearth::mpi::communicator> here(locator, cloud);
    // Within 8 + 2 * (radius 0.5 + two extents of 0.5) of 8 * ranks, and a few more by chance of the packing.
    const double share_of_bed = std::min(1.0, (8 + 2 * 1.5) / (8.0 * ranks));
    CHECK(static_cast<double>(here.size()) <= 1.1 * share_of_bed * static_cast<double>(bed.radii.size()) + 5);
    const hearth::footprints<hearth::mpi::communicator> footprints(locator, cloud, hearth::deposit::ramp{});
    // At d/dx 2 a particle touches the cells within 0.5 + 0.625 * 0.5 of it: 70 on average, 100 at most.
    CHECK(footprints.entry_count() <= 100 * here.size());

    // Cells that a deposit looks at, in whole bins of half a diameter: those within 0.5 + 1 * 0.5, and what is left of
    // a bin on either side, 6^3, when it looks for the nearest; no more when it gives the shares.
    std::size_t visits = 0;
    const auto look = [&](std::int32_t, const hearth::point&, const hearth::point&) { ++visits; };
    for (const hearth::visitor& v : here) locator.for_each_near(v.position, v.radius, 1, look);
    CHECK(visits <= 216 * here.size());

    // Bytes: 60 a cell and a rank to find cells, 16 a cell for the smoother, 48 for the cap and 20 for its log, 8 for a
    // work vector; 8 an entry and 8 * 16 a particle here or visiting, and twice that while vectors grow.
    CHECK(locator.memory() <= 80 * cells + 64 * static_cast<std::size_t>(ranks) + 1000);
    hearth::transfer_operator<box_share, hearth::mpi::communicator> transfer(locator);
    std::vector<double> field(cells);
    transfer.distribute(cloud, field);
    const std::size_t particles = here.size() + here.owned_count();
    CHECK(transfer.memory() <= 100 * static_cast<std::size_t>(graph.total_count()) +
                                   2 * (8 * footprints.entry_count() + 128 * particles) + 1000);
}
