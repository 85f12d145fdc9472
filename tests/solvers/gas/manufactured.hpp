// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>


#include <hearth/gas/generate.hpp>
#include <hearth/gas/mesh.hpp>

namespace manufactured {

using hearth::gas::mesh;
using hearth::gas::vector3;

inline const double pi = std::acos(-1.0);
using function = std::function<double(const vector3&)>;

/// Derivative along an axis by central differences of sixth order; with h = 1e-3 its error is below 1e-12 of the field.
inline double derivative(const function& f, vector3 x, int axis) {
    const double h = 1e-3;
    const auto at = [&](double s) {
        vector3 y = x;
        y[axis] += s * h;
        return f(y);
    };
    return (45 * (at(1) - at(-1)) - 9 * (at(2) - at(-2)) + (at(3) - at(-3))) / (60 * h);
}

/// Mean of a function over a face by its corners, mid-sides and centre (Simpson's weights on a quadrilateral), or at
/// the centre for other shapes.  Manufactured fluxes and sources must not spoil second order.
inline double face_mean(const mesh& m, int f, const function& g) {
    const int* p = &m.shape.face_points[m.shape.face_first[f]];
    if (m.shape.face_first[f + 1] - m.shape.face_first[f] != 4) return g(m.face_centre[f]);
    double corners = 0, sides = 0;
    vector3 middle;
    for (int i = 0; i < 4; ++i) {
        const vector3 &a = m.shape.points[p[i]], &b = m.shape.points[p[(i + 1) % 4]];
        corners += g(a);
        sides += g(0.5 * (a + b));
        middle += 0.25 * a;
    }
    return (corners + 4 * sides + 16 * g(middle)) / 36;
}

/// Square of n by n cells, one cell thick, patches of box().  `bend` moves the points smoothly by that share of the
/// size; `shake` moves inner points by that share of a cell, pseudo-randomly.
inline mesh square(int n, double bend, double shake = 0) {
    using hearth::gas::graded;
    std::uint64_t seed = 12345;
    const auto uniform = [&] {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(seed >> 11) * 0x1p-53 - 0.5;
    };
    const int points = n + 1;
    hearth::gas::array<vector3> move(points * points);
    for (vector3& v : move) v = {shake / n * uniform(), shake / n * uniform(), 0};
    return mesh(hearth::gas::box(graded(1, n), graded(1, n), graded(1.0 / n, 1), [&](const vector3& x) {
        const double bump = bend * std::sin(2 * pi * x.x) * std::sin(2 * pi * x.y);
        const int i = static_cast<int>(std::lround(x.x * n)), j = static_cast<int>(std::lround(x.y * n));
        const bool inner = i > 0 && j > 0 && i < n && j < n;
        const vector3 shift = inner ? move[i + points * j] : vector3{};
        return vector3{x.x + bump + shift.x, x.y - bump + shift.y, x.z};
    }));
}

/// Root mean square over the volume of field - exact, after taking the mean of the difference off where asked for.
/// `inner` leaves out the cells at x and y boundaries.
inline double error(const mesh& m, const std::function<double(int)>& field, const function& exact, bool free_level,
                    bool inner = false) {
    hearth::gas::array<char> out(m.cells(), 0);
    for (int f = m.internal_faces(); inner && f < m.faces(); ++f)
        if (std::abs(m.area[f].z) < 0.5 * norm(m.area[f])) out[m.owner[f]] = 1;
    double mean = 0, volume = 0, sum = 0;
    for (int c = 0; c < m.cells(); ++c) {
        if (out[c]) continue;
        mean += m.volume[c] * (field(c) - exact(m.centre[c]));
        volume += m.volume[c];
    }
    mean = free_level ? mean / volume : 0;
    for (int c = 0; c < m.cells(); ++c) {
        if (out[c]) continue;
        const double d = field(c) - exact(m.centre[c]) - mean;
        sum += m.volume[c] * d * d;
    }
    return std::sqrt(sum / volume);
}

}  // namespace manufactured
