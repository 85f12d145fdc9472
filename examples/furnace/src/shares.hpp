// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <hearth/dem/particles.hpp>
#include <hearth/furnace/ranks.hpp>

#include "wall_rings.hpp"

namespace hearth::furnace {

/// Which rank works on which parcels and rings of the wall.  Where the parcels are and how hot they are, every rank knows of
/// all; the work on them is cut into slabs over the height, with as many parcels each, in the same way on every rank.
class shares {
  public:
    explicit shares(ranks among) : among_(std::move(among)) {}

    /// To be called when parcels have moved.  Nobody works on those from the height `top` on.
    void cut(const std::vector<dem::sphere>& parcels, const wall_rings& rings, double top) {
        const auto size = static_cast<std::size_t>(among_.size());
        const auto z = [&](std::int32_t i) { return parcels[static_cast<std::size_t>(i)].centre.z; };
        std::vector<std::int32_t> upwards;
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(parcels.size()); ++i) {
            if (z(i) < top) upwards.push_back(i);
        }
        const std::size_t count = upwards.size();
        const auto below = [&](std::int32_t a, std::int32_t b) { return z(a) != z(b) ? z(a) < z(b) : a < b; };
        if (size > 1) std::sort(upwards.begin(), upwards.end(), below);
        owner_.assign(parcels.size(), nobody);
        ring_owner_.assign(rings.size(), 0);
        order_.clear();
        for (std::size_t r = 0; r < size; ++r) {
            const auto from = static_cast<std::ptrdiff_t>(r * count / size), to = static_cast<std::ptrdiff_t>((r + 1) * count / size);
            std::vector<std::int32_t> own(upwards.begin() + from, upwards.begin() + to);
            std::sort(own.begin(), own.end());
            for (const std::int32_t i : own) owner_[static_cast<std::size_t>(i)] = static_cast<int>(r);
            if (r > 0 && from < to) {
                const double lowest = z(upwards[static_cast<std::size_t>(from)]);
                for (std::size_t k = 0; k < rings.size(); ++k) {
                    if (rings.middle(k) >= lowest) ring_owner_[k] = static_cast<int>(r);
                }
            }
            order_.insert(order_.end(), own.begin(), own.end());
            if (static_cast<int>(r) == among_.rank()) mine_ = std::move(own);
        }
    }

    const ranks& among() const { return among_; }
    /// Parcels of this rank, rising.
    const std::vector<std::int32_t>& mine() const { return mine_; }
    int owner(std::int32_t parcel) const { return owner_[static_cast<std::size_t>(parcel)]; }
    int ring_owner(std::size_t ring) const { return ring_owner_[ring]; }
    bool is_anybodys(std::int32_t parcel) const { return owner(parcel) != nobody; }
    bool is_mine(std::int32_t parcel) const { return owner(parcel) == among_.rank(); }
    bool is_my_ring(std::size_t ring) const { return ring_owner(ring) == among_.rank(); }

    /// Values of this rank's parcels, from those of all.
    template <class Value>
    std::vector<Value> pick(const std::vector<Value>& of_all) const {
        std::vector<Value> own;
        own.reserve(mine_.size());
        for (const std::int32_t i : mine_) own.push_back(of_all[static_cast<std::size_t>(i)]);
        return own;
    }
    /// Puts the values of each rank's own parcels among those of all, on every rank.
    template <class Value>
    void gather(const std::vector<Value>& own, std::vector<Value>& all) const {
        const std::vector<Value> in_order = among_.gather(own);
        for (std::size_t k = 0; k < order_.size(); ++k) all[static_cast<std::size_t>(order_[k])] = in_order[k];
    }

  private:
    static constexpr int nobody = -1;

    ranks among_;
    std::vector<std::int32_t> mine_, order_;  // order_: the parcels of rank 0, of rank 1, ...
    std::vector<int> owner_, ring_owner_;
};

}  // namespace hearth::furnace
