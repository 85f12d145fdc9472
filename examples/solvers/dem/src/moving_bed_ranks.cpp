// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <hearth/dem/moving_bed.hpp>

namespace hearth::dem {

/// Slabs with as many particles each, and the ghosts of this one.
void moving_bed::divide() {
    const std::size_t n = all_.spheres.size();
    owned_ = static_cast<index>(n);
    if (!is_shared()) return;
    const auto coordinate = [&](std::size_t i) { return all_.spheres[i].centre[spread_.axis]; };
    std::vector<std::pair<double, index>> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = {coordinate(i), static_cast<index>(i)};
    std::sort(order.begin(), order.end());
    const auto count = static_cast<std::size_t>(among().size());
    const int me = among().rank();
    owners_.resize(n);
    for (std::size_t k = 0; k < n; ++k)
        owners_[static_cast<std::size_t>(order[k].second)] = static_cast<int>(k * count / n);
    std::vector<index> held(count, 0);
    places_.resize(n);
    for (std::size_t i = 0; i < n; ++i) places_[i] = held[static_cast<std::size_t>(owners_[i])]++;
    owned_ = held[static_cast<std::size_t>(me)];

    mine_ = {};
    ghost_owners_.clear();
    const auto add = [&](std::size_t i) {
        mine_.spheres.push_back(all_.spheres[i]);
        mine_.masses.push_back(all_.masses[i]);
        mine_.ids.push_back(all_.ids[i]);
    };
    double low = std::numeric_limits<double>::infinity(), high = -low, largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        largest = std::fmax(largest, all_.spheres[i].radius);
        if (owners_[i] != me) continue;
        add(i);
        low = std::fmin(low, coordinate(i));
        high = std::fmax(high, coordinate(i));
    }
    const double reach = std::fmax(1.0, spread_.near_factor) * 2 * largest;
    for (std::size_t i = 0; i < n; ++i) {
        if (owners_[i] == me || coordinate(i) < low - reach || coordinate(i) > high + reach) continue;
        add(i);
        ghost_owners_.push_back(owners_[i]);
    }
}

/// After a move: what of it concerns this rank, whose share is made anew.
passage moving_bed::part_of(const passage& whole) {
    std::vector<int> owners;
    std::vector<index> places;
    owners.swap(owners_);
    places.swap(places_);
    divide();
    const auto ranks = static_cast<std::size_t>(among().size());
    const int me = among().rank();
    passage mine;
    mine.mass_in = whole.mass_in;
    mine.mass_out = whole.mass_out;
    mine.over_ranks.among = spread_.among;
    std::vector<std::vector<index>> sent(ranks), got(ranks);
    for (std::size_t i = 0; i < whole.origin.size(); ++i) {
        const index before = whole.origin[i];
        const auto from = static_cast<std::size_t>(before);
        const int now = owners_[i], owner = before == passage::fed ? now : owners[from];
        if (now == me) {
            mine.origin.push_back(before == passage::fed ? before
                                  : owner == me          ? places[from]
                                                         : passage::from_another_rank);
            if (owner != me) got[static_cast<std::size_t>(owner)].push_back(places_[i]);
        } else if (owner == me) {
            sent[static_cast<std::size_t>(now)].push_back(places[from]);
        }
    }
    const auto join = [&](const std::vector<std::vector<index>>& parts, std::vector<index>& all,
                          std::vector<link>& links) {
        for (std::size_t r = 0; r < ranks; ++r) {
            if (parts[r].empty()) continue;
            links.push_back({static_cast<int>(r), all.size(), all.size() + parts[r].size()});
            all.insert(all.end(), parts[r].begin(), parts[r].end());
        }
    };
    join(sent, mine.over_ranks.sent, mine.over_ranks.exports);
    join(got, mine.over_ranks.got, mine.over_ranks.imports);
    for (const passage::leaver& l : whole.left) {
        const auto from = static_cast<std::size_t>(l.from);
        const bool passed_through = l.from == passage::fed;
        if ((passed_through ? 0 : owners[from]) == me)
            mine.left.push_back({passed_through ? l.from : places[from], l.id, l.mass});
    }
    return mine;
}

}  // namespace hearth::dem
