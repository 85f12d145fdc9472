// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <hearth/dem/ranks.hpp>

#include "pair_list.hpp"
#include "store.hpp"

namespace hearth::dem::detail {

/// Copies of other ranks' particles, behind the owned ones of a store: all within reach of the particles that this rank
/// owns, by rank.  Those on the list of pairs follow their owners at every step, the others when asked.
class ghosts {
  public:
    explicit ghosts(const decomposition& spread) : among_(spread.among), axis_(spread.axis) {}

    /// How far the particles of each rank reach along the axis, `kept` being those of this one.
    void survey(const store& particles, const std::vector<index>& kept);
    double low() const { return mine().low; }
    double high() const { return mine().high; }

    /// Brings the ghosts: spheres whose surface is closer than `reach` to one of `largest` radius on another rank, and
    /// centres closer than `near_reach`.  Returns those that may touch owned ones.
    std::vector<index> make(store& particles, double largest_radius, double reach, double near_reach);

    /// Tells the owners which ghosts are on the list, and so are wanted at every step.
    void want(const store& particles, const pair_list& pairs);

    /// Positions and motions of the wanted ones; other work may be done between the two.
    void begin_motion(const store& particles);
    void end_motion(store& particles);

    /// Positions, motions, masses and temperatures of all.
    void update(store& particles);

    /// Ranks that own the ghosts.
    const std::vector<int>& owners() const { return owners_; }
    std::size_t bytes() const;

  private:
    struct range {
        double low, high;
    };
    struct moving {
        vector3 centre, velocity, spin;
        lead ahead;
    };
    const range& mine() const { return ranges_[static_cast<std::size_t>(among_->rank())]; }

    std::shared_ptr<ranks> among_;
    int axis_;
    std::vector<range> ranges_;               ///< of the ranks; low > high for one without particles
    std::vector<index> exported_, moved_out_;  ///< owned particles, rank by rank: all; the wanted ones
    std::vector<index> moved_in_;              ///< ghosts, by their places in the store
    std::vector<link> exports_, imports_;      ///< parts of exported_, and of the ghosts
    std::vector<link> bytes_out_, bytes_in_;   ///< of the two below
    std::vector<moving> outgoing_, incoming_;
    std::vector<int> owners_;
};

}  // namespace hearth::dem::detail
