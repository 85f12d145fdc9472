// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>
#include <tuple>

#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

namespace {

/// Breadth-first from a cell of least degree, neighbours by rising degree, reversed (Cuthill & McKee 1969,
/// doi:10.1145/800195.805928; reversal after George).
array<int> reverse_cuthill_mckee(const polyhedra& shape, int cells) {
    array<int> first(cells + 1, 0);
    const int internal = static_cast<int>(shape.neighbour.size());
    for (int f = 0; f < internal; ++f) {
        ++first[shape.owner[f] + 1];
        ++first[shape.neighbour[f] + 1];
    }
    for (int c = 0; c < cells; ++c) first[c + 1] += first[c];
    array<int> next(first.begin(), first.end() - 1), adjacent(first[cells]);
    for (int f = 0; f < internal; ++f) {
        adjacent[next[shape.owner[f]]++] = shape.neighbour[f];
        adjacent[next[shape.neighbour[f]]++] = shape.owner[f];
    }
    const auto degree = [&](int c) { return first[c + 1] - first[c]; };
    const auto fewer = [&](int a, int b) { return std::make_tuple(degree(a), a) < std::make_tuple(degree(b), b); };
    array<int> by_degree(cells), order;
    std::iota(by_degree.begin(), by_degree.end(), 0);
    std::sort(by_degree.begin(), by_degree.end(), fewer);
    order.reserve(cells);
    array<char> seen(cells, 0);
    for (const int seed : by_degree) {
        if (seen[seed]) continue;
        seen[seed] = 1;
        order.push_back(seed);
        for (std::size_t i = order.size() - 1; i < order.size(); ++i) {
            const auto begin = order.size();
            for (int j = first[order[i]]; j < first[order[i] + 1]; ++j)
                if (!seen[adjacent[j]]) {
                    seen[adjacent[j]] = 1;
                    order.push_back(adjacent[j]);
                }
            std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.end(), fewer);
        }
    }
    array<int> new_of_old(cells);
    for (int i = 0; i < cells; ++i) new_of_old[order[i]] = cells - 1 - i;
    return new_of_old;
}

}  // namespace

polyhedra renumbered(const polyhedra& shape, array<int>* new_of_old) {
    int cells = 0;
    for (const auto* ends : {&shape.owner, &shape.neighbour})
        for (const int c : *ends) cells = std::max(cells, c + 1);
    const array<int> number = reverse_cuthill_mckee(shape, cells);
    const int faces = static_cast<int>(shape.owner.size()), internal = static_cast<int>(shape.neighbour.size());
    const auto lower = [&](int f) {
        return f < internal ? std::min(number[shape.owner[f]], number[shape.neighbour[f]]) : number[shape.owner[f]];
    };
    const auto upper = [&](int f) {
        return f < internal ? std::max(number[shape.owner[f]], number[shape.neighbour[f]]) : 0;
    };
    array<int> order(faces);
    std::iota(order.begin(), order.end(), 0);
    const auto before = [&](int a, int b) {
        return std::make_tuple(lower(a), upper(a), a) < std::make_tuple(lower(b), upper(b), b);
    };
    std::sort(order.begin(), order.begin() + internal, before);
    for (const patch& p : shape.patches) std::sort(order.begin() + p.first, order.begin() + p.first + p.count, before);

    polyhedra out;
    out.points = shape.points;
    out.patches = shape.patches;
    out.face_first = {0};
    for (const int f : order) {
        out.owner.push_back(lower(f));
        if (f < internal) out.neighbour.push_back(upper(f));
        const auto begin = shape.face_points.begin() + shape.face_first[f];
        const auto end = shape.face_points.begin() + shape.face_first[f + 1];
        if (number[shape.owner[f]] == out.owner.back())
            out.face_points.insert(out.face_points.end(), begin, end);
        else  // owner and neighbour changed places: turn the face over
            out.face_points.insert(out.face_points.end(), std::make_reverse_iterator(end),
                                   std::make_reverse_iterator(begin));
        out.face_first.push_back(static_cast<int>(out.face_points.size()));
    }
    if (new_of_old) *new_of_old = number;
    return out;
}

}  // namespace hearth::gas
