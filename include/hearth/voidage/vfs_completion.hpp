// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/voidage/vfs_cells.hpp>
#include <hearth/voidage/vfs_directory.hpp>
#include <hearth/voidage/vfs_log.hpp>
#include <hearth/voidage/vfs_regions.hpp>

namespace hearth::detail {

/// Places what the wave left stuck, without preference for any cell.
///
/// Every stuck cell starts a region.  All regions that still hold more than they have room for grow together, ring by
/// ring of neighbours; regions that reach one cell, or each other, become one.  A region that has room enough rests,
/// until a growing one reaches it.  In the end each region fills all cells behind its front to the threshold, and the
/// cells at its front in proportion to the room that they have.
///
/// Ends: every round of a growing region adds a cell, merges two regions, or finds its connected component exhausted.
/// Work: every cell joins one region once and is advanced over at most once, so linear in the visited cells but for the
/// forest of merged regions.  Exact: sums over regions are exact, so the outcome depends neither on storage, nor on the
/// number of ranks, nor on which way the mesh is mirrored.
/// Complete: a region that exhausts its component leaves what exceeds the capacity of the component.  Where that is
/// round-off it is spread over the component in proportion to volume, else it is an error, with nothing changed.
template <class Graph>
class smoothing_completion {
  public:
    using index = typename Graph::index;
    using mesh_type = smoothing_mesh<Graph>;
    using region_state = region_account::state;
    static constexpr bool is_distributed = mesh_type::is_distributed;

    explicit smoothing_completion(const mesh_type& mesh) : mesh_(mesh) {}

    /// Finds the regions that can hold what is stuck.
    template <class Read>
    void find_room(double threshold, const std::vector<index>& stuck, smoothing_cells& cells, const Read& read) {
        start(threshold, stuck, cells);
        for (rings_ = 0; mesh_.graph().communicator().any(!growing_.empty()); ++rings_) {
            grow(threshold, cells, read);
            settle();
        }
    }

    /// Gives the cells what their regions decided.
    /// Errors: infeasible_volume where a connected component holds more than its capacity times 1 + roundoff.
    void fill(double threshold, double roundoff, smoothing_cells& cells, smoothing_log& log) {
        refuse_excess(threshold, roundoff);
        place_excess(threshold, cells, log);
    }

    /// Adds up the parts of the pools of the log that are on other ranks.
    void reduce_pools(const reproducible_sum& zero, std::vector<reproducible_sum>& sums) {
        if constexpr (is_distributed) directory_.reduce(mesh_.graph().communicator(), pieces_, zero, sums);
    }

    std::size_t memory() const {
        return pieces_.memory() + directory_.memory() + reach_.capacity() * sizeof(region_id) +
               (front_.capacity() + meetings_.capacity()) * sizeof(meetings_[0]) +
               (region_of_.capacity() + growing_.capacity() + reached_.capacity() + changed_.capacity()) * sizeof(index);
    }
    int rings() const { return rings_; }
    std::int64_t visited_cells() const { return static_cast<std::int64_t>(pieces_.members().size()); }

  private:
    /// What a cell can hold more [-].
    static double room(const smoothing_cells& cells, index cell, double threshold) {
        return std::max(0.0, -cells.above(cell, threshold));
    }

    void start(double threshold, const std::vector<index>& stuck, smoothing_cells& cells) {
        const auto& communicator = mesh_.graph().communicator();
        double bound = threshold * mesh_.largest_volume();
        for (const index cell : stuck) bound = std::max(bound, cells.above(cell, threshold) * mesh_.volume(cell));
        bound = std::max(mesh_.largest_volume(), communicator.max(bound));
        const reproducible_sum zero(bound, mesh_.cells_everywhere());
        pieces_.clear(zero);
        region_of_.resize(static_cast<std::size_t>(mesh_.owned()));
        growing_.clear();
        changed_.clear();
        stuck_count_ = stuck.size();
        if constexpr (is_distributed) {
            directory_.clear(communicator.rank(), zero);
            reach_.resize(static_cast<std::size_t>(mesh_.graph().total_count()));
        }
        for (const index cell : stuck) {
            const index region = pieces_.add();
            if constexpr (is_distributed) directory_.found(region);
            visit(cell, region, cells);
            join(cell).excess.add(cells.above(cell, threshold) * mesh_.volume(cell));
            growing_.push_back(region);
        }
        settle();
    }

    /// Says that a cell belongs to a region, before it joins its front.
    void visit(index cell, index region, smoothing_cells& cells) {
        cells.set(cell, smoothing_cells::visited);
        region_of_[static_cast<std::size_t>(cell)] = region;
    }

    /// A cell joins the front of its region; returns the account of that.
    region_account& join(index cell) {
        const index region = pieces_.find(region_of_[static_cast<std::size_t>(cell)]);
        pieces_.append(region, cell);
        if (changed_.empty() || changed_.back() != region) changed_.push_back(region);
        region_account& account = pieces_[region].account;
        account.volume.add(mesh_.volume(cell));
        account.front += 1;
        account.first = std::min(account.first, mesh_.graph().global_index(cell));
        return account;
    }

    template <class Read>
    void grow(double threshold, smoothing_cells& cells, const Read& read) {
        front_.clear();
        for (const index region : growing_) {
            pieces_.advance(region, [&](index cell) { front_.emplace_back(cell, region); });
        }
        const std::size_t owned_count = front_.size();
        if constexpr (is_distributed) add_ghosts(front_);
        for (std::size_t k = 0; k < front_.size(); ++k) {
            mesh_.look_ahead(
                k, owned_count, [&](std::size_t at) { return front_[at].first; },
                [&](index n) {
                    cells.prefetch(n);
                    if (!is_distributed || n < mesh_.owned()) prefetch(&region_of_[static_cast<std::size_t>(n)]);
                });
            const auto [cell, region] = front_[k];
            for (const index n : mesh_.neighbours(cell)) {
                if (n >= mesh_.owned()) continue;  // its owner sees this cell as a ghost
                if (cells.is(n, smoothing_cells::visited)) {
                    const index other = region_of_[static_cast<std::size_t>(n)];
                    if (other != region) meetings_.emplace_back(region, other);
                } else {
                    cells.touch(n, read);
                    visit(n, region, cells);
                    reached_.push_back(n);
                }
            }
        }
        for (const auto& [a, b] : meetings_) {
            if constexpr (is_distributed) {
                directory_.unite(pieces_, a, b);
            } else {
                pieces_.unite(a, b);
            }
        }
        meetings_.clear();
        for (const index cell : reached_) {
            region_account& account = join(cell);
            if (const double free = room(cells, cell, threshold); free > 0) account.free.add(free * mesh_.volume(cell));
        }
        reached_.clear();
    }

    /// Ghosts at the front of growing regions.
    void add_ghosts(std::vector<std::pair<index, index>>& front) {
        for (const auto& [cell, region] : front) reach_[static_cast<std::size_t>(cell)] = directory_.home(region);
        mesh_.graph().halo().gather(reach_.data());
        for (const auto& [cell, region] : front) reach_[static_cast<std::size_t>(cell)] = {};
        for (index ghost = mesh_.owned(); ghost < mesh_.graph().total_count(); ++ghost) {
            const region_id home = reach_[static_cast<std::size_t>(ghost)];
            if (home.rank >= 0) front.emplace_back(ghost, directory_.piece_of(home, pieces_));
        }
    }

    /// Decides which of the regions that grew, or were met by one that did, go on.
    void settle() {
        if constexpr (is_distributed) {
            directory_.settle(mesh_.graph().communicator(), pieces_, changed_, growing_);
        } else {
            for (index& region : growing_) region = pieces_.find(region);
            std::sort(growing_.begin(), growing_.end());
            growing_.erase(std::unique(growing_.begin(), growing_.end()), growing_.end());
            const auto rests = [&](index region) {
                return (pieces_[region].state = pieces_[region].account.decide()) != region_state::growing;
            };
            growing_.erase(std::remove_if(growing_.begin(), growing_.end(), rests), growing_.end());
        }
        changed_.clear();
    }

    /// Visits the accounts of all regions, each on one rank.
    template <class Visit>
    void for_each_region(Visit&& visit) {
        if constexpr (is_distributed) {
            directory_.for_each_region(visit);
        } else {
            for (index p = 0; p < pieces_.size(); ++p) {
                if (pieces_.find(p) == p) visit(pieces_[p].account, pieces_[p].state);
            }
        }
    }

    void refuse_excess(double threshold, double roundoff) {
        std::int64_t component = std::numeric_limits<std::int64_t>::max();
        double capacity = 0;
        double excess = 0;
        for_each_region([&](const region_account& account, region_state state) {
            if (state != region_state::exhausted || account.first > component) return;
            const double holds = threshold * account.volume.value();
            if (!(account.rest() > roundoff * holds)) return;
            component = account.first;
            capacity = holds;
            excess = account.rest();
        });
        // The same error on every rank: that of the component with the smallest index.
        const auto& communicator = mesh_.graph().communicator();
        const std::int64_t smallest = -communicator.max(-component);
        if (smallest == std::numeric_limits<std::int64_t>::max()) return;
        capacity = communicator.max(component == smallest ? capacity : 0);
        excess = communicator.max(component == smallest ? excess : 0);
        throw infeasible_volume(smallest, capacity, excess);
    }

    /// What a region does with its excess.
    struct outcome {
        double placed = 0;   // in cells with room [m^3]
        double share = 0;    // of the room at the front that is taken
        double surplus = 0;  // fraction above the threshold, where the component is exhausted: round-off
        double stays = 0;    // part of the excess that is this surplus; the log leaves it where it was
    };
    static outcome outcome_of(const region_account& account, region_state state) {
        const double excess = account.excess.value();
        const double rest = account.rest();
        if (state == region_state::exhausted) {
            return {account.filled.value(), 0, rest / account.volume.value(), rest / excess};
        }
        const double free = account.free.value();
        return {excess, free > 0 ? rest / free : 0, 0, 0};
    }

    void place_excess(double threshold, smoothing_cells& cells, smoothing_log& log) {
        std::vector<outcome> outcomes(static_cast<std::size_t>(pieces_.size()));
        const auto take = [&](index p, const outcome& result) { outcomes[static_cast<std::size_t>(p)] = result; };
        if constexpr (is_distributed) {
            directory_.template tell<outcome>(mesh_.graph().communicator(), pieces_, outcome_of, take);
        } else {
            for (index p = 0; p < pieces_.size(); ++p) {
                if (pieces_.find(p) == p) take(p, outcome_of(pieces_[p].account, pieces_[p].state));
            }
        }
        std::size_t count = 0;
        for (const region_pieces::member& member : pieces_.members()) {
            const index region = pieces_.find(region_of_[static_cast<std::size_t>(member.cell)]);
            const outcome& result = outcomes[static_cast<std::size_t>(region)];
            const double before = cells.fraction(member.cell);
            const double taken = room(cells, member.cell, threshold) * (member.at_front ? result.share : 1);
            if (count++ < stuck_count_) {
                const double kept = threshold + cells.above(member.cell, threshold) * result.stays;
                log.append_giving(member.cell, region, kept / before);
            } else if (taken > 0) {
                log.append_receiving(member.cell, region, taken * mesh_.volume(member.cell) / result.placed);
            }
            const double after = member.at_front ? std::min(threshold, before + taken) : threshold;
            cells.set_fraction(member.cell, after + result.surplus);
        }
        log.set_pools(pieces_.size());
    }

    const mesh_type& mesh_;
    region_pieces pieces_;
    std::vector<index> region_of_;  // of visited cells
    std::vector<index> growing_;
    std::vector<std::pair<index, index>> front_;  // cells, and the region of each
    std::vector<std::pair<index, index>> meetings_;
    std::vector<index> reached_;
    std::vector<index> changed_;  // regions with new cells
    std::size_t stuck_count_ = 0;
    int rings_ = 0;
    region_directory<typename Graph::communicator_type> directory_;  // distributed only, as is the next
    std::vector<region_id> reach_;
};

}  // namespace hearth::detail
