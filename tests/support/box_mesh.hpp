// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <hearth/core/mesh_traits.hpp>

namespace hearth::test {

/// A mesh of boxes between planes x = const, y = const, z = const of any spacing, of which some are split into eight
/// (hanging faces: polyhedra for the solver); walls or periodic.  Cells are numbered as made.
class box_mesh {
  public:
    struct face {
        int a, b;
        double area, conductance;
    };

    /// split(i, j, k): whether the box between these planes and the next is split.
    template <class Split>
    box_mesh(std::array<std::vector<double>, 3> planes, std::array<bool, 3> periodic, Split&& split)
        : planes_(std::move(planes)), periodic_(periodic) {
        for (std::size_t a = 0; a < 3; ++a) count_[a] = static_cast<int>(planes_[a].size()) - 1;
        for (int k = 0; k < count_[2]; ++k) {
            for (int j = 0; j < count_[1]; ++j) {
                for (int i = 0; i < count_[0]; ++i) add_box({i, j, k}, split(i, j, k));
            }
        }
        first_.push_back(static_cast<int>(centres.size()));
        for (int k = 0; k < count_[2]; ++k) {
            for (int j = 0; j < count_[1]; ++j) {
                for (int i = 0; i < count_[0]; ++i) add_faces({i, j, k});
            }
        }
    }
    box_mesh(std::array<std::vector<double>, 3> planes, std::array<bool, 3> periodic)
        : box_mesh(std::move(planes), periodic, [](int, int, int) { return false; }) {}

    int size() const { return static_cast<int>(centres.size()); }
    double volume(int c) const {
        const point& h = extents[static_cast<std::size_t>(c)];
        return h[0] * h[1] * h[2];
    }
    point period() const {
        point length{};
        for (std::size_t a = 0; a < 3; ++a) length[a] = periodic_[a] ? planes_[a].back() - planes_[a].front() : 0.0;
        return length;
    }

    int find(point x) const {
        std::array<int, 3> at{};
        for (std::size_t a = 0; a < 3; ++a) {
            const double low = planes_[a].front(), length = planes_[a].back() - low;
            if (periodic_[a]) x[a] -= length * std::floor((x[a] - low) / length);
            const auto above = std::upper_bound(planes_[a].begin(), planes_[a].end(), x[a]);
            at[a] = static_cast<int>(above - planes_[a].begin()) - 1;
            if (at[a] < 0 || at[a] >= count_[a]) return -1;
        }
        const std::size_t b = box(at);
        int cell = first_[b];
        if (first_[b + 1] - cell == 1) return cell;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto i = static_cast<std::size_t>(at[a]);
            if (x[a] >= 0.5 * (planes_[a][i] + planes_[a][i + 1])) cell += 1 << a;
        }
        return cell;
    }

    std::vector<point> centres, extents;
    std::vector<face> faces;

  private:
    std::size_t box(const std::array<int, 3>& at) const {
        return static_cast<std::size_t>(at[0] + count_[0] * (at[1] + count_[1] * at[2]));
    }

    void add_box(const std::array<int, 3>& at, bool split) {
        first_.push_back(static_cast<int>(centres.size()));
        for (int child = 0; child < (split ? 8 : 1); ++child) {
            point centre{}, extent{};
            for (std::size_t a = 0; a < 3; ++a) {
                const auto i = static_cast<std::size_t>(at[a]);
                extent[a] = (planes_[a][i + 1] - planes_[a][i]) * (split ? 0.5 : 1.0);
                centre[a] = planes_[a][i] + extent[a] * (0.5 + (split ? (child >> a) & 1 : 0));
            }
            centres.push_back(centre);
            extents.push_back(extent);
        }
    }

    /// Faces inside a split box, and to the next boxes along each axis.
    void add_faces(const std::array<int, 3>& at) {
        const std::size_t here = box(at);
        for (std::size_t a = 0; a < 3; ++a) {
            connect(here, here, a, 0.0);
            std::array<int, 3> next = at;
            if (++next[a] == count_[a]) {
                if (!periodic_[a]) continue;
                next[a] = 0;
                connect(here, box(next), a, planes_[a].back() - planes_[a].front());
            } else {
                connect(here, box(next), a, 0.0);
            }
        }
    }

    void connect(std::size_t from, std::size_t to, std::size_t axis, double shift) {
        for (int c = first_[from]; c < first_[from + 1]; ++c) {
            for (int d = first_[to]; d < first_[to + 1]; ++d) {
                const auto p = static_cast<std::size_t>(c), q = static_cast<std::size_t>(d);
                const double distance = centres[q][axis] + shift - centres[p][axis];
                const double touching = 0.5 * (extents[p][axis] + extents[q][axis]);
                if (c == d || std::abs(distance - touching) > 1e-9 * touching) continue;
                double area = 1;
                for (std::size_t a = 0; a < 3; ++a) {
                    if (a == axis) continue;
                    const double low = std::max(centres[p][a] - extents[p][a] / 2, centres[q][a] - extents[q][a] / 2);
                    const double high = std::min(centres[p][a] + extents[p][a] / 2, centres[q][a] + extents[q][a] / 2);
                    area *= std::max(0.0, high - low);
                }
                if (area > 1e-9 * touching * touching * 1e-6) faces.push_back({c, d, area, area / distance});
            }
        }
    }

    std::array<std::vector<double>, 3> planes_;
    std::array<bool, 3> periodic_;
    std::array<int, 3> count_{};
    std::vector<int> first_;
};

/// Planes from 0 to `length`, each cell `ratio` times as long as the one before.
inline std::vector<double> graded_planes(double length, int cells, double ratio) {
    std::vector<double> planes{0};
    double step = 1;
    for (int i = 0; i < cells; ++i, step *= ratio) planes.push_back(planes.back() + step);
    const double scale = length / planes.back();
    for (double& x : planes) x *= scale;
    planes.back() = length;
    return planes;
}

/// One rank's share of a box_mesh: its cells in a random order of storage; global index = number in the whole mesh.
class box_share {
  public:
    box_share(const box_mesh& whole, const std::vector<int>& owners, int rank, std::uint64_t seed)
        : whole_(&whole), local_(owners.size(), -1) {
        for (int c = 0; c < whole.size(); ++c) {
            if (owners[static_cast<std::size_t>(c)] == rank) cells.push_back(c);
        }
        std::mt19937_64 random(seed);
        for (std::size_t k = cells.size(); k > 1; --k) std::swap(cells[k - 1], cells[random() % k]);
        for (std::size_t k = 0; k < cells.size(); ++k) local_[static_cast<std::size_t>(cells[k])] = static_cast<int>(k);
        for (const box_mesh::face& f : whole.faces) {
            const int a = owners[static_cast<std::size_t>(f.a)], b = owners[static_cast<std::size_t>(f.b)];
            if (a == rank && b == rank) faces.push_back({local(f.a), local(f.b), f.area, f.conductance});
            if (a == rank && b != rank) remote.push_back({{local(f.a), f.b, f.area, f.conductance}, b});
            if (b == rank && a != rank) remote.push_back({{local(f.b), f.a, f.area, f.conductance}, a});
        }
    }

    const box_mesh& whole() const { return *whole_; }
    int global(int c) const { return cells[static_cast<std::size_t>(c)]; }
    int local(int c) const { return c < 0 ? -1 : local_[static_cast<std::size_t>(c)]; }

    std::vector<int> cells;
    std::vector<box_mesh::face> faces;
    std::vector<std::pair<box_mesh::face, int>> remote;

  private:
    const box_mesh* whole_;
    std::vector<int> local_;
};

/// Owners of cells at random, in runs of random length: islands of one cell, and ranks without cells.
inline std::vector<int> random_owners(int cells, int ranks, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<int> owners;
    while (static_cast<int>(owners.size()) < cells) {
        const auto rank = static_cast<int>(random() % static_cast<std::uint64_t>(ranks));
        const std::uint64_t run = 1 + (random() % 3 == 0 ? 0 : random() % 40);
        for (std::uint64_t k = 0; k < run && static_cast<int>(owners.size()) < cells; ++k) owners.push_back(rank);
    }
    if (ranks > 2) std::replace(owners.begin(), owners.end(), ranks - 2, 0);  // a rank that owns nothing
    return owners;
}

/// Sum of volume times field [m^3].
template <class Mesh>
double solid_volume(const Mesh& mesh, const std::vector<double>& field) {
    long double sum = 0;
    for (std::size_t c = 0; c < field.size(); ++c) {
        const auto volume = mesh_traits<Mesh>::volume(mesh, static_cast<int>(c));
        sum += static_cast<long double>(field[c]) * static_cast<long double>(volume);
    }
    return static_cast<double>(sum);
}

}  // namespace hearth::test

template <>
struct hearth::mesh_traits<hearth::test::box_mesh> {
    using index = int;
    using scalar = double;
    using mesh_type = hearth::test::box_mesh;

    static index cell_count(const mesh_type& m) { return m.size(); }
    static scalar volume(const mesh_type& m, index c) { return m.volume(c); }
    static point centre(const mesh_type& m, index c) { return m.centres[static_cast<std::size_t>(c)]; }
    static point extent(const mesh_type& m, index c) { return m.extents[static_cast<std::size_t>(c)]; }
    static point period(const mesh_type& m) { return m.period(); }
    static index find_cell(const mesh_type& m, const point& x) { return m.find(x); }
    template <class Visit>
    static void for_each_face(const mesh_type& m, Visit&& visit) {
        for (const auto& f : m.faces) visit(f.a, f.b, f.area, f.conductance);
    }
};

template <>
struct hearth::mesh_traits<hearth::test::box_share> {
    using index = int;
    using scalar = double;
    using mesh_type = hearth::test::box_share;

    static index cell_count(const mesh_type& m) { return static_cast<int>(m.cells.size()); }
    static scalar volume(const mesh_type& m, index c) { return m.whole().volume(m.global(c)); }
    static std::int64_t global_index(const mesh_type& m, index c) { return m.global(c); }
    static point centre(const mesh_type& m, index c) {
        return m.whole().centres[static_cast<std::size_t>(m.global(c))];
    }
    static point extent(const mesh_type& m, index c) {
        return m.whole().extents[static_cast<std::size_t>(m.global(c))];
    }
    static point period(const mesh_type& m) { return m.whole().period(); }
    static index find_cell(const mesh_type& m, const point& x) { return m.local(m.whole().find(x)); }
    template <class Visit>
    static void for_each_face(const mesh_type& m, Visit&& visit) {
        for (const auto& f : m.faces) visit(f.a, f.b, f.area, f.conductance);
    }
    template <class Visit>
    static void for_each_remote_face(const mesh_type& m, Visit&& visit) {
        for (const auto& [f, rank] : m.remote) visit(f.a, rank, std::int64_t{f.b}, f.area, f.conductance);
    }
};
