// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <hearth/core/mesh_traits.hpp>

#include "support/random.hpp"

namespace hearth::test {

/// A box between walls, filled with tetrahedra or with polyhedra.
///
/// The vertices are the corners and the middles of cubes, and the middles of the squares on the walls, moved at random
/// (along the walls where they are on one).  Four tetrahedra stand about each square between the middles of the two
/// cubes that it parts.  The polyhedra are the median dual of these tetrahedra, one for each vertex: every point
/// belongs to the vertex of its largest barycentric coordinate.  They have about 14 neighbours and warped faces.
class polyhedral_mesh {
  public:
    enum class cells { tetrahedra, polyhedra };
    struct face {
        int a, b;
        double area, conductance;
    };
    /// A quarter of a tetrahedron, part of a cell.
    struct piece {
        point centroid;
        double volume;
    };

    /// jitter: largest move of a vertex along each axis, in sides of a cube; up to 0.2 no tetrahedron turns over.
    polyhedral_mesh(cells kind, double side, int cubes, double jitter = 0.15, std::uint64_t seed = 1)
        : kind_(kind), cubes_(cubes), edge_(side / cubes), jitter_(jitter), random_(seed) {
        fill_with_tetrahedra();
        measure_cells();
        kind == cells::tetrahedra ? join_tetrahedra() : join_polyhedra();
    }

    int size() const { return static_cast<int>(volumes.size()); }

    /// Cell that holds a point, or -1.
    int find(const point& x) const {
        std::array<int, 3> low{}, high{};
        for (std::size_t a = 0; a < 3; ++a) {
            if (!(x[a] >= 0 && x[a] <= edge_ * cubes_)) return -1;
            const int at = std::min(static_cast<int>(x[a] / edge_), cubes_ - 1);
            low[a] = std::max(at - 1, 0);
            high[a] = std::min(at + 1, cubes_ - 1);
        }
        // Of the tetrahedra of the cubes around it that whose least coordinate is largest: round-off may leave it in
        // none.
        double best = -1;
        int found = -1;
        for (int k = low[2]; k <= high[2]; ++k) {
            for (int j = low[1]; j <= high[1]; ++j) {
                const int row = cubes_ * (j + cubes_ * k);
                for (int t = first_of_cube_[index(row + low[0])]; t < first_of_cube_[index(row + high[0] + 1)]; ++t) {
                    const std::array<double, 4> weight = barycentric(t, x);
                    const double least = *std::min_element(weight.begin(), weight.end());
                    if (least <= best) continue;
                    best = least;
                    const auto most = std::max_element(weight.begin(), weight.end()) - weight.begin();
                    found = kind_ == cells::tetrahedra ? t : tetrahedra_[index(t)][index(most)];
                }
            }
        }
        return found;
    }

    /// Mean angle between the lines of centres and the normals of their faces [rad].
    double mean_lean() const {
        double sum = 0;
        for (const face& f : faces) {
            const point apart = minus(centres[index(f.b)], centres[index(f.a)]);
            sum += std::acos(std::min(1.0, f.area / f.conductance / std::sqrt(dot(apart, apart))));
        }
        return sum / static_cast<double>(faces.size());
    }

    std::vector<double> volumes;
    std::vector<point> centres, extents;  ///< centroids; sides of the boxes about the cells
    std::vector<std::vector<piece>> pieces;
    std::vector<face> faces;

  private:
    template <class Integer>
    static std::size_t index(Integer i) {
        return static_cast<std::size_t>(i);
    }
    static point minus(const point& a, const point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
    static point cross(const point& a, const point& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static double dot(const point& a, const point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
    static double six_volumes(const point& a, const point& b, const point& c, const point& d) {
        return dot(minus(b, a), cross(minus(c, a), minus(d, a)));
    }
    template <class... Points>
    static point mean(const Points&... x) {
        const double n = sizeof...(x);
        return {(x[0] + ...) / n, (x[1] + ...) / n, (x[2] + ...) / n};
    }
    const point& corner(int tetrahedron, int k) const {
        return vertices_[index(tetrahedra_[index(tetrahedron)][index(k)])];
    }
    point middle(int t) const { return mean(corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3)); }

    /// Number of the vertex at a point of the lattice of half sides.
    int vertex(const std::array<int, 3>& at) {
        const auto [place, is_new] = numbers_.emplace(at, static_cast<int>(vertices_.size()));
        if (is_new) {
            point x{};
            for (std::size_t a = 0; a < 3; ++a) {
                const double move = at[a] == 0 || at[a] == 2 * cubes_ ? 0.0 : random_.uniform(-jitter_, jitter_);
                x[a] = edge_ * (0.5 * at[a] + move);
            }
            vertices_.push_back(x);
        }
        return place->second;
    }

    void fill_with_tetrahedra() {
        for (int k = 1; k < 2 * cubes_; k += 2) {
            for (int j = 1; j < 2 * cubes_; j += 2) {
                for (int i = 1; i < 2 * cubes_; i += 2) {
                    first_of_cube_.push_back(static_cast<int>(tetrahedra_.size()));
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        const std::array<int, 3> at{i, j, k};
                        if (at[axis] == 1) surround_square(at, axis, -1);
                        surround_square(at, axis, 1);
                    }
                }
            }
        }
        first_of_cube_.push_back(static_cast<int>(tetrahedra_.size()));
    }

    /// Four tetrahedra between the middle of a cube and that of the next, or of the wall.
    void surround_square(const std::array<int, 3>& cube, std::size_t axis, int side) {
        std::array<int, 3> square = cube, next = cube;
        square[axis] += side;
        next[axis] += 2 * side;
        const bool at_wall = next[axis] < 0 || next[axis] > 2 * cubes_;
        const int from = vertex(cube), to = vertex(at_wall ? square : next);
        const auto corner_number = [&](int b, int c) {
            std::array<int, 3> at = square;
            at[(axis + 1) % 3] += b;
            at[(axis + 2) % 3] += c;
            return vertex(at);
        };
        const std::array<int, 4> ring{corner_number(-1, -1), corner_number(1, -1), corner_number(1, 1),
                                      corner_number(-1, 1)};
        for (std::size_t c = 0; c < 4; ++c) tetrahedra_.push_back({from, to, ring[c], ring[(c + 1) % 4]});
    }

    void measure_cells() {
        const std::size_t count = kind_ == cells::tetrahedra ? tetrahedra_.size() : vertices_.size();
        volumes.assign(count, 0.0);
        centres.assign(count, {0, 0, 0});
        pieces.resize(count);
        std::vector<point> low(count, {1e300, 1e300, 1e300}), high(count, {-1e300, -1e300, -1e300});
        for (int t = 0; t < static_cast<int>(tetrahedra_.size()); ++t) {
            const double volume = std::abs(six_volumes(corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3))) / 6;
            for (int v = 0; v < 4; ++v) {
                const std::size_t cell = kind_ == cells::tetrahedra ? index(t) : index(tetrahedra_[index(t)][index(v)]);
                // Between the vertex and the middles of edges, faces and the whole: its own coordinate is
                // (1 + 1/2 + 1/3 + 1/4) / 4 in the mean, so 4/3 of that less 1/3 of the way from the middle.
                const double way = (4 * 25.0 / 48 - 1) / 3;
                piece part{middle(t), volume / 4};
                for (std::size_t a = 0; a < 3; ++a) part.centroid[a] += way * (corner(t, v)[a] - part.centroid[a]);
                volumes[cell] += part.volume;
                for (std::size_t a = 0; a < 3; ++a) centres[cell][a] += part.volume * part.centroid[a];
                pieces[cell].push_back(part);
                const auto reach = [&](const point& x) {
                    for (std::size_t a = 0; a < 3; ++a) {
                        low[cell][a] = std::min(low[cell][a], x[a]);
                        high[cell][a] = std::max(high[cell][a], x[a]);
                    }
                };
                reach(corner(t, v));
                for (int w = 0; w < 4; ++w) reach(mean(corner(t, v), corner(t, w)));
                reach(middle(t));
            }
        }
        for (std::size_t c = 0; c < count; ++c) {
            for (double& x : centres[c]) x /= volumes[c];
            extents.push_back(minus(high[c], low[c]));
        }
    }

    void join(int a, int b, const point& area) {
        const double size = std::sqrt(dot(area, area));
        const double along = std::abs(dot(minus(centres[index(b)], centres[index(a)]), area)) / size;
        faces.push_back({a, b, size, size / along});
    }

    void join_tetrahedra() {
        std::map<std::array<int, 3>, int> open;
        for (int t = 0; t < static_cast<int>(tetrahedra_.size()); ++t) {
            for (std::size_t without = 0; without < 4; ++without) {
                std::array<int, 4> sorted = tetrahedra_[index(t)];
                std::swap(sorted[without], sorted[3]);
                std::sort(sorted.begin(), sorted.begin() + 3);
                const auto [place, is_new] = open.emplace(std::array<int, 3>{sorted[0], sorted[1], sorted[2]}, t);
                if (is_new) continue;
                const point& x = vertices_[index(sorted[0])];
                point area = cross(minus(vertices_[index(sorted[1])], x), minus(vertices_[index(sorted[2])], x));
                for (double& component : area) component *= 0.5;
                join(place->second, t, area);
            }
        }
    }

    void join_polyhedra() {
        std::map<std::pair<int, int>, point> areas;  // from the lower number to the higher
        for (int t = 0; t < static_cast<int>(tetrahedra_.size()); ++t) {
            for (int v = 0; v < 4; ++v) {
                for (int w = 0; w < 4; ++w) {
                    const int a = tetrahedra_[index(t)][index(v)], b = tetrahedra_[index(t)][index(w)];
                    if (a >= b) continue;
                    int c = 0;
                    while (c == v || c == w) ++c;
                    const int d = 6 - v - w - c;
                    // A quadrangle: the middles of the edge, a face, the tetrahedron and the other face.
                    const point area = cross(minus(middle(t), mean(corner(t, v), corner(t, w))),
                                             minus(mean(corner(t, v), corner(t, w), corner(t, d)),
                                                   mean(corner(t, v), corner(t, w), corner(t, c))));
                    const double half = dot(area, minus(corner(t, w), corner(t, v))) > 0 ? 0.5 : -0.5;
                    point& sum = areas[{a, b}];
                    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += half * area[axis];
                }
            }
        }
        for (const auto& [ends, area] : areas) join(ends.first, ends.second, area);
    }

    std::array<double, 4> barycentric(int t, const point& x) const {
        const point &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2), &d = corner(t, 3);
        const double all = six_volumes(a, b, c, d);
        return {six_volumes(x, b, c, d) / all, six_volumes(a, x, c, d) / all, six_volumes(a, b, x, d) / all,
                six_volumes(a, b, c, x) / all};
    }

    cells kind_;
    int cubes_;
    double edge_, jitter_;
    hearth_test::seeded random_;
    std::map<std::array<int, 3>, int> numbers_;
    std::vector<point> vertices_;
    std::vector<std::array<int, 4>> tetrahedra_;
    std::vector<int> first_of_cube_;
};

}  // namespace hearth::test

template <>
struct hearth::mesh_traits<hearth::test::polyhedral_mesh> {
    using index = int;
    using scalar = double;
    using mesh_type = hearth::test::polyhedral_mesh;

    static index cell_count(const mesh_type& m) { return m.size(); }
    static scalar volume(const mesh_type& m, index c) { return m.volumes[static_cast<std::size_t>(c)]; }
    static point centre(const mesh_type& m, index c) { return m.centres[static_cast<std::size_t>(c)]; }
    static point extent(const mesh_type& m, index c) { return m.extents[static_cast<std::size_t>(c)]; }
    static index find_cell(const mesh_type& m, const point& x) { return m.find(x); }
    template <class Visit>
    static void for_each_face(const mesh_type& m, Visit&& visit) {
        for (const auto& f : m.faces) visit(f.a, f.b, f.area, f.conductance);
    }
};
