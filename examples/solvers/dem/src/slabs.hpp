// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <hearth/dem/ranks.hpp>

#include "history.hpp"
#include "store.hpp"

namespace hearth::dem::detail {

/// What each rank owns: the particles between two cuts across an axis.
class slabs {
  public:
    explicit slabs(const decomposition& spread);

    int axis() const { return axis_; }
    const std::vector<double>& cuts() const { return cuts_; }
    /// Cuts of an earlier time, if they are those of so many ranks.
    void set_cuts(const std::vector<double>& cuts) {
        if (cuts.size() == cuts_.size()) cuts_ = cuts;
    }
    int owner_of(const vector3& x) const;
    bool is_mine(const vector3& x) const { return owner_of(x) == among_->rank(); }

    /// Cuts anew where a rank has more than a fiftieth above its share of the particles of `kept`.
    void balance(const store& particles, const std::vector<index>& kept);

    /// Sends those of `kept` that other ranks own there, with their springs.  Afterwards `kept` are those that this rank
    /// owns: what came stands behind the others in the store, which must hold no ghosts, and in the history.
    void migrate(store& particles, history& past, std::vector<index>& kept) const;

  private:
    std::shared_ptr<ranks> among_;
    int axis_;
    std::vector<double> cuts_;  ///< between one rank and the next
};

}  // namespace hearth::dem::detail
