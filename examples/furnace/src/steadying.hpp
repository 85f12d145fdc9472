// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/shaft_profile.hpp>

#include "stones.hpp"

namespace hearth::furnace {

/// Leads a shaft to its steady state in fewer hours of the process than it takes by itself.  Its slowest mode, in which
/// fronts creep through the bed, decays over a residence time of the stones, while all else settles much sooner.  So
/// the bed is watched over some couplings, in slices over the height; from what it still stores there the
/// one-dimensional model tells by how much the stones of each slice are from steady ones; and they are brought there.
/// A steady shaft stores nothing and is left as it is, so the answer is that of the couplings alone.
class steadying {
  public:
    explicit steadying(const settings& scene);

    /// The bed right after its exchange in a coupling that takes that time of the process [s].
    void watch(const parcels& bed, double step);
    /// Whether it is time for a shift; not in the last couplings planned, whose balance is the result.
    bool due(int couplings, std::size_t judged) const;
    /// By how much stones are to be warmed, or nothing.
    ///
    /// A leap is bounded: a steady stone is neither colder nor hotter than steady_range says, so a leap that would
    /// bring a slice beyond it shows that the model does not carry so far, and is halved until it brings none there,
    /// and left out where a thousandth of it would.  Single stones of a slice are to be held there.  What lies beyond
    /// already may stay, and what the window saw a slice's temperature change by may come on top: so much it cannot
    /// tell from standing still.
    struct leap {
        std::vector<double> shift, slack;  ///< of each slice [K]
        temperature_range range;
        bool halved = false;

        /// The nearest to `to` that a stone may be led to from `from` [K].
        double bounded(double from, double to, double slack_here) const {
            return std::clamp(to, std::min(from, range.coldest - slack_here), std::max(from, range.hottest + slack_here));
        }
    };
    /// The next leap; forgets what was watched.  `measured` has the bed's void fraction; after `turn` couplings its
    /// parcels lie as they lay.
    leap shift(const settings& measured, std::size_t turn);

    template <class Part>
    void each(Part&& part) {
        part("mass", mass_);
        part("enthalpy", enthalpy_);
        part("height_moment", height_moment_);
        part("times", times_);
    }

  private:
    std::vector<double> sum(const std::vector<double>& values, std::size_t from, std::size_t to) const;
    std::vector<double> enthalpy_over_height(std::size_t from, std::size_t to) const;

    double height_;
    int interval_, planned_;
    std::size_t slices_;
    std::vector<double> mass_, enthalpy_, height_moment_;  // of each slice after each coupling [kg], [J], [kg m]
    std::vector<double> times_;                            // of those couplings, since the first [s]
};

}  // namespace hearth::furnace
