// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <hearth/core/communicator.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/voidage/vfs_regions.hpp>

namespace hearth::detail {

/// Where the record of a region lives: the rank of the stuck cell that started it, and a number there.
struct region_id {
    std::int32_t rank = -1;
    std::int32_t number = -1;

    friend bool operator<(region_id a, region_id b) {
        return a.rank != b.rank ? a.rank < b.rank : a.number < b.number;
    }
    friend bool operator==(region_id a, region_id b) { return a.rank == b.rank && a.number == b.number; }
};

/// Regions of the completion that span ranks.  Each has a record on one rank, its home, which sums, decides, and tells
/// all pieces of the region.  A rank knows its own pieces and the records that live on it, no others.
/// Calls that take a communicator are made by all ranks together.
template <class Communicator>
class region_directory {
  public:
    using index = std::int32_t;

    void clear(int rank, const reproducible_sum& zero) {
        rank_ = rank;
        zero_ = zero;
        records_.clear();
        active_.clear();
        homes_.clear();
        piece_of_.clear();
    }

    /// The piece of a new region, which has its home here.
    void found(index piece) {
        const region_id home{rank_, static_cast<index>(records_.size())};
        records_.push_back({home, region_account(zero_), region_account::state::growing, {{rank_, piece}}});
        active_.push_back(home.number);
        piece_of_.emplace(home, piece);
        homes_.push_back(home);
    }

    region_id home(index piece) const { return homes_[static_cast<std::size_t>(piece)]; }

    /// The piece here of a region that reaches here from another rank.
    index piece_of(region_id home, region_pieces& pieces) {
        const auto [known, fresh] = piece_of_.emplace(home, pieces.size());
        if (!fresh) return pieces.find(known->second);
        notes_.push_back({home, note::subscribe, {}, {rank_, pieces.add()}, false, region_account(zero_)});
        homes_.push_back(home);
        return known->second;
    }

    /// Merges two regions of which pieces meet here.
    void unite(region_pieces& pieces, index a, index b) {
        const region_id left = home(pieces.find(a));
        const region_id right = home(pieces.find(b));
        if (!(left == right)) notes_.push_back({left, note::join, right, {}, false, region_account(zero_)});
        pieces.unite(a, b);
    }

    /// Brings what changed pieces have gathered to the homes; these decide which regions go on, and tell the pieces.
    void settle(const Communicator& communicator, region_pieces& pieces, const std::vector<index>& changed,
                std::vector<index>& growing) {
        for (const index p : changed) {
            region_account& account = pieces[pieces.find(p)].account;
            if (account.front == 0) continue;
            notes_.push_back({home(pieces.find(p)), note::deposit, {}, {}, false, account});
            account = region_account(zero_);
        }
        deliver(communicator);

        const auto decided = [&](index number) {
            record& region = records_[static_cast<std::size_t>(number)];
            if (is_root(number)) region.state = region.account.decide();
            return is_root(number);
        };
        active_.erase(std::stable_partition(active_.begin(), active_.end(), decided), active_.end());
        growing.clear();
        struct verdict {
            region_id home;
            region_account::state state;
        };
        publish<verdict>(
            communicator, pieces, active_,
            [&](index number) { return verdict{{rank_, number}, records_[static_cast<std::size_t>(number)].state}; },
            [&](index piece, const verdict& news) {
                const auto [same, fresh] = piece_of_.emplace(news.home, piece);
                if (!fresh) pieces.unite(same->second, piece);
                const index root = pieces.find(piece);
                homes_[static_cast<std::size_t>(root)] = news.home;
                pieces[root].state = news.state;
                if (news.state == region_account::state::growing) growing.push_back(root);
            });
        for (index& piece : growing) piece = pieces.find(piece);
        std::sort(growing.begin(), growing.end());
        growing.erase(std::unique(growing.begin(), growing.end()), growing.end());
        const auto rests = [&](index number) {
            return records_[static_cast<std::size_t>(number)].state != region_account::state::growing;
        };
        active_.erase(std::remove_if(active_.begin(), active_.end(), rests), active_.end());
    }

    /// Visits the records here of all regions: visit(account, state).
    template <class Visit>
    void for_each_region(Visit&& visit) const {
        for (const index number : roots()) {
            const record& region = records_[static_cast<std::size_t>(number)];
            visit(region.account, region.state);
        }
    }

    /// Tells every piece what its home makes of the account of the region: take(piece, make(account, state)).
    template <class Result, class Make, class Take>
    void tell(const Communicator& communicator, region_pieces& pieces, Make&& make, Take&& take) const {
        publish<Result>(
            communicator, pieces, roots(),
            [&](index number) {
                const record& region = records_[static_cast<std::size_t>(number)];
                return make(region.account, region.state);
            },
            take);
    }

    /// Adds sums of pieces over their regions.
    void reduce(const Communicator& communicator, region_pieces& pieces, const reproducible_sum& zero,
                std::vector<reproducible_sum>& sums) const {
        struct part {
            index number = 0;
            reproducible_sum sum{1, 1};
        };
        std::vector<parcel<part>> outgoing;
        for (index p = 0; p < pieces.size(); ++p) {
            if (pieces.find(p) != p) continue;
            const region_id to = home(p);
            box(outgoing, to.rank).push_back({to.number, sums[static_cast<std::size_t>(p)]});
        }
        std::vector<reproducible_sum> totals(records_.size(), zero);
        for (const auto& from : communicator.exchange(std::move(outgoing))) {
            for (const part& p : from.values) totals[static_cast<std::size_t>(p.number)].add(p.sum);
        }
        publish<part>(
            communicator, pieces, roots(),
            [&](index number) { return part{number, totals[static_cast<std::size_t>(number)]}; },
            [&](index piece, const part& total) { sums[static_cast<std::size_t>(piece)] = total.sum; });
    }

    std::size_t memory() const {
        std::size_t addresses = 0;
        for (const record& region : records_) addresses += region.pieces.capacity();
        return records_.capacity() * sizeof(record) + addresses * sizeof(address) + notes_.capacity() * sizeof(note) +
               (homes_.capacity() + piece_of_.size()) * sizeof(region_id);
    }

  private:
    struct address {
        std::int32_t rank = -1;
        index piece = -1;
    };
    struct record {
        region_id parent;  // itself, or the region that this one was merged into
        region_account account;
        region_account::state state;
        std::vector<address> pieces;
    };
    /// What travels to the home of a region, and on from there if that was merged.
    struct note {
        enum kind_type : std::int32_t { join, deposit, subscribe };
        region_id target;
        kind_type kind = join;
        region_id other;  // join
        address piece;    // subscribe
        bool growing = false;
        region_account account;  // deposit
    };

    bool is_root(index number) const {
        return records_[static_cast<std::size_t>(number)].parent == region_id{rank_, number};
    }
    std::vector<index> roots() const {
        std::vector<index> result;
        for (index number = 0; number < static_cast<index>(records_.size()); ++number) {
            if (is_root(number)) result.push_back(number);
        }
        return result;
    }

    /// The values for one rank.
    template <class Value>
    static std::vector<Value>& box(std::vector<parcel<Value>>& boxes, int rank) {
        for (auto& b : boxes) {
            if (b.rank == rank) return b.values;
        }
        boxes.push_back({rank, {}});
        return boxes.back().values;
    }

    /// Handles notes until none is under way.
    void deliver(const Communicator& communicator) {
        for (;;) {
            std::vector<parcel<note>> outgoing;
            while (!notes_.empty()) {
                const note news = notes_.back();
                notes_.pop_back();
                if (news.target.rank == rank_) {
                    handle(news);
                } else {
                    box(outgoing, news.target.rank).push_back(news);
                }
            }
            if (!communicator.any(!outgoing.empty())) return;
            for (const auto& from : communicator.exchange(std::move(outgoing))) {
                notes_.insert(notes_.end(), from.values.begin(), from.values.end());
            }
        }
    }

    void handle(note news) {
        record& region = records_[static_cast<std::size_t>(news.target.number)];
        if (!(region.parent == news.target)) {
            news.target = region.parent;
            notes_.push_back(news);
            return;
        }
        switch (news.kind) {
            case note::deposit:
                region.account.add(news.account);
                if (news.growing && region.state != region_account::state::growing) {
                    region.state = region_account::state::growing;
                    active_.push_back(news.target.number);
                }
                break;
            case note::subscribe:
                region.pieces.push_back(news.piece);
                break;
            case note::join:
                if (news.other == news.target) break;
                if (news.target < news.other) {  // the larger id joins the smaller, so that no circle can arise
                    std::swap(news.target, news.other);
                    notes_.push_back(news);
                    break;
                }
                region.parent = news.other;
                for (const address& piece : region.pieces) {
                    notes_.push_back({news.other, note::subscribe, {}, piece, false, region_account(zero_)});
                }
                region.pieces.clear();
                notes_.push_back({news.other, note::deposit, {}, {}, region.state == region_account::state::growing,
                                  region.account});
        }
    }

    /// Sends each piece of some regions here what make(number) says, and takes what comes: take(piece, result).
    template <class Result, class Make, class Take>
    void publish(const Communicator& communicator, region_pieces& pieces, const std::vector<index>& numbers, Make&& make,
                 Take&& take) const {
        struct message {
            index piece = 0;
            Result result;
        };
        std::vector<parcel<message>> outgoing;
        for (const index number : numbers) {
            const Result result = make(number);
            for (const address& to : records_[static_cast<std::size_t>(number)].pieces) {
                box(outgoing, to.rank).push_back({to.piece, result});
            }
        }
        for (const auto& from : communicator.exchange(std::move(outgoing))) {
            for (const message& news : from.values) take(pieces.find(news.piece), news.result);
        }
    }

    int rank_ = 0;
    reproducible_sum zero_{1, 1};
    std::vector<record> records_;              // of regions that started here
    std::vector<index> active_;                // records that grow
    std::vector<region_id> homes_;             // of the pieces here, as last told
    std::map<region_id, index> piece_of_;
    std::vector<note> notes_;
};

}  // namespace hearth::detail
