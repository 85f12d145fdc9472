// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <hearth/core/reproducible_sum.hpp>

namespace hearth::detail {

/// The volumes of one region of the completion [m^3].  All sums are exact, so that regions may merge in any order.
struct region_account {
    explicit region_account(const reproducible_sum& zero = {1, 1}) : excess(zero), filled(zero), free(zero), volume(zero) {}

    reproducible_sum excess;  ///< what its stuck cells hold above the threshold
    reproducible_sum filled;  ///< what the cells behind its front take: all that they can hold
    reproducible_sum free;    ///< what the cells at its front can hold
    reproducible_sum volume;  ///< of all its cells
    std::int64_t front = 0;   ///< cells at its front
    std::int64_t first = std::numeric_limits<std::int64_t>::max();  ///< smallest global index of its cells

    enum class state : std::int8_t {
        growing,   ///< needs another ring
        settled,   ///< its front can hold what is left
        exhausted  ///< fills its connected component and still has some left
    };

    void add(const region_account& other) {
        excess.add(other.excess);
        filled.add(other.filled);
        free.add(other.free);
        volume.add(other.volume);
        front += other.front;
        first = std::min(first, other.first);
    }

    /// What its front has to take.
    double rest() const {
        reproducible_sum difference = excess;
        difference.subtract(filled);
        return difference.value();
    }

    /// After a ring was added: does it hold enough?  Where not, the front is filled and becomes the inside.
    state decide() {
        if (rest() <= free.value()) return state::settled;
        if (front == 0) return state::exhausted;
        filled.add(free);
        free.clear();
        front = 0;
        return state::growing;
    }
};

/// Regions as this rank sees them: a forest of merged pieces, each with the chain of its cells at the front.
class region_pieces {
  public:
    using index = std::int32_t;

    struct piece {
        index parent;
        index head = -1;
        index tail = -1;
        region_account account;  // serial: of the region; distributed: what its home has not yet been told
        region_account::state state = region_account::state::growing;
    };
    /// A cell of a region, in the order in which they were reached.
    struct member {
        index cell;
        index next;
        bool at_front;
    };

    void clear(const reproducible_sum& zero) {
        zero_ = zero;
        pieces_.clear();
        members_.clear();
    }

    index add() {
        pieces_.push_back({size(), -1, -1, region_account(zero_)});
        return size() - 1;
    }
    index size() const { return static_cast<index>(pieces_.size()); }
    piece& operator[](index p) { return pieces_[static_cast<std::size_t>(p)]; }
    const piece& operator[](index p) const { return pieces_[static_cast<std::size_t>(p)]; }

    /// The piece that stands for all that were merged with p.
    index find(index p) {
        while ((*this)[p].parent != p) p = (*this)[p].parent = (*this)[(*this)[p].parent].parent;
        return p;
    }

    /// Merges two regions; one that grows makes the other grow.
    void unite(index a, index b) {
        a = find(a);
        b = find(b);
        if (a == b) return;
        if (a > b) std::swap(a, b);
        piece& left = (*this)[a];
        piece& right = (*this)[b];
        right.parent = a;
        left.account.add(right.account);
        if (right.state == region_account::state::growing) left.state = right.state;
        if (right.head < 0) return;
        if (left.head < 0) {
            left.head = right.head;
        } else {
            members_[static_cast<std::size_t>(left.tail)].next = right.head;
        }
        left.tail = right.tail;
    }

    /// Puts a cell at the front of a region, of which p is the piece that stands for all.
    void append(index p, index cell) {
        piece& root = (*this)[p];
        const auto at = static_cast<index>(members_.size());
        members_.push_back({cell, -1, true});
        if (root.head < 0) {
            root.head = at;
        } else {
            members_[static_cast<std::size_t>(root.tail)].next = at;
        }
        root.tail = at;
    }

    /// Visits the cells at the front of a region, which from here on are its inside.
    template <class Visit>
    void advance(index p, Visit&& visit) {
        piece& root = (*this)[p];
        for (index m = root.head; m >= 0; m = members_[static_cast<std::size_t>(m)].next) {
            members_[static_cast<std::size_t>(m)].at_front = false;
            visit(members_[static_cast<std::size_t>(m)].cell);
        }
        root.head = root.tail = -1;
    }

    const std::vector<member>& members() const { return members_; }

    std::size_t memory() const {
        return pieces_.capacity() * sizeof(piece) + members_.capacity() * sizeof(member);
    }

  private:
    reproducible_sum zero_{1, 1};
    std::vector<piece> pieces_;
    std::vector<member> members_;
};

}  // namespace hearth::detail
