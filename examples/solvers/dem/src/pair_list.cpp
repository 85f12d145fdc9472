// SPDX-License-Identifier: MIT
#include "pair_list.hpp"

#include <algorithm>

namespace hearth::dem::detail {
namespace {

double squared(double a) { return a * a; }

double squared_distance(const sphere& a, const sphere& b) {
    return squared(a.centre.x - b.centre.x) + squared(a.centre.y - b.centre.y) + squared(a.centre.z - b.centre.z);
}

/// Pairs with the springs that they had.
class recall {
  public:
    recall(pair_list& list, const store& particles, const history& past, const std::vector<index>& old_place,
           bool rolling)
        : list_(list), particles_(particles), past_(past), old_place_(old_place), rolling_(rolling) {}

    void add(index i, index j) {
        if (particles_.ids[static_cast<std::size_t>(j)] < particles_.ids[static_cast<std::size_t>(i)]) std::swap(i, j);
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        if (a >= particles_.owned && b >= particles_.owned) return;
        vector3 spring, roll;
        if (a < particles_.owned) past_.find(old_place_[a], particles_.ids[b], spring, &roll);
        else past_.find(old_place_[b], particles_.ids[a], spring, &roll);
        list_.pairs.push_back({i, j});
        list_.springs.push_back(spring);
        if (rolling_) list_.rolls.push_back(roll);
    }

  private:
    pair_list& list_;
    const store& particles_;
    const history& past_;
    const std::vector<index>& old_place_;
    bool rolling_;
};

}  // namespace

void build_pairs(pair_list& list, const store& particles, const sorted_cells& cells, double reach, const history& past,
                 const std::vector<index>& old_place, bool rolling) {
    list.pairs.clear();
    list.springs.clear();
    list.rolls.clear();
    // What a dense bed of nearly equal spheres needs at a skin of a tenth; growing by doubling would hold twice as much.
    const std::size_t expected = particles.owned * 9 / 2;
    list.pairs.reserve(expected);
    list.springs.reserve(expected);
    if (rolling) list.rolls.reserve(expected);
    recall found(list, particles, past, old_place, rolling);
    std::vector<sphere> placed;  // with ghosts, in the order of cells
    for (const index m : cells.members) placed.push_back(particles.spheres[static_cast<std::size_t>(m)]);
    const bool ghosts = !placed.empty();
    const sphere* const all = ghosts ? placed.data() : particles.spheres.data();
    const std::vector<index>& start = ghosts ? cells.start : cells.owned_start;
    const auto member = [&](index place) { return ghosts ? cells.members[static_cast<std::size_t>(place)] : place; };
    const cell_grid& grid = cells.grid;
    std::vector<index> near;
    std::vector<std::array<index, 2>> runs;

    const auto search = [&](index i) {
        const sphere self = all[i];
        const double touch = self.radius + reach;
        std::size_t count = 0;
        for (const auto& [begin, end] : runs) {
            const index from = std::max(begin, i + 1);
            if (end <= from) continue;
            if (near.size() < count + static_cast<std::size_t>(end - from)) {
                near.resize(2 * (count + static_cast<std::size_t>(end - from)));
            }
            for (index j = from; j < end; ++j) {  // without a branch: most are not near
                near[count] = j;
                count += squared_distance(self, all[j]) < squared(touch + all[j].radius) ? 1u : 0u;
            }
        }
        for (std::size_t k = 0; k < count; ++k) found.add(member(i), member(near[k]));
    };

    for (index z = 0; z < grid.count(2); ++z) {
        for (index y = 0; y < grid.count(1); ++y) {
            for (index x = 0; x < grid.count(0); ++x) {
                const auto cell = static_cast<std::size_t>(grid.number(x, y, z));
                const index first = start[cell], last = start[cell + 1];
                if (first == last) continue;
                runs.clear();
                for_each_run(grid, start, x, y, z, 1, true,
                             [&](index begin, index end) { runs.push_back({begin, end}); });
                for (index i = first; i < last; ++i) search(i);
            }
        }
    }
}

}  // namespace hearth::dem::detail
