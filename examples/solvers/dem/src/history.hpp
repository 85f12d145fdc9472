// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/dem/particles.hpp>

namespace hearth::dem::detail {

/// Springs of the contacts of each particle while lists are rebuilt, particles are sorted, and move between ranks.
/// Springs are those of the partner with the lower id relative to the other; facets of walls have negative ids and count as
/// the second.
class history {
  public:
    struct entry {
        std::int64_t partner;
        vector3 spring;
    };

    explicit history(bool rolling) : rolling_(rolling) {}

    /// Two passes: reserve() for every entry, then begin_filling(), then put() for every entry.
    void start(std::size_t particles) { first_.assign(particles + 1, 0); }
    void reserve(index particle) { ++first_[static_cast<std::size_t>(particle) + 1]; }
    void begin_filling() {
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        entries_.resize(first_.back());
        if (rolling_) rolls_.resize(first_.back());
    }
    void put(index particle, const entry& e, const vector3* roll) {
        const std::size_t at = first_[static_cast<std::size_t>(particle)]++;  // shifted back by end_filling()
        entries_[at] = e;
        if (rolling_) rolls_[at] = *roll;
    }
    void end_filling() {
        for (std::size_t i = first_.size() - 1; i > 0; --i) first_[i] = first_[i - 1];
        first_[0] = 0;
    }

    /// Adds the row of one more particle.
    void append(const std::vector<entry>& entries, const std::vector<vector3>& rolls) {
        entries_.insert(entries_.end(), entries.begin(), entries.end());
        if (rolling_) rolls_.insert(rolls_.end(), rolls.begin(), rolls.end());
        first_.push_back(static_cast<std::uint32_t>(entries_.size()));
    }

    bool rolling() const { return rolling_; }

    /// Finds the spring of a particle with a partner; false where they did not touch.
    bool find(index particle, std::int64_t partner, vector3& spring, vector3* roll) const {
        const auto p = static_cast<std::size_t>(particle);
        if (p + 1 >= first_.size()) return false;
        for (std::size_t e = first_[p]; e < first_[p + 1]; ++e) {
            if (entries_[e].partner != partner) continue;
            spring = entries_[e].spring;
            if (rolling_) *roll = rolls_[e];
            return true;
        }
        return false;
    }

    std::size_t begin(index particle) const { return first_[static_cast<std::size_t>(particle)]; }
    std::size_t end(index particle) const { return first_[static_cast<std::size_t>(particle) + 1]; }
    const entry& at(std::size_t e) const { return entries_[e]; }
    const vector3& roll_at(std::size_t e) const { return rolls_[e]; }
    std::size_t bytes() const {
        return first_.capacity() * sizeof(std::uint32_t) + entries_.capacity() * sizeof(entry) +
               rolls_.capacity() * sizeof(vector3);
    }

  private:
    bool rolling_;
    std::vector<std::uint32_t> first_;
    std::vector<entry> entries_;
    std::vector<vector3> rolls_;
};

}  // namespace hearth::dem::detail
