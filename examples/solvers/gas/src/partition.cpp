// SPDX-License-Identifier: MIT
#include <hearth/gas/partition.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hearth::gas {

array<int> partition(const mesh& whole, int parts) {
    const int n = whole.owned_cells();
    if (parts < 1 || parts > n)
        throw std::invalid_argument("hearth::gas: partition: " + std::to_string(parts) + " parts of " +
                                    std::to_string(n) + " cells, allowed: 1 to the number of cells");
    array<int> cells(n), part(n, 0);
    array<std::int64_t> place(n);
    std::iota(cells.begin(), cells.end(), 0);
    struct piece { int first, last, part, parts; };
    array<piece> pieces(1, {0, n, 0, parts});
    while (!pieces.empty()) {
        const piece p = pieces.back();
        pieces.pop_back();
        if (p.parts == 1) {
            for (int i = p.first; i < p.last; ++i) part[cells[i]] = p.part;
            continue;
        }
        vector3 low = whole.centre[cells[p.first]], high = low;
        for (int i = p.first; i < p.last; ++i)
            for (int k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], whole.centre[cells[i]][k]);
                high[k] = std::max(high[k], whole.centre[cells[i]][k]);
            }
        const vector3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const int left = p.parts / 2;
        const auto middle = p.first + static_cast<int>(static_cast<std::int64_t>(p.last - p.first) * left / p.parts);
        // rounded, so that a layer of cells is one tie and is cut along its numbering
        for (int i = p.first; i < p.last; ++i)
            place[cells[i]] = std::llround((whole.centre[cells[i]][axis] - low[axis]) / size[axis] * 1e9);
        const auto before = [&](int a, int b) { return place[a] != place[b] ? place[a] < place[b] : a < b; };
        std::nth_element(cells.begin() + p.first, cells.begin() + middle, cells.begin() + p.last, before);
        pieces.push_back({p.first, middle, p.part, left});
        pieces.push_back({middle, p.last, p.part + left, p.parts - left});
    }
    return part;
}

array<shared_face> faces_of_share(const mesh& whole, const array<int>& rank_of_cell, int rank) {
    const auto mine = [&](int c) { return rank_of_cell[c] == rank; };
    const int internal = whole.internal_faces();
    array<shared_face> faces;
    for (const bool towards_ghosts : {false, true})
        for (int f = 0; f < internal; ++f) {
            const int p = whole.owner[f], q = whole.neighbour[f];
            if ((mine(p) || mine(q)) && (mine(p) != mine(q)) == towards_ghosts) faces.push_back({f, !mine(p)});
        }
    for (int f = internal; f < whole.faces(); ++f)
        if (mine(whole.owner[f])) faces.push_back({f, false});
    return faces;
}

mesh::mesh(const mesh& whole, const array<int>& rank_of_cell, int rank) : largest_angle(whole.largest_angle) {
    if (whole.shape.points.empty()) throw std::logic_error("hearth::gas: mesh: a share after release_shape: the points are gone");
    const int internal = whole.internal_faces();
    array<int> local(whole.owned_cells(), -1);
    for (int c = 0; c < whole.owned_cells(); ++c)
        if (rank_of_cell[c] == rank) {
            local[c] = owned_cells_++;
            global.push_back(c);
        }
    if (owned_cells_ == 0) throw std::invalid_argument("hearth::gas: rank " + std::to_string(rank) + " owns no cell");
    const auto mine = [&](int c) { return rank_of_cell[c] == rank; };
    array<std::pair<int, int>> ghosts;  // rank and cell
    for (int f = 0; f < internal; ++f) {
        const int p = whole.owner[f], q = whole.neighbour[f];
        if (mine(p) != mine(q)) ghosts.push_back({rank_of_cell[mine(p) ? q : p], mine(p) ? q : p});
    }
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    for (const auto& [ghost_owner, c] : ghosts) {
        local[c] = global.count();
        global.push_back(c);
        ghost_rank.push_back(ghost_owner);
    }
    for (const std::int64_t c : global) {
        centre.push_back(whole.centre[c]);
        volume.push_back(whole.volume[c]);
    }

    array<int> point_number(whole.shape.points.count(), -1);
    shape.face_first = {0};
    const auto take = [&](int f, bool turned) {
        const int first = whole.shape.face_first[f], count = whole.shape.face_first[f + 1] - first;
        for (int i = 0; i < count; ++i) {
            const int point = whole.shape.face_points[first + (turned ? count - 1 - i : i)];
            if (point_number[point] < 0) {
                point_number[point] = shape.points.count();
                shape.points.push_back(whole.shape.points[point]);
            }
            shape.face_points.push_back(point_number[point]);
        }
        shape.face_first.push_back(shape.face_points.count());
        area.push_back(turned ? -whole.area[f] : whole.area[f]);
        face_centre.push_back(whole.face_centre[f]);
    };
    for (const shared_face& s : faces_of_share(whole, rank_of_cell, rank)) {
        const bool inside = s.face < internal;
        owner.push_back(local[s.turned ? whole.neighbour[s.face] : whole.owner[s.face]]);
        if (inside) neighbour.push_back(local[s.turned ? whole.owner[s.face] : whole.neighbour[s.face]]);
        take(s.face, s.turned);
    }
    int next = internal_faces();
    for (const patch& p : whole.patches) {
        patches.push_back({p.name, next, 0});
        for (int f = p.first; f < p.first + p.count; ++f) patches.back().count += mine(whole.owner[f]);
        next += patches.back().count;
    }
    const double angle = largest_angle;  // of the whole mesh: all ranks correct in the same way
    compute_weights();
    largest_angle = angle;
    for (auto* vectors : {&shape.points, &area, &face_centre, &centre}) vectors->shrink_to_fit();
    for (auto* numbers : {&shape.face_first, &shape.face_points, &owner, &neighbour}) numbers->shrink_to_fit();
    volume.shrink_to_fit();
    global.shrink_to_fit();
}

}  // namespace hearth::gas
