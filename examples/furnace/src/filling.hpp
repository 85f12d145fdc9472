// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include <hearth/dem/recording.hpp>
#include <hearth/furnace/ranks.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/snapshot.hpp>

#include "driven_motion.hpp"
#include "packing.hpp"

namespace hearth::furnace {

/// DEM lets parcels fall into the shaft until they rest.  For a bed that DEM is to move it goes on: the bed is fed
/// above and discharged below until it flows, and for one that is to move by a recording what is then seen is recorded.
///
/// Ranks share the parcels in slabs; the motion has the bits of one rank, and each rank gets the whole bed.
class filling {
  public:
    filling(const settings& scene, const ranks& among);

    /// Some more steps.
    void advance();
    bool done() const { return now_ == stage::done; }
    double level() const;                      ///< of the bed [m]
    double share() const;                      ///< of the expected work, 0 to 1 [-]
    std::vector<dem::sphere> parcels() const;  ///< of all ranks, by their ids

    /// The bed that the scene asks for; nothing may be asked of the filling afterwards.
    std::unique_ptr<dem::moving_bed> finished();

    /// DEM's state is that of this rank's parcels.
    void save(saved_state& into) const;
    /// Throws bad_scene or dem::state_error.
    void restore(const saved_state& from);

  private:
    enum class stage { falling, springing_back, starting, recording, done };

    bool at_rest() const;
    bool goes_on() const;  ///< once the parcels have fallen
    void set_gravity(double share);
    void begin_motion();
    void make_motion();
    void cut(double level);
    double sinking(double diameters) const;  ///< mass that leaves while the bed sinks by so many parcels [kg]

    settings scene_;
    ranks among_;
    double largest_;  ///< diameter of a parcel [m]
    dem::bed bed_;
    stage now_ = stage::falling;
    double gravity_ = 1;        ///< over that of the earth [-]
    double void_fraction_ = 0;  ///< of the bed that begins to move
    double taken_ = 0;          ///< by the outflow when the last frame was seen [kg]
    std::optional<driven_motion> motion_;
    std::optional<dem::recorder> recorder_;
};

}  // namespace hearth::furnace
