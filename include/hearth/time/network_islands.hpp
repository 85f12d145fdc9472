// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <hearth/core/particle_halo.hpp>
#include <hearth/core/reproducible_sum.hpp>

namespace hearth::detail {

/// Sum of one number from each rank; the same bits on all of them.
template <class Communicator>
double sum_over_ranks(const Communicator& communicator, double mine) {
    if constexpr (Communicator::is_distributed) {
        reproducible_sum total(communicator.max(std::fabs(mine)), communicator.size());
        total.add(mine);
        communicator.sum(total.limbs(), reproducible_sum::limb_count());
        return total.value();
    } else {
        return mine;
    }
}

/// The connected parts of a graph of particles, numbered in order of their first member.  Parts that reach over ranks
/// are known by their least id, and their sums are taken over all ranks.
class islands {
  public:
    /// Begins with every particle alone.
    void reset(std::size_t count) {
        label_.resize(count);
        for (std::size_t i = 0; i < count; ++i) label_[i] = static_cast<std::int32_t>(i);
    }
    void join(std::int32_t i, std::int32_t j) {
        if (label_[static_cast<std::size_t>(i)] == label_[static_cast<std::size_t>(j)]) return;
        const std::int32_t a = root(i), b = root(j);
        label_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

    /// To be called when all pairs are joined.
    template <class Communicator>
    void number(const particle_halo<Communicator>& halo) {
        // A root is the least of its island and stands before its members, so one sweep numbers them all.
        count_ = 0;
        const std::size_t count = label_.size();
        numbers_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto r = static_cast<std::size_t>(root(static_cast<std::int32_t>(i)));
            numbers_[i] = r == i ? count_++ : numbers_[r];
        }
        if constexpr (Communicator::is_distributed) number_over_ranks(halo);
    }

    std::size_t of(std::size_t i) const { return numbers_[i]; }

    /// mean = sum of values / sum of weights over the owned particles, island by island.
    template <class Communicator, class Value>
    void means(const particle_halo<Communicator>& halo, const std::vector<double>& weight, const Value& value,
               std::vector<double>& mean) {
        mean.assign(count_, 0.0);
        weights_.assign(count_, 0.0);
        for (std::size_t i = 0; i + halo.ghost_count() < numbers_.size(); ++i) {
            mean[numbers_[i]] += value(i);
            weights_[numbers_[i]] += weight[i];
        }
        if constexpr (Communicator::is_distributed) {
            for (const std::int64_t island : shared_) {
                const bool here = island >= 0;
                const auto k = static_cast<std::size_t>(here ? island : 0);
                const double sum = sum_over_ranks(halo.communicator(), here ? mean[k] : 0.0);
                const double weights = sum_over_ranks(halo.communicator(), here ? weights_[k] : 0.0);
                if (here) mean[k] = sum, weights_[k] = weights;
            }
        }
        for (std::size_t k = 0; k < count_; ++k) mean[k] /= weights_[k];
    }

  private:
    std::int32_t root(std::int32_t i) {
        std::int32_t r = i;
        while (label_[static_cast<std::size_t>(r)] != r) r = label_[static_cast<std::size_t>(r)];
        while (label_[static_cast<std::size_t>(i)] != r) {
            const std::int32_t up = label_[static_cast<std::size_t>(i)];
            label_[static_cast<std::size_t>(i)] = r;
            i = up;
        }
        return r;
    }

    /// Finds the islands that have ghosts, and their order, which is the same on every rank: that of their least ids.
    template <class Communicator>
    void number_over_ranks(const particle_halo<Communicator>& halo) {
        const std::size_t owned = numbers_.size() - halo.ghost_count();
        const Communicator& communicator = halo.communicator();
        std::vector<std::int64_t> least(count_, std::numeric_limits<std::int64_t>::max()), seen(numbers_.size());
        const auto lower = [&](std::size_t i, std::int64_t id) {
            const bool changes = id < least[numbers_[i]];
            if (changes) least[numbers_[i]] = id;
            return changes;
        };
        for (std::size_t i = 0; i < numbers_.size(); ++i) lower(i, halo.ids()[i]);
        // The least id walks one rank further each time.
        for (bool moved = true; communicator.any(moved);) {
            moved = false;
            for (std::size_t i = 0; i < owned; ++i) seen[i] = least[numbers_[i]];
            halo.gather(seen);
            for (std::size_t g = owned; g < numbers_.size(); ++g) moved = lower(g, seen[g]) || moved;
        }
        // Islands of this rank that meet on another are one.
        std::vector<std::int64_t> known = least, mine, all;
        sort_once(known);
        const auto place = [](const std::vector<std::int64_t>& ids, std::int64_t id) {
            return static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
        };
        for (std::size_t g = owned; g < numbers_.size(); ++g) mine.push_back(least[numbers_[g]]);
        sort_once(mine);
        for (std::size_t& number : numbers_) number = place(known, least[number]);
        count_ = known.size();

        std::vector<parcel<std::int64_t>> outgoing;
        for (int r = 0; r < communicator.size(); ++r) outgoing.push_back({r, mine});
        for (const auto& from : communicator.exchange(std::move(outgoing)))
            all.insert(all.end(), from.values.begin(), from.values.end());
        sort_once(all);
        shared_.clear();
        for (const std::int64_t id : all)
            shared_.push_back(std::binary_search(known.begin(), known.end(), id)
                                  ? static_cast<std::int64_t>(place(known, id))
                                  : std::int64_t{-1});
    }

    static void sort_once(std::vector<std::int64_t>& ids) {
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    }

    std::vector<std::int32_t> label_;
    std::vector<std::size_t> numbers_;
    std::size_t count_ = 0;
    std::vector<double> weights_;
    std::vector<std::int64_t> shared_;  // of each island over ranks its number here, or -1
};

}  // namespace hearth::detail
