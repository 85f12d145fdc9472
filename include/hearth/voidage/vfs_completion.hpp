// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/voidage/vfs_cells.hpp>
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

    int rings() const { return rings_; }
    std::int64_t visited_cells() const { return static_cast<std::int64_t>(pieces_.members().size()); }

  private:
    static double excess(const smoothing_cells::state& s, double threshold) {
        return (s.value - threshold) + static_cast<double>(s.rest);
    }

    void start(double threshold, const std::vector<index>& stuck, smoothing_cells& cells) {
        double bound = threshold * mesh_.largest_volume();
        for (const index cell : stuck) bound = std::max(bound, excess(cells[cell], threshold) * mesh_.volume(cell));
        bound = std::max(mesh_.largest_volume(), mesh_.graph().communicator().max(bound));
        pieces_.clear(reproducible_sum(bound, mesh_.cells_everywhere()));
        region_of_.resize(static_cast<std::size_t>(mesh_.owned()));
        growing_.clear();
        stuck_count_ = stuck.size();
        for (const index cell : stuck) {
            const index region = pieces_.add();
            pieces_[region].account.excess.add(excess(cells[cell], threshold) * mesh_.volume(cell));
            join(cell, region, cells);
            growing_.push_back(region);
        }
        settle();
    }

    /// A cell joins the front of a region.
    void join(index cell, index region, smoothing_cells& cells) {
        cells.set(cells[cell], smoothing_cells::visited);
        region_of_[static_cast<std::size_t>(cell)] = region;
        pieces_.append(region, cell);
        region_account& account = pieces_[pieces_.find(region)].account;
        account.volume.add(mesh_.volume(cell));
        account.front += 1;
        account.first = std::min(account.first, mesh_.graph().global_index(cell));
    }

    static double room(const smoothing_cells::state& s, double threshold) { return std::max(0.0, -excess(s, threshold)); }

    template <class Read>
    void grow(double threshold, smoothing_cells& cells, const Read& read) {
        for (const index region : growing_) {
            pieces_.advance(region, [&](index cell) {
                for (const index n : mesh_.neighbours(cell)) {
                    if (cells.is(cells[n], smoothing_cells::visited)) {
                        const index other = region_of_[static_cast<std::size_t>(n)];
                        if (other != region) meetings_.emplace_back(region, other);
                    } else {
                        cells.touch(n, read);
                        cells.set(cells[n], smoothing_cells::visited);
                        region_of_[static_cast<std::size_t>(n)] = region;
                        reached_.push_back(n);
                    }
                }
            });
        }
        for (const auto& [a, b] : meetings_) pieces_.unite(a, b);
        meetings_.clear();
        for (const index cell : reached_) {
            const index region = region_of_[static_cast<std::size_t>(cell)];
            join(cell, region, cells);
            pieces_[pieces_.find(region)].account.free.add(room(cells[cell], threshold) * mesh_.volume(cell));
        }
        reached_.clear();
    }

    /// Decides which of the regions that grew, or were met by one that did, go on.
    void settle() {
        for (index& region : growing_) region = pieces_.find(region);
        std::sort(growing_.begin(), growing_.end());
        growing_.erase(std::unique(growing_.begin(), growing_.end()), growing_.end());
        const auto rests = [&](index region) {
            return (pieces_[region].state = pieces_[region].account.decide()) != region_state::growing;
        };
        growing_.erase(std::remove_if(growing_.begin(), growing_.end(), rests), growing_.end());
    }

    void refuse_excess(double threshold, double roundoff) {
        for (index p = 0; p < pieces_.size(); ++p) {
            if (pieces_.find(p) != p || pieces_[p].state != region_state::exhausted) continue;
            const region_account& account = pieces_[p].account;
            const double capacity = threshold * account.volume.value();
            if (account.rest() > roundoff * capacity) {
                throw infeasible_volume(account.first, capacity, account.rest());
            }
        }
    }

    void place_excess(double threshold, smoothing_cells& cells, smoothing_log& log) {
        struct outcome {
            double excess;   // of the region [m^3]
            double share;    // of the room at the front that is taken
            double surplus;  // fraction above the threshold, where the component is exhausted: round-off
        };
        std::vector<outcome> outcomes(static_cast<std::size_t>(pieces_.size()));
        for (index p = 0; p < pieces_.size(); ++p) {
            if (pieces_.find(p) != p) continue;
            const region_account& account = pieces_[p].account;
            const double rest = account.rest();
            const double free = account.free.value();
            const bool exhausted = pieces_[p].state == region_state::exhausted;
            outcomes[static_cast<std::size_t>(p)] = {account.excess.value(), free > 0 ? rest / free : 0,
                                                     exhausted ? rest / account.volume.value() : 0};
        }
        std::size_t count = 0;
        for (const region_pieces::member& member : pieces_.members()) {
            const index region = pieces_.find(region_of_[static_cast<std::size_t>(member.cell)]);
            const outcome& result = outcomes[static_cast<std::size_t>(region)];
            smoothing_cells::state& s = cells[member.cell];
            const double before = s.value;
            const double taken = room(s, threshold) * (member.at_front ? result.share : 1) + result.surplus;
            s.value = member.at_front ? std::min(threshold, before + (static_cast<double>(s.rest) + taken)) : threshold + result.surplus;
            s.rest = 0;
            if (count++ < stuck_count_) {
                log.giving.push_back({member.cell, region, s.value / before});
            } else if (taken > 0) {
                log.receiving.push_back({member.cell, region, taken * mesh_.volume(member.cell) / result.excess});
            }
        }
        log.pools = pieces_.size();
    }

    const mesh_type& mesh_;
    region_pieces pieces_;
    std::vector<index> region_of_;  // of visited cells
    std::vector<index> growing_;
    std::vector<std::pair<index, index>> meetings_;
    std::vector<index> reached_;
    std::size_t stuck_count_ = 0;
    int rings_ = 0;
};

}  // namespace hearth::detail
