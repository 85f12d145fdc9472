// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <hearth/core/cell_graph.hpp>
#include <hearth/core/csr_graph.hpp>
#include <hearth/core/face_mesh.hpp>

#include "support/thread_communicator.hpp"

namespace {

/// A host's mesh as plain lists, so that a test can spoil any of them.
struct listed_mesh {
    struct face { int a, b; double conductance; };
    struct remote { int cell, rank; std::int64_t there; double conductance; };
    std::vector<double> volumes;
    std::vector<std::int64_t> ids;
    std::vector<face> faces;
    std::vector<remote> remotes;
    std::uint64_t revision = 0;
};

}  // namespace

template <>
struct hearth::mesh_traits<listed_mesh> {
    using index = int;
    using scalar = double;
    static index cell_count(const listed_mesh& m) { return static_cast<int>(m.volumes.size()); }
    static scalar volume(const listed_mesh& m, index c) { return m.volumes[static_cast<std::size_t>(c)]; }
    static std::int64_t global_index(const listed_mesh& m, index c) { return m.ids[static_cast<std::size_t>(c)]; }
    static std::uint64_t revision(const listed_mesh& m) { return m.revision; }
    template <class Visit>
    static void for_each_face(const listed_mesh& m, Visit&& visit) {
        for (const auto& f : m.faces) visit(f.a, f.b, 1.0, f.conductance);
    }
    template <class Visit>
    static void for_each_remote_face(const listed_mesh& m, Visit&& visit) {
        for (const auto& f : m.remotes) visit(f.cell, f.rank, f.there, 1.0, f.conductance);
    }
};

namespace {

/// A random graph with random ids, and the same spread over ranks.
struct global_mesh {
    std::vector<double> volumes;
    std::vector<listed_mesh::face> faces;
    std::vector<int> owners;

    global_mesh(std::uint64_t seed, int cells, int links, int ranks) {
        std::mt19937_64 random(seed);
        const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
        for (int c = 0; c < cells; ++c) {
            volumes.push_back(1.0 + below(1000));
            owners.push_back(below(ranks));
        }
        for (int k = 0; k < links; ++k) faces.push_back({below(cells), below(cells), 1.0 + below(64)});
    }

    std::int64_t id(int cell) const { return 7 * std::int64_t{cell} + 3; }

    listed_mesh part(int rank, std::uint64_t storage_seed) const {
        std::vector<int> cells;
        for (int c = 0; c < static_cast<int>(volumes.size()); ++c) {
            if (owners[static_cast<std::size_t>(c)] == rank) cells.push_back(c);
        }
        std::mt19937_64 random(storage_seed);
        std::shuffle(cells.begin(), cells.end(), random);
        std::vector<int> local(volumes.size(), -1);
        listed_mesh mesh;
        for (const int c : cells) {
            local[static_cast<std::size_t>(c)] = static_cast<int>(mesh.volumes.size());
            mesh.volumes.push_back(volumes[static_cast<std::size_t>(c)]);
            mesh.ids.push_back(id(c));
        }
        for (const auto& f : faces) {
            const int a = owners[static_cast<std::size_t>(f.a)], b = owners[static_cast<std::size_t>(f.b)];
            const int la = local[static_cast<std::size_t>(f.a)], lb = local[static_cast<std::size_t>(f.b)];
            if (a == rank && b == rank) mesh.faces.push_back({la, lb, f.conductance});
            if (a == rank && b != rank) mesh.remotes.push_back({la, b, id(f.b), f.conductance});
            if (b == rank && a != rank) mesh.remotes.push_back({lb, a, id(f.a), f.conductance});
        }
        std::shuffle(mesh.faces.begin(), mesh.faces.end(), random);
        std::shuffle(mesh.remotes.begin(), mesh.remotes.end(), random);
        return mesh;
    }
};

/// Rows by global index: what must not depend on storage or ranks.
using rows = std::vector<std::vector<std::pair<std::int64_t, float>>>;

template <class Graph>
void read_rows(const Graph& graph, rows& result) {
    for (int c = 0; c < graph.cell_count(); ++c) {
        auto& row = result[static_cast<std::size_t>(graph.global_index(c) / 7)];
        for (auto k = graph.row_begin(c); k < graph.row_end(c); ++k) {
            row.emplace_back(graph.global_index(graph.neighbours()[k]), graph.conductances()[k]);
        }
    }
}

/// What the error says, or nothing.
template <class Body>
std::string complaint(Body&& body) {
    try {
        body();
    } catch (const hearth::bad_value& error) {
        return error.what();
    }
    return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("cell graph: a lattice has its six neighbours, in order, with area over distance") {
    hearth::lattice mesh{{{4, 3, 2}, {0.1, 0.2, 0.5}, {false, false, false}, {0, 0, 0}}};
    const hearth::cell_graph graph{mesh};
    REQUIRE(graph.cell_count() == 24);
    CHECK(graph.volume(5) == doctest::Approx(0.01).epsilon(1e-15));
    // Cell 5 = (1, 1, 0): neighbours 1 (-y), 4 (-x), 6 (+x), 9 (+y), 17 (+z).
    const std::vector<int> expected{1, 4, 6, 9, 17};
    const std::vector<double> conductance{0.1 * 0.5 / 0.2, 0.2 * 0.5 / 0.1, 0.2 * 0.5 / 0.1, 0.1 * 0.5 / 0.2, 0.1 * 0.2 / 0.5};
    REQUIRE(graph.row_end(5) - graph.row_begin(5) == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CHECK(graph.neighbours()[graph.row_begin(5) + k] == expected[k]);
        // float has 24 bits: half an ulp is 6e-8
        CHECK(static_cast<double>(graph.conductances()[graph.row_begin(5) + k]) == doctest::Approx(conductance[k]).epsilon(6e-8));
    }
}

TEST_CASE("cell graph: a periodic lattice closes on itself, one cell wide it has no neighbour there") {
    hearth::lattice mesh{{{5, 2, 1}, {1, 1, 1}, {true, true, true}, {0, 0, 0}}};
    const hearth::cell_graph graph{mesh};
    const std::vector<int> expected{1, 4, 5};  // +x, -x, and y once although there are two faces
    REQUIRE(graph.row_end(0) == 3);
    for (std::size_t k = 0; k < 3; ++k) CHECK(graph.neighbours()[k] == expected[k]);
    CHECK(graph.conductances()[2] == 2.0F);  // two faces add up
}

TEST_CASE("cell graph: rows do not depend on storage or on the number of ranks") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        rows expected;
        for (const int ranks : {1, 2, 3, 5, 8}) {
            CAPTURE(ranks);
            // 8 ranks and 30 cells leave ranks with islands of one cell and, in some seeds, empty ones.
            global_mesh mesh(seed, 30, 70, 8);
            for (int& owner : mesh.owners) owner %= ranks;
            rows found(mesh.volumes.size());
            hearth::test::on_ranks(ranks, [&](auto communicator) {
                const listed_mesh part = mesh.part(communicator.rank(), seed + 100 * static_cast<std::uint64_t>(ranks));
                const hearth::cell_graph graph(part, communicator);
                read_rows(graph, found);  // every rank writes rows of its own cells
                std::vector<double> ids(static_cast<std::size_t>(graph.total_count()), -1);
                for (int c = 0; c < graph.cell_count(); ++c) {
                    ids[static_cast<std::size_t>(c)] = static_cast<double>(graph.global_index(c));
                }
                graph.halo().gather(ids.data());
                int wrong = 0;
                for (int c = 0; c < graph.total_count(); ++c) {
                    const auto cell = static_cast<std::size_t>(graph.global_index(c) / 7);
                    wrong += ids[static_cast<std::size_t>(c)] != static_cast<double>(graph.global_index(c));
                    wrong += graph.volume(c) != mesh.volumes[cell];
                    wrong += !graph.is_owned(c) && graph.owner(c) != mesh.owners[cell];
                }
                if (wrong > 0) throw std::logic_error("ghosts do not mirror their owners");
            });
            if (expected.empty()) expected = found;
            CHECK(found == expected);
        }
    }
}

TEST_CASE("cell graph: every view of the same mesh gives the same graph") {
    const hearth::lattice lattice{{{3, 4, 2}, {1, 1, 1}, {false, false, false}, {0, 0, 0}}};
    const hearth::cell_graph expected{lattice};
    std::vector<int> owner, neighbour, offsets{0}, neighbours;
    std::vector<double> ones(100, 1.0);
    hearth::mesh_traits<hearth::lattice>::for_each_face(lattice, [&](int a, int b, double, double) {
        owner.push_back(b);  // the order of the two does not matter
        neighbour.push_back(a);
    });
    for (int c = 0; c < expected.cell_count(); ++c) {
        expected.for_each_neighbour(c, [&](int n) { neighbours.push_back(n); });
        std::reverse(neighbours.begin() + offsets.back(), neighbours.end());
        offsets.push_back(static_cast<int>(neighbours.size()));
    }
    const hearth::face_mesh faces{24, static_cast<int>(owner.size()), owner.data(), neighbour.data(),
                                  ones.data(), ones.data(), ones.data()};
    const hearth::csr_graph csr{24, offsets.data(), neighbours.data(), ones.data()};
    const hearth::cell_graph from_faces{faces};
    const hearth::cell_graph from_csr{csr};
    CHECK(from_faces.has_conductances());
    CHECK_FALSE(from_csr.has_conductances());
    for (int c = 0; c < 24; ++c) {
        REQUIRE(from_faces.row_end(c) == expected.row_end(c));
        REQUIRE(from_csr.row_end(c) == expected.row_end(c));
    }
    for (std::uint32_t k = 0; k < expected.row_end(23); ++k) {
        CHECK(from_faces.neighbours()[k] == expected.neighbours()[k]);
        CHECK(from_csr.neighbours()[k] == expected.neighbours()[k]);
    }
}

TEST_CASE("cell graph: bad meshes are refused with the cell, the value and what is allowed") {
    const listed_mesh good{{1, 2, 3}, {10, 20, 30}, {{0, 1, 1.0}, {1, 2, 1.0}}, {}};
    const auto build = [](const listed_mesh& mesh) {
        return complaint([&] { const hearth::cell_graph graph{mesh}; });
    };
    CHECK(build(good).empty());
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double volume : {0.0, -1.0, infinity, std::nan("")}) {
        listed_mesh bad = good;
        bad.volumes[1] = volume;
        CHECK(says(build(bad), "volume of cell 20 is"));
        CHECK(says(build(bad), "finite and > 0 [m^3]"));
    }
    for (const double conductance : {0.0, -1.0, infinity, 1e39, std::nan("")}) {
        listed_mesh bad = good;
        bad.faces[1].conductance = conductance;
        CHECK(says(build(bad), "conductance of a face of cell 20"));
    }
    listed_mesh bad = good;
    bad.faces[1].b = 3;
    CHECK(says(build(bad), "neighbour of cell 20 is 3, allowed: 0 to cell_count - 1"));
    bad = good;
    bad.ids[2] = 10;
    CHECK(says(build(bad), "global index of cell 10 is 10, allowed: unique"));
    const int offsets[] = {0, 1, 1};
    const int neighbours[] = {1};
    const double volumes[] = {1, 1};
    CHECK(says(complaint([&] { const hearth::cell_graph graph{hearth::csr_graph{2, offsets, neighbours, volumes}}; }),
               "neighbour of cell 0 is 1, allowed: mutual"));
}

TEST_CASE("cell graph: ranks that disagree on a face are refused on every rank, without a hang") {
    struct spoil { const char* what; void (*apply)(listed_mesh&); const char* message; };
    const spoil spoils[] = {
        {"missing", [](listed_mesh& m) { m.remotes.clear(); }, "a neighbour that both ranks list"},
        {"unknown cell", [](listed_mesh& m) { m.remotes[0].there = 999; }, "a neighbour that both ranks list"},
        {"other conductance", [](listed_mesh& m) { m.remotes[0].conductance *= 1.1; }, "the same on both ranks"},
        {"rank out of range", [](listed_mesh& m) { m.remotes[0].rank = 7; }, "another rank of the communicator"},
        {"own rank", [](listed_mesh& m) { m.remotes[0].rank = 1; }, "another rank of the communicator"},
        {"duplicate id", [](listed_mesh& m) { m.ids[0] = 10; }, "unique over all cells and ranks"},
        {"volume", [](listed_mesh& m) { m.volumes[0] = -1; }, "finite and > 0 [m^3]"},
    };
    for (const spoil& spoil : spoils) {
        CAPTURE(spoil.what);
        std::vector<std::string> found(3);
        hearth::test::on_ranks(3, [&](auto communicator) {
            // A path of cells 10 - 20 - 30 over three ranks; rank 1 holds the one in the middle.
            const int r = communicator.rank();
            listed_mesh mesh{{1.0 + r}, {10 * (r + 1)}, {}, {}};
            if (r > 0) mesh.remotes.push_back({0, r - 1, 10 * r, 2.0});
            if (r < 2) mesh.remotes.push_back({0, r + 1, 10 * (r + 2), 2.0});
            if (r == 1) spoil.apply(mesh);
            found[static_cast<std::size_t>(r)] = complaint([&] { const hearth::cell_graph graph(mesh, communicator); });
        });
        for (const std::string& text : found) CHECK(says(text, spoil.message));
        CHECK(found[0] == found[1]);
        CHECK(found[0] == found[2]);
    }
}

TEST_CASE("cell graph: use after the host changed its mesh is an error") {
    listed_mesh mesh{{1, 2}, {0, 1}, {{0, 1, 1.0}}, {}};
    const hearth::cell_graph graph{mesh};
    graph.require_current();
    mesh.revision = 5;
    CHECK_THROWS_AS(graph.require_current(), hearth::stale_graph);
}

TEST_CASE("cell graph: a large lattice takes at most 64 bytes a cell") {
    const hearth::lattice mesh{{{60, 60, 60}, {1, 1, 1}, {true, true, true}, {0, 0, 0}}};
    const hearth::cell_graph graph{mesh};
    CHECK(static_cast<double>(graph.memory()) / graph.cell_count() <= 64.0);
}

TEST_CASE("cell graph: an empty mesh and a single cell are meshes") {
    const hearth::cell_graph none{listed_mesh{}};
    CHECK(none.cell_count() == 0);
    const hearth::cell_graph one{listed_mesh{{1.0}, {42}, {}, {}}};
    CHECK(one.row_end(0) == 0);
    CHECK(one.global_index(0) == 42);
}
