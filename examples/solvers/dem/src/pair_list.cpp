// SPDX-License-Identifier: MIT
#include "pair_list.hpp"

#include <algorithm>

namespace hearth::dem::detail {
namespace {

double squared(double a) { return a * a; }

double squared_distance(const sphere& a, const sphere& b) {
    return squared(a.centre.x - b.centre.x) + squared(a.centre.y - b.centre.y) + squared(a.centre.z - b.centre.z);
}

/// Springs of pairs that touched when the forces were computed last.
class recall {
  public:
    recall(pair_list& list, const store& particles, const history& past, const std::vector<index>& old_place,
           bool rolling)
        : list_(list), particles_(particles), past_(past), old_place_(old_place), rolling_(rolling) {}

    void add(index i, index j) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const std::int64_t id_i = particles_.ids[a], id_j = particles_.ids[b];
        const bool ghost = b >= particles_.owned;
        vector3 spring, roll;
        const sphere &one = particles_.spheres[a], &other = particles_.spheres[b];
        if (squared_distance(one, other) < squared(one.radius + other.radius)) {
            if (!past_.find(old_place_[a], id_j, spring, &roll) && !ghost) {
                past_.find(old_place_[b], id_i, spring, &roll);
            }
        }
        const bool swapped = id_j < id_i;
        if (swapped && !ghost) {
            spring = -spring;
            roll = -roll;
        }
        list_.pairs.push_back(swapped && ghost ? bed::pair{j, i} : bed::pair{i, j});
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
    const sphere* const all = particles.spheres.data();
    const auto owned = static_cast<index>(particles.owned);
    const cell_grid& grid = cells.grid;
    std::vector<index> near;
    std::vector<std::array<index, 2>> runs;

    const auto search = [&](index i, index skip_to) {
        const sphere self = all[i];
        const double touch = self.radius + reach;
        std::size_t count = 0;
        for (const auto& [begin, end] : runs) {
            const index from = std::max(begin, skip_to);
            if (end <= from) continue;
            if (near.size() < count + static_cast<std::size_t>(end - from)) {
                near.resize(2 * (count + static_cast<std::size_t>(end - from)));
            }
            for (index j = from; j < end; ++j) {  // without a branch: most are not near
                near[count] = j;
                count += squared_distance(self, all[j]) < squared(touch + all[j].radius) ? 1u : 0u;
            }
        }
        for (std::size_t k = 0; k < count; ++k) found.add(i, near[k]);
    };

    for (index z = 0; z < grid.count(2); ++z) {
        for (index y = 0; y < grid.count(1); ++y) {
            for (index x = 0; x < grid.count(0); ++x) {
                const auto cell = static_cast<std::size_t>(grid.number(x, y, z));
                const index first = cells.owned_start[cell], last = cells.owned_start[cell + 1];
                if (first == last) continue;
                runs.clear();
                for_each_run(grid, cells.owned_start, x, y, z, 1, true,
                             [&](index begin, index end) { runs.push_back({begin, end}); });
                if (!cells.ghost_start.empty()) {
                    for_each_run(grid, cells.ghost_start, x, y, z, 1, false, [&](index begin, index end) {
                        runs.push_back({owned + begin, owned + end});
                    });
                }
                for (index i = first; i < last; ++i) search(i, i + 1);
            }
        }
    }
}

}  // namespace hearth::dem::detail
