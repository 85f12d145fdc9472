// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/lattice.hpp>
#include <hearth/voidage/deposit.hpp>

#include "support/box_mesh.hpp"
#include "support/complaint.hpp"
#include "support/exact.hpp"
#include "support/packing.hpp"
#include "support/polyhedra.hpp"
#include "support/random.hpp"
#include "support/thread_communicator.hpp"

namespace {

using namespace hearth::test;
using hearth::point;
using hearth_test::seeded;

constexpr double pi = 3.14159265358979323846;

/// Fields and reports of one deposit on any mesh.
template <class Mesh, class Cloud, class Policy = hearth::deposit::ramp>
std::vector<double> deposited(const Mesh& mesh, const Cloud& cloud, const Policy& policy = {}) {
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    std::vector<double> field(static_cast<std::size_t>(graph.cell_count()), -1.0);
    hearth::deposit_solid_fraction(locator, cloud, field, policy);
    return field;
}

/// Spheres anywhere in a unit box.
packing random_spheres(seeded& random, int count, double smallest, double largest) {
    packing bed;
    for (int i = 0; i < count; ++i) {
        bed.positions.push_back({random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)});
        bed.radii.push_back(random.log_uniform(smallest, largest));
    }
    return bed;
}

/// A random mesh of the unit box: graded, with split cells, periodic along some axes.
box_mesh random_mesh(seeded& random) {
    std::array<std::vector<double>, 3> planes;
    std::array<bool, 3> periodic{};
    for (std::size_t a = 0; a < 3; ++a) {
        planes[a] = graded_planes(1, 1 + static_cast<int>(random.index(9)), random.log_uniform(0.5, 2));
        periodic[a] = random.index(2) == 0;
    }
    const auto salt = random.index(5);
    return box_mesh(std::move(planes), periodic,
                    [&](int i, int j, int k) { return (static_cast<std::size_t>(i + 3 * j + 7 * k) + salt) % 5 == 0; });
}

packing one_sphere(point x, double radius) {
    packing bed;
    bed.positions = {x};
    bed.radii = {radius};
    return bed;
}

hearth::lattice unit_lattice(int cells) {
    const double h = 1.0 / cells;
    return {{{cells, cells, cells}, {h, h, h}, {false, false, false}, {0, 0, 0}}};
}

}  // namespace

TEST_CASE_TEMPLATE("deposit: keeps the solid volume on any mesh, for particles of any size", Policy,
                   hearth::deposit::centre, hearth::deposit::divided, hearth::deposit::ramp) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        seeded random(seed);
        const box_mesh mesh = random_mesh(random);
        // From a thousandth of the box to nearly its size (0.62 is the radius of the sphere of its volume).
        const packing bed = random_spheres(random, 20, 1e-3, 0.6);
        const std::vector<double> field = deposited(mesh, bed, Policy{});
        // Every share and every sum rounds once for each particle that a cell has: 20 and a few, relative to the total.
        CHECK(solid_volume(mesh, field) == doctest::Approx(bed.volume()).epsilon(40 * 2.3e-16));
        for (const double fraction : field) CHECK(fraction >= 0);
    }
}

TEST_CASE("deposit: the centre policy fills the cell of the centre only") {
    const hearth::lattice mesh = unit_lattice(4);
    const auto field = deposited(mesh, one_sphere({0.3, 0.6, 0.9}, 0.1), hearth::deposit::centre{});
    const std::size_t cell = 1 + 4 * (2 + 4 * 3);
    for (std::size_t c = 0; c < field.size(); ++c) {
        CHECK(field[c] == (c == cell ? doctest::Approx(4.0 / 3 * pi * 1e-3 * 64).epsilon(1e-15) : doctest::Approx(0)));
    }
}

TEST_CASE("deposit: the 29 points have the centre and nearly the inertia of the sphere, and are told apart by cells") {
    const hearth::visitor sphere{0, {1, 2, 3}, 2.0};
    point sum{}, squares{};
    int count = 0;
    hearth::deposit::divided::for_each_point(sphere, [&](const point& x) {
        ++count;
        for (std::size_t a = 0; a < 3; ++a) {
            sum[a] += x[a] - sphere.position[a];
            squares[a] += (x[a] - sphere.position[a]) * (x[a] - sphere.position[a]);
        }
    });
    CHECK(count == 29);
    for (std::size_t a = 0; a < 3; ++a) {
        CHECK(std::abs(sum[a]) < 29 * 2.3e-16 * 5);
        // R^2 / 5 for the sphere; points at mean radii have a little less: the core and the variance within each shell,
        // which is at most (b - a)^2 / 12 / 3 = 0.003 R^2 for the inner one.
        CHECK(squares[a] / 29 / 4 < 0.2);
        CHECK(squares[a] / 29 / 4 > 0.19);
    }
    // A sphere centred on the corner of eight cells: 14 of the points are on planes of faces, 1 on the corner; the 14
    // others are 8 corner directions (2 shells less the 2 * 6 on axes and the centre): two to each cell at least.
    const auto field = deposited(unit_lattice(2), one_sphere({0.5, 0.5, 0.5}, 0.2), hearth::deposit::divided{});
    for (const double fraction : field) CHECK(fraction >= 2.0 / 29 * 4.0 / 3 * pi * 0.008 * 8 * (1 - 1e-14));
}

TEST_CASE("deposit: the ramp is defined and continuous at every ratio of particle to cell") {
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        CAPTURE(seed);
        seeded random(seed);
        const box_mesh mesh = random_mesh(random);
        packing bed = random_spheres(random, 1, 1e-6, 0.5);
        // Often on a face, an edge or a corner, where tiny particles could fall between the cells.
        const auto& corner = mesh.centres[random.index(mesh.centres.size())];
        const auto& extent = mesh.extents[static_cast<std::size_t>(mesh.find(corner))];
        for (std::size_t a = 0; a < 3; ++a) {
            if (random.index(3) != 0) bed.positions[0][a] = corner[a] + 0.5 * extent[a] * (1 - 1e-9);
        }
        CAPTURE(bed.radii[0]);
        CAPTURE(bed.positions[0][0]);
        CAPTURE(bed.positions[0][1]);
        CAPTURE(bed.positions[0][2]);
        const auto before = deposited(mesh, bed);
        double smallest = 1;
        for (const point& h : mesh.extents) smallest = std::min({smallest, h[0], h[1], h[2]});
        const double step = 1e-6 * smallest;
        for (std::size_t a = 0; a < 3; ++a) {
            bed.positions[0][a] += (bed.positions[0][a] > 0.5 ? -1 : 1) * step / std::sqrt(3.0);
        }
        const auto after = deposited(mesh, bed);
        double change = 0;
        for (std::size_t c = 0; c < before.size(); ++c) {
            change += std::abs(after[c] - before[c]) * mesh.volume(static_cast<int>(c));
        }
        // The degree of a cell changes by 3e-6 at most, the sum of all by as much for each cell, and the fullest cell
        // has 1/2 at least.  A particle of up to a cell's size shares itself between 8 cells mostly, 27 at most: 1e-4.
        CHECK(change <= 1e-4 * bed.volume());
    }
}

TEST_CASE("deposit: the ramp is exact, defined and continuous on polyhedra and tetrahedra, whose boxes overlap") {
    using cells = polyhedral_mesh::cells;
    for (const cells kind : {cells::polyhedra, cells::tetrahedra}) {
        CAPTURE(kind == cells::tetrahedra);
        const polyhedral_mesh mesh(kind, 1, 4);
        for (std::uint64_t seed = 1; seed <= 300; ++seed) {
            CAPTURE(seed);
            seeded random(seed);
            packing bed = random_spheres(random, 1, 1e-6, 0.5);
            // Often where cells meet: on the line between two centres, or at the corner of a part of a cell.
            const auto cell = random.index(mesh.centres.size());
            const auto& face = mesh.faces[random.index(mesh.faces.size())];
            const point &a = mesh.centres[static_cast<std::size_t>(face.a)],
                        &b = mesh.centres[static_cast<std::size_t>(face.b)];
            const double way = random.uniform(0, 1);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (seed % 3 == 1) bed.positions[0][axis] = a[axis] + way * (b[axis] - a[axis]);
                // Away from its centre as far as its box goes: mostly in another cell.
                if (seed % 3 == 2) {
                    const double corner =
                        mesh.centres[cell][axis] + random.uniform(-0.5, 0.5) * mesh.extents[cell][axis];
                    bed.positions[0][axis] = std::clamp(corner, 1e-3, 1 - 1e-3);
                }
            }
            CAPTURE(bed.radii[0]);
            const auto before = deposited(mesh, bed);
            CHECK(solid_volume(mesh, before) == doctest::Approx(bed.volume()).epsilon(40 * 2.3e-16));
            for (const double fraction : before) CHECK(fraction >= 0);
            const double step = 1e-6 * 0.1;  // extents are 0.1 to 0.4
            for (std::size_t axis = 0; axis < 3; ++axis) {
                bed.positions[0][axis] += (bed.positions[0][axis] > 0.5 ? -1 : 1) * step / std::sqrt(3.0);
            }
            const auto after = deposited(mesh, bed);
            double change = 0;
            for (std::size_t c = 0; c < before.size(); ++c) change += std::abs(after[c] - before[c]) * mesh.volumes[c];
            // As on boxes, for the same reason: 1e-4.  (The worst of these is 2e-5.)
            CHECK(change <= 1e-4 * bed.volume());
        }
    }
}

TEST_CASE("deposit: a tiny particle belongs to its cell in the middle, and to both cells alike on a face") {
    const double volume = 4.0 / 3 * pi * 1e-15;
    const std::size_t cell = 1 + 4 * (1 + 4 * 1);
    const auto field = [&](double x) { return deposited(unit_lattice(4), one_sphere({x, 0.375, 0.375}, 1e-5)); };
    CHECK(field(0.375)[cell] == doctest::Approx(64 * volume).epsilon(1e-14));
    // A twentieth of a cell before the face, the ramp being 0.375 cells wide.  Weights are floats.
    CHECK(field(0.4875)[cell] == doctest::Approx(64 * volume * (0.5 + 0.05 / 0.375)).epsilon(1e-6));
    CHECK(field(0.4875)[cell + 1] == doctest::Approx(64 * volume * (0.5 - 0.05 / 0.375)).epsilon(1e-6));
    CHECK(field(0.5)[cell] == doctest::Approx(32 * volume).epsilon(1e-6));
    CHECK(field(0.5)[cell + 1] == doctest::Approx(32 * volume).epsilon(1e-6));

    // On the face to a cell of four times the length half each, too; in the middle of the small one, an eighth of the
    // large one from the face, 1 to 1/2 - 0.125 / 0.375.
    const box_mesh unequal({{{0, 1, 5}, {0, 4}, {0, 4}}}, {false, false, false});
    const auto share = [&](double x) { return deposited(unequal, one_sphere({x, 2, 2}, 1e-5))[0] * 16 / volume; };
    CHECK(share(1.0) == doctest::Approx(0.5).epsilon(1e-6));
    CHECK(share(0.5) == doctest::Approx(6.0 / 7).epsilon(1e-6));
    CHECK(share(3.0) == doctest::Approx(0.0));
}

TEST_CASE("deposit: the ramp tends to the exact overlap of sphere and cell as cells become small") {
    seeded random(5);
    double coarser = 1;
    for (const int cells : {8, 16, 32}) {
        CAPTURE(cells);
        const hearth::lattice mesh = unit_lattice(cells);
        double difference = 0, volume = 0;
        for (int i = 0; i < 10; ++i) {
            const packing bed =
                one_sphere({random.uniform(0.4, 0.6), random.uniform(0.4, 0.6), random.uniform(0.4, 0.6)}, 0.25);
            const auto field = deposited(mesh, bed);
            for (int c = 0; c < static_cast<int>(field.size()); ++c) {
                point low = hearth::mesh_traits<hearth::lattice>::centre(mesh, c), high = low;
                for (std::size_t a = 0; a < 3; ++a) {
                    low[a] -= bed.positions[0][a] + 0.5 * mesh.spacing[a];
                    high[a] -= bed.positions[0][a] - 0.5 * mesh.spacing[a];
                }
                const double cell = hearth::mesh_traits<hearth::lattice>::volume(mesh, c);
                difference += std::abs(field[static_cast<std::size_t>(c)] * cell - sphere_box_overlap(0.25, low, high));
            }
            volume += bed.volume();
        }
        // Only cells that the surface cuts differ, a layer of 1.5 h (mean width of a cube) around it or 4.5 h/R of the
        // volume.  A ramp of 1.25 h instead of the projection of a cube of mean width 1.5 h about its own chord, both
        // from 0 to 1 about the same middle, differs by less than 0.09 on average.
        CHECK(difference / volume < 0.09 * 4.5 * (1.0 / cells / 0.25));
        CHECK(difference < 0.65 * coarser * volume);  // first order: a half, plus chance
        coarser = difference / volume;
    }
}

TEST_CASE("deposit: what hangs over a wall goes to the cells inside, over a periodic side to the other end") {
    hearth::lattice mesh = unit_lattice(8);
    const packing bed = one_sphere({1e-3, 0.5, 0.5}, 0.25);
    CHECK(solid_volume(mesh, deposited(mesh, bed)) == doctest::Approx(bed.volume()).epsilon(1e-15));
    mesh.periodic = {true, true, true};
    const auto field = deposited(mesh, bed);
    CHECK(solid_volume(mesh, field) == doctest::Approx(bed.volume()).epsilon(1e-15));
    CHECK(field[7 + 8 * (4 + 8 * 4)] > 0.9);
    // Moved by whole cells (a multiple of 1/8 is exact in binary), the field moves with it to the last bit.
    packing moved = bed;
    moved.positions[0] = {bed.positions[0][0] + 0.875, 0.5 + 0.375, 0.5 - 0.5};
    const auto there = deposited(mesh, moved);
    for (std::size_t k = 0; k < 8; ++k) {
        for (std::size_t j = 0; j < 8; ++j) {
            for (std::size_t i = 0; i < 8; ++i) {
                const std::size_t from = i + 8 * (j + 8 * k), to = (i + 7) % 8 + 8 * ((j + 3) % 8 + 8 * ((k + 4) % 8));
                // 1e-3 + 0.875 rounds: half an ulp of 1 against a slope of 8/1.25 per cell.
                CHECK(there[to] == doctest::Approx(field[from]).epsilon(1e-6).scale(1));
            }
        }
    }
    // A sphere as wide as the box touches itself through the sides.
    const packing large = one_sphere({0.1, 0.2, 0.3}, 0.55);
    CHECK(solid_volume(mesh, deposited(mesh, large)) == doctest::Approx(large.volume()).epsilon(1e-15));
}

TEST_CASE("deposit: a mirror-symmetric bed gives a mirror-symmetric field") {
    const hearth::lattice mesh = unit_lattice(8);
    packing bed;
    seeded random(3);
    for (int i = 0; i < 6; ++i) {
        const point x{random.uniform(0.1, 0.4), random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)};
        const double r = random.uniform(0.02, 0.2);
        for (const double side : {x[0], 1 - x[0]}) {
            bed.positions.push_back({side, x[1], x[2]});
            bed.radii.push_back(r);
        }
    }
    const auto field = deposited(mesh, bed);
    for (std::size_t row = 0; row < 64; ++row) {
        for (std::size_t i = 0; i < 4; ++i)
            CHECK(field[8 * row + i] == doctest::Approx(field[8 * row + 7 - i]).epsilon(1e-13).scale(1));
    }
}

TEST_CASE("deposit: the same bits for any storage order and any number of ranks") {
    for (const bool periodic : {false, true}) {
        const auto planes = [](int n, double ratio) { return graded_planes(6, n, ratio); };
        const box_mesh mesh({planes(9, 1.1), planes(7, 1.0), planes(8, 0.8)}, {periodic, false, periodic},
                            [](int i, int j, int k) { return (i + j + k) % 4 == 0; });
        packing bed = make_packing({0.4, {6, 6, 6}, 0.5, {periodic, false, periodic}, 11});
        const auto expected = deposited(mesh, bed);
        for (const int ranks : {1, 2, 3, 4, 5, 8}) {
            CAPTURE(ranks);
            const std::vector<int> owners = random_owners(mesh.size(), ranks, static_cast<std::uint64_t>(ranks));
            std::vector<double> result(expected.size(), -1.0);
            on_ranks(ranks, [&](thread_communicator communicator) {
                const int rank = communicator.rank();
                const box_share share(mesh, owners, rank, 100);
                const packing_share cloud(bed, rank, ranks, 200);
                const hearth::cell_graph graph(share, communicator);
                const hearth::cell_locator locator(share, graph);
                std::vector<double> field(share.cells.size());
                const auto report = hearth::deposit_solid_fraction(locator, cloud, field);
                for (std::size_t c = 0; c < field.size(); ++c) {
                    result[static_cast<std::size_t>(share.cells[c])] = field[c];
                }
                if (report.particles != static_cast<std::int64_t>(bed.radii.size())) throw std::logic_error("count");
            });
            CHECK(std::memcmp(result.data(), expected.data(), result.size() * sizeof(double)) == 0);
        }
    }
}

TEST_CASE("deposit: a lattice is searched without bins, with the same bits") {
    hearth::lattice mesh{{{9, 8, 5}, {0.7, 0.8, 1.3}, {true, false, true}, {0, 0, 0}}};
    std::array<std::vector<double>, 3> planes;
    for (std::size_t a = 0; a < 3; ++a) {
        for (int i = 0; i <= mesh.cells[a]; ++i) planes[a].push_back(i * mesh.spacing[a]);
    }
    box_mesh boxes(planes, mesh.periodic);
    for (int c = 0; c < boxes.size(); ++c) {
        boxes.centres[static_cast<std::size_t>(c)] = hearth::mesh_traits<hearth::lattice>::centre(mesh, c);
        boxes.extents[static_cast<std::size_t>(c)] = mesh.spacing;
    }
    const packing bed = make_packing({0.5, {6.3, 6.4, 6.5}, 0.3, mesh.periodic, 4});
    const auto a = deposited(mesh, bed), b = deposited(boxes, bed);
    CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST_CASE("deposit: a mesh of tiny and huge cells is searched in a few visits") {
    // Cells from 1 to 100 in length: volumes over six decades.
    const box_mesh mesh({graded_planes(1, 30, 1.17), graded_planes(1, 30, 1.17), graded_planes(1, 30, 1.17)},
                        {false, false, false});
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    seeded random(9);
    std::int64_t visits = 0;
    for (int i = 0; i < 1000; ++i) {
        const point x{random.log_uniform(1e-3, 1), random.log_uniform(1e-3, 1), random.log_uniform(1e-3, 1)};
        locator.for_each_near(x, 1e-3, 1, [&](int, const point&, const point&) { ++visits; });
    }
    // A plain grid of bins of the largest cell would visit all 27000 of them, as that cell is 0.15 long.
    CHECK(visits / 1000 < 27000 / 20);
}

TEST_CASE("deposit: fields of float and no particles at all are fine") {
    const hearth::lattice mesh = unit_lattice(3);
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    std::vector<float> field(27, 5.0F);
    const auto report = hearth::deposit_solid_fraction(locator, packing{}, field);
    CHECK(report.particles == 0);
    CHECK(report.solid_volume == 0);
    for (const float fraction : field) CHECK(fraction == 0.0F);
    // One cell takes everything.
    const hearth::lattice single = unit_lattice(1);
    for (const double x : {0.0, 0.01, 0.5, 0.999}) {
        const auto all = deposited(single, one_sphere({x, 0.5, 0.5}, 0.3));
        CHECK(all[0] == doctest::Approx(4.0 / 3 * pi * 0.027).epsilon(1e-15));
    }
}

TEST_CASE("deposit: bad particles are refused by id and value, and the field stays") {
    const hearth::lattice mesh = unit_lattice(4);
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    std::vector<double> field(64, 0.25);
    const auto refused = [&](const packing& bed) {
        const std::string text = complaint([&] { hearth::deposit_solid_fraction(locator, bed, field); });
        for (const double fraction : field) CHECK(fraction == 0.25);
        return text;
    };
    packing bed = one_sphere({0.5, 0.5, 0.5}, 0.1);
    bed.positions.push_back({0.2, 0.2, 0.2});
    bed.radii.push_back(0.1);

    const auto with = [&](point x, double radius) {
        packing spoilt = bed;
        spoilt.positions[1] = x;
        spoilt.radii[1] = radius;
        return refused(spoilt);
    };
    CHECK(says(with({nan, 0.5, 0.5}, 0.1), "position of particle 1 is nan"));
    CHECK(says(with({0.5, infinity, 0.5}, 0.1), "position of particle 1 is inf"));
    CHECK(says(with({0.5, 0.5, 0.5}, 0.0), "radius of particle 1 is 0, allowed: finite and > 0 [m]"));
    CHECK(says(with({0.5, 0.5, 0.5}, -0.1), "radius of particle 1 is -0.1"));
    CHECK(says(with({0.5, 0.5, 0.5}, nan), "radius of particle 1 is nan"));
    CHECK(says(with({0.5, 0.5, 0.5}, 0.7), "radius of particle 1 is 0.69999999999999996, allowed: at most"));
    CHECK(says(with({1.25, 0.5, 0.5}, 0.1), "x coordinate of particle 1 is 1.25, allowed: inside the mesh"));
    CHECK(says(with({0.5, 0.5, -0.01}, 0.1), "centre (0.5, 0.5, -0.01) is in no cell"));
}

TEST_CASE("deposit: bad particles and bad meshes are refused on every rank") {
    const box_mesh mesh({graded_planes(1, 4, 1), graded_planes(1, 4, 1), graded_planes(1, 4, 1)},
                        {false, false, false});
    seeded random(1);
    const packing bed = random_spheres(random, 12, 0.05, 0.2);
    enum spoil { outside, not_a_number, twice, bad_extent };
    for (const spoil what : {outside, not_a_number, twice, bad_extent}) {
        packing spoilt = bed;
        box_mesh spoilt_mesh = mesh;
        if (what == outside) spoilt.positions[7] = {0.5, -0.5, 0.5};
        if (what == not_a_number) spoilt.radii[7] = std::numeric_limits<double>::quiet_NaN();
        if (what == bad_extent) spoilt_mesh.extents[21] = {0.25, -1, 0.25};
        const int ranks = 3;
        const std::vector<int> owners = random_owners(mesh.size(), ranks, 5);
        std::vector<std::string> texts(ranks);
        on_ranks(ranks, [&](thread_communicator communicator) {
            const auto rank = static_cast<std::size_t>(communicator.rank());
            const box_share good(mesh, owners, communicator.rank(), 1);
            const hearth::cell_graph graph(good, communicator);
            const box_share share(spoilt_mesh, owners, communicator.rank(), 1);
            packing_share cloud(spoilt, communicator.rank(), ranks, 2);
            if (what == twice && communicator.rank() == 1) cloud.ids.push_back(5);
            texts[rank] = complaint([&] {
                const hearth::cell_locator locator(share, graph);
                std::vector<double> field(share.cells.size());
                hearth::deposit_solid_fraction(locator, cloud, field);
            });
        });
        CAPTURE(texts[0]);
        CHECK(says(texts[0], what == outside        ? "x coordinate of particle 7 is 0.5"
                             : what == not_a_number ? "radius of particle 7 is nan"
                             : what == twice        ? "global index of particle 5 is 5, allowed: unique"
                                                    : "extent of cell 21 is -1"));
        CHECK(texts[1] == texts[0]);
        CHECK(texts[2] == texts[0]);
    }
}
