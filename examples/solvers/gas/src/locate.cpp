// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// Uniform bins over the bounding box; each lists the cells whose box touches it.
struct mesh::location {
    explicit location(const mesh& m);

    vector3 low, bin_size;
    int bins[3] = {0, 0, 0};
    array<int> bin_first, bin_cells, cell_face_first, cell_faces;
};

mesh::location::location(const mesh& m) {
    const polyhedra& shape = m.shape;
    const int n = m.owned_cells();
    cell_face_first.assign(n + 1, 0);
    const auto for_each_owned_side = [&](auto visit) {
        for (int f = 0; f < m.faces(); ++f) {
            if (m.owner[f] < n) visit(m.owner[f], f);
            if (f < m.internal_faces() && m.neighbour[f] < n) visit(m.neighbour[f], f);
        }
    };
    for_each_owned_side([&](int c, int) { ++cell_face_first[c + 1]; });
    for (int c = 0; c < n; ++c) cell_face_first[c + 1] += cell_face_first[c];
    cell_faces.resize(cell_face_first[n]);
    array<int> next(cell_face_first.begin(), cell_face_first.end() - 1);
    const double infinite = std::numeric_limits<double>::infinity();
    array<vector3> from(n, {infinite, infinite, infinite}), to(n, {-infinite, -infinite, -infinite});
    for_each_owned_side([&](int c, int f) {
        cell_faces[next[c]++] = f;
        for (int i = shape.face_first[f]; i < shape.face_first[f + 1]; ++i)
            for (int k = 0; k < 3; ++k) {
                from[c][k] = std::min(from[c][k], shape.points[shape.face_points[i]][k]);
                to[c][k] = std::max(to[c][k], shape.points[shape.face_points[i]][k]);
            }
    });
    vector3 top = to[0];
    low = from[0];
    for (int c = 0; c < n; ++c)
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], from[c][k]);
            top[k] = std::max(top[k], to[c][k]);
        }
    // Twice as wide as a cell, and boxes that only touch a bin stay out of it (find_cell forgives 1e-6 cell sizes): few
    // cells stand in several bins.
    const double edge = 2 * std::cbrt((top.x - low.x) * (top.y - low.y) * (top.z - low.z) / n);
    for (int k = 0; k < 3; ++k) {
        bins[k] = std::max(1, std::min(1024, static_cast<int>((top[k] - low[k]) / edge)));
        bin_size[k] = (top[k] - low[k]) / bins[k];
    }
    const auto bin = [&](double x, int k) {
        return std::max(0, std::min(bins[k] - 1, static_cast<int>((x - low[k]) / bin_size[k])));
    };
    const auto for_each_bin = [&](auto visit) {
        for (int c = 0; c < n; ++c) {
            const double slack = 1e-7 * std::cbrt(m.volume[c]);
            const vector3 margin{slack, slack, slack}, first = from[c] + margin, last = to[c] - margin;
            for (int k = bin(first.z, 2); k <= bin(last.z, 2); ++k)
                for (int j = bin(first.y, 1); j <= bin(last.y, 1); ++j)
                    for (int i = bin(first.x, 0); i <= bin(last.x, 0); ++i) visit(i + bins[0] * (j + bins[1] * k), c);
        }
    };
    const int bin_count = bins[0] * bins[1] * bins[2];
    bin_first.assign(bin_count + 1, 0);
    for_each_bin([&](int b, int) { ++bin_first[b + 1]; });
    for (int b = 0; b < bin_count; ++b) bin_first[b + 1] += bin_first[b];
    bin_cells.resize(bin_first[bin_count]);
    next.assign(bin_first.begin(), bin_first.end() - 1);
    for_each_bin([&](int b, int c) { bin_cells[next[b]++] = c; });
}

/// Made by the first search, which others of the same moment wait for.
const mesh::location& mesh::locate() const {
    static std::mutex one_at_a_time;
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    if (!location_) {
        if (shape.points.empty())
            throw std::logic_error("hearth::gas: mesh: find_cell after release_shape: the points are gone");
        location_ = std::make_shared<const location>(*this);
    }
    return *location_;
}

int mesh::find_cell(const vector3& point) const {
    const location& at = locate();
    int index[3];
    for (int k = 0; k < 3; ++k) {
        const double place = (point[k] - at.low[k]) / at.bin_size[k];
        if (!(place > -1e-9 && place < at.bins[k] + 1e-9)) return -1;
        index[k] = std::max(0, std::min(at.bins[k] - 1, static_cast<int>(place)));
    }
    const int b = index[0] + at.bins[0] * (index[1] + at.bins[1] * index[2]);
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = at.bin_first[b]; i < at.bin_first[b + 1]; ++i) {
        const int c = at.bin_cells[i];
        double outside = -least;  // greatest distance beyond a face, in cell sizes
        for (int j = at.cell_face_first[c]; j < at.cell_face_first[c + 1]; ++j) {
            const int f = at.cell_faces[j];
            const double sign = owner[f] == c ? 1 : -1;
            outside = std::max(outside, sign * dot(area[f], point - face_centre[f]) / norm(area[f]));
        }
        outside /= std::cbrt(volume[c]);
        if (outside < least) {
            least = outside;
            best = c;
        }
        if (least < 0) break;  // inside this one, so in no other
    }
    return least < 1e-6 ? best : -1;  // warped faces leave gaps of that order between their planes
}

}  // namespace hearth::gas
