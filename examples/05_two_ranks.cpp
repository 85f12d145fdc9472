// SPDX-License-Identifier: MIT
// A mesh and its particles spread over ranks: the same solid fraction, to the last bit, as on one rank.
//
//     mpirun -np 2 example_05_two_ranks
//
// The host cuts a lattice into slabs along z, one per rank, and gives each particle to the rank that holds its centre.
// Particles are three cells wide and hang over the cuts.  The host needs no ghost cells; it tells two things more than
// on one rank: persistent ids, and which faces it shares with which rank.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include <mpi.h>

#include <hearth/core/strided_cloud.hpp>
#include <hearth/mpi/communicator.hpp>
#include <hearth/voidage/filtered_fraction.hpp>

namespace host {

/// Layers first <= k < last of a lattice of n * n * n cells.
struct slab {
    int n;
    double spacing;
    int first, last;
    int rank_below, rank_above;  // -1: a wall

    int layer() const { return n * n; }
    int cell_count() const { return layer() * (last - first); }
};

}  // namespace host

template <>
struct hearth::mesh_traits<host::slab> {
    using index = int;
    using scalar = double;

    static index cell_count(const host::slab& m) { return m.cell_count(); }
    static scalar volume(const host::slab& m, index) { return m.spacing * m.spacing * m.spacing; }
    static std::int64_t global_index(const host::slab& m, index cell) { return m.first * m.layer() + cell; }

    static point centre(const host::slab& m, index cell) {
        const int i = cell % m.n, j = cell / m.n % m.n, k = m.first + cell / m.layer();
        return {(i + 0.5) * m.spacing, (j + 0.5) * m.spacing, (k + 0.5) * m.spacing};
    }
    static index find_cell(const host::slab& m, const point& x) {
        const double i = x[0] / m.spacing, j = x[1] / m.spacing, k = x[2] / m.spacing - m.first;
        const bool inside = i >= 0 && i < m.n && j >= 0 && j < m.n && k >= 0 && k < m.last - m.first;
        return inside ? static_cast<int>(i) + m.n * (static_cast<int>(j) + m.n * static_cast<int>(k)) : -1;
    }

    template <class Visit>
    static void for_each_face(const host::slab& m, Visit&& visit) {
        const double area = m.spacing * m.spacing, conductance = area / m.spacing;
        for (int cell = 0; cell < m.cell_count(); ++cell) {
            if (cell % m.n + 1 < m.n) visit(cell, cell + 1, area, conductance);
            if (cell / m.n % m.n + 1 < m.n) visit(cell, cell + m.n, area, conductance);
            if (cell + m.layer() < m.cell_count()) visit(cell, cell + m.layer(), area, conductance);
        }
    }
    template <class Visit>
    static void for_each_remote_face(const host::slab& m, Visit&& visit) {
        const double area = m.spacing * m.spacing, conductance = area / m.spacing;
        for (int cell = 0; cell < m.layer(); ++cell) {
            const int top = m.cell_count() - m.layer() + cell;
            if (m.rank_below >= 0) visit(cell, m.rank_below, global_index(m, cell - m.layer()), area, conductance);
            if (m.rank_above >= 0) visit(top, m.rank_above, global_index(m, top + m.layer()), area, conductance);
        }
    }
};

namespace {

constexpr int n = 18;
constexpr double spacing = 1e-3;  // [m]
constexpr double radius = 1.5e-3;

/// Spheres at the nodes of a coarse grid, each pushed by chance; only those whose centres are in layers of the slab.
struct bed {
    explicit bed(const host::slab& mesh) {
        std::mt19937_64 generator(5);
        for (std::int64_t id = 0; id < 125; ++id) {
            hearth::point x{};
            std::int64_t rest = id;
            for (double& coordinate : x) {
                const double push = static_cast<double>(generator() >> 11) * 0x1p-53 - 0.5;
                coordinate = (3.5 * (static_cast<double>(rest % 5) + 0.5) + push) * spacing;
                rest /= 5;
            }
            if (hearth::mesh_traits<host::slab>::find_cell(mesh, x) < 0) continue;
            ids.push_back(id);
            centres.push_back(x);
        }
    }

    hearth::strided_cloud<> cloud() const {
        hearth::strided_cloud<> view;
        view.count = static_cast<std::int64_t>(ids.size());
        view.position = {centres.empty() ? nullptr : centres.front().data(), 3};
        view.radius = {&radius, 0};
        view.ids = ids.data();
        return view;
    }

    std::vector<std::int64_t> ids;
    std::vector<hearth::point> centres;
};

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int failed = 0;
    {
        const hearth::mpi::communicator ranks(MPI_COMM_WORLD);
        const int rank = ranks.rank(), size = ranks.size();
        host::slab mine{n, spacing, n * rank / size, n * (rank + 1) / size, rank - 1, rank + 1};
        if (mine.rank_above == size) mine.rank_above = -1;
        std::vector<double> solid_fraction(static_cast<std::size_t>(mine.cell_count()));
        const auto report = hearth::filtered_solid_fraction(mine, bed(mine).cloud(), solid_fraction, {}, ranks);

        // The same on one rank, for comparison: every rank has the whole lattice and all particles.
        const host::slab whole{n, spacing, 0, n, -1, -1};
        std::vector<double> expected(static_cast<std::size_t>(whole.cell_count()));
        hearth::filtered_solid_fraction(whole, bed(whole).cloud(), expected);

        std::int64_t different = 0;
        for (std::size_t cell = 0; cell < solid_fraction.size(); ++cell) {
            const auto id = hearth::mesh_traits<host::slab>::global_index(mine, static_cast<int>(cell));
            if (solid_fraction[cell] != expected[static_cast<std::size_t>(id)]) ++different;
        }
        ranks.sum(&different, 1);
        failed = different != 0 || report.particles != 125 || !(report.maximum > 0.1);
        if (rank == 0) {
            std::printf(
                "%d ranks, %lld particles, largest solid fraction %.3f, cells that differ from one rank: %lld\n", size,
                static_cast<long long>(report.particles), report.maximum, static_cast<long long>(different));
        }
    }
    MPI_Finalize();
    return failed;
}
