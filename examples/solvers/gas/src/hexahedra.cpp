// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include <hearth/gas/generate.hpp>

namespace hearth::gas {

namespace {

// Points of each side of a hexahedron, turning right-handed about the outward normal.
constexpr int side_points[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

struct half_face {
    std::array<int, 4> key;  // sorted points
    int cell, side;
};

int corner(const std::array<int, 8>& cell, int i) { return cell[static_cast<std::size_t>(i)]; }

}  // namespace

polyhedra from_hexahedra(array<vector3> points, const array<std::array<int, 8>>& cells,
                         const std::function<std::string(int, int)>& patch_of) {
    array<half_face> sides;
    sides.reserve(6 * cells.count());
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (int s = 0; s < 6; ++s) {
            half_face h{{}, static_cast<int>(c), s};
            for (int i = 0; i < 4; ++i) h.key[static_cast<std::size_t>(i)] = corner(cells[c], side_points[s][i]);
            std::sort(h.key.begin(), h.key.end());
            sides.push_back(h);
        }
    std::sort(sides.begin(), sides.end(), [](const half_face& a, const half_face& b) {
        return a.key != b.key ? a.key < b.key : a.cell < b.cell;
    });

    struct face { int owner, neighbour, side; };
    array<face> inner, outer;
    array<int> patch_number;
    array<std::string> names;
    std::map<std::string, int> number_of;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (i + 1 < sides.size() && sides[i].key == sides[i + 1].key) {
            if (i + 2 < sides.size() && sides[i].key == sides[i + 2].key)
                throw mesh_error("three cells share one face", sides[i].cell, -1);
            inner.push_back({sides[i].cell, sides[i + 1].cell, sides[i].side});
            ++i;
        } else {
            outer.push_back({sides[i].cell, -1, sides[i].side});
        }
    }
    std::sort(inner.begin(), inner.end(), [](const face& a, const face& b) {
        return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour;
    });
    std::sort(outer.begin(), outer.end(), [](const face& a, const face& b) {
        return a.owner != b.owner ? a.owner < b.owner : a.side < b.side;
    });
    for (const face& f : outer) {
        const std::string name = patch_of(f.owner, f.side);
        const auto found = number_of.emplace(name, static_cast<int>(names.size()));
        if (found.second) names.push_back(name);
        patch_number.push_back(found.first->second);
    }

    polyhedra out;
    out.points = std::move(points);
    out.face_first.reserve(inner.count() + outer.count() + 1);
    out.face_first.push_back(0);
    const auto add = [&](const face& f) {
        out.owner.push_back(f.owner);
        for (const int p : side_points[f.side]) out.face_points.push_back(corner(cells[f.owner], p));
        out.face_first.push_back(static_cast<int>(out.face_points.size()));
    };
    for (const face& f : inner) {
        add(f);
        out.neighbour.push_back(f.neighbour);
    }
    for (std::size_t n = 0; n < names.size(); ++n) {
        patch p{names[n], static_cast<int>(out.owner.size()), 0};
        for (std::size_t i = 0; i < outer.size(); ++i)
            if (patch_number[i] == static_cast<int>(n)) add(outer[i]);
        p.count = static_cast<int>(out.owner.size()) - p.first;
        out.patches.push_back(p);
    }
    return out;
}

array<double> graded(double length, int cells, double ratio) {
    if (!(length > 0) || cells < 1 || !(ratio > 0))
        throw std::invalid_argument("hearth::gas: graded: length, cells and ratio must be positive");
    array<double> level(cells + 1);
    const double growth = cells > 1 ? std::pow(ratio, 1.0 / (cells - 1)) : 1.0;
    for (int i = 0; i <= cells; ++i)
        level[i] = std::abs(growth - 1) < 1e-12 ? length * i / cells
                                                : length * (std::pow(growth, i) - 1) / (std::pow(growth, cells) - 1);
    level.back() = length;
    return level;
}

polyhedra box(const array<double>& x, const array<double>& y, const array<double>& z,
              const std::function<vector3(const vector3&)>& map) {
    for (const auto* levels : {&x, &y, &z}) {
        if (levels->size() < 2) throw std::invalid_argument("hearth::gas: box: each axis needs two levels or more");
        for (std::size_t i = 1; i < levels->size(); ++i)
            if (!((*levels)[i] > (*levels)[i - 1])) throw std::invalid_argument("hearth::gas: box: levels must rise");
    }
    const int nx = static_cast<int>(x.size()), ny = static_cast<int>(y.size()), nz = static_cast<int>(z.size());
    array<vector3> points;
    for (const double c : z)
        for (const double b : y)
            for (const double a : x) points.push_back(map ? map({a, b, c}) : vector3{a, b, c});
    array<std::array<int, 8>> cells;
    for (int k = 0; k + 1 < nz; ++k)
        for (int j = 0; j + 1 < ny; ++j)
            for (int i = 0; i + 1 < nx; ++i) {
                const int p = i + nx * (j + ny * k), up = nx * ny;
                cells.push_back({p, p + 1, p + 1 + nx, p + nx, p + up, p + 1 + up, p + 1 + nx + up, p + nx + up});
            }
    return from_hexahedra(std::move(points), cells, [](int, int side) {
        return std::string(1, "xyz"[side / 2]) + (side % 2 == 0 ? "_min" : "_max");
    });
}

}  // namespace hearth::gas
