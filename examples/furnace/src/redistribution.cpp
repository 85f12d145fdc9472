// SPDX-License-Identifier: MIT
#include "redistribution.hpp"

#include <string>
#include <utility>

#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

namespace {

void require(bool good, std::size_t part) {
    if (!good) throw bad_scene("the state of rank " + std::to_string(part) + " does not fit the mesh");
}

}  // namespace

redistribution::redistribution(gas::mesh whole, int before, int now, int rank) : whole_(std::move(whole)) {
    if (before < 1 || before > whole_.cells()) throw bad_scene("the state is of " + std::to_string(before) + " ranks");
    const gas::array<int> rank_before = gas::partition(whole_, before);
    for (int r = 0; r < before; ++r) before_.push_back(share_of(rank_before, r));
    now_ = share_of(gas::partition(whole_, now), rank);
}

redistribution::share redistribution::share_of(const gas::array<int>& rank_of_cell, int rank) const {
    share s;
    const gas::mesh piece(whole_, rank_of_cell, rank);
    s.own = static_cast<std::size_t>(piece.owned_cells());
    s.cells.assign(piece.global.begin(), piece.global.end());
    s.faces = gas::faces_of_share(whole_, rank_of_cell, rank);
    s.internal = static_cast<std::size_t>(piece.internal_faces());
    return s;
}

std::vector<double> redistribution::of_cells(const parts& saved) const {
    require(saved.size() == before_.size(), saved.size());
    const std::size_t width = saved.front().size() / before_.front().cells.size();
    std::vector<double> all(width * static_cast<std::size_t>(whole_.cells())), here;
    for (std::size_t r = 0; r < saved.size(); ++r) {
        require(saved[r].size() == width * before_[r].cells.size(), r);
        for (std::size_t c = 0; c < before_[r].own; ++c) {
            for (std::size_t k = 0; k < width; ++k) all[width * before_[r].cells[c] + k] = saved[r][width * c + k];
        }
    }
    for (const std::size_t cell : now_.cells) {
        for (std::size_t k = 0; k < width; ++k) here.push_back(all[width * cell + k]);
    }
    return here;
}

std::vector<double> redistribution::of_faces_from(const parts& saved, bool boundary) const {
    require(saved.size() == before_.size(), saved.size());
    std::vector<double> all(static_cast<std::size_t>(whole_.faces())), here;
    const auto first = [&](const share& s) { return boundary ? s.internal : std::size_t{0}; };
    const auto sign = [](const gas::shared_face& f) { return f.turned ? -1.0 : 1.0; };
    for (std::size_t r = 0; r < saved.size(); ++r) {
        const share& s = before_[r];
        require(saved[r].size() == s.faces.size() - first(s), r);
        for (std::size_t k = first(s); k < s.faces.size(); ++k) {
            all[static_cast<std::size_t>(s.faces[k].face)] = sign(s.faces[k]) * saved[r][k - first(s)];
        }
    }
    for (std::size_t k = first(now_); k < now_.faces.size(); ++k) {
        here.push_back(sign(now_.faces[k]) * all[static_cast<std::size_t>(now_.faces[k].face)]);
    }
    return here;
}

std::vector<double> redistribution::of_faces(const parts& saved) const { return of_faces_from(saved, false); }
std::vector<double> redistribution::of_boundary(const parts& saved) const { return of_faces_from(saved, true); }

}  // namespace hearth::furnace
