// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include <hearth/dem/recording.hpp>
#include <hearth/furnace/ranks.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/snapshot.hpp>

#include "packing.hpp"

namespace hearth::furnace {

/// DEM lets parcels fall into the shaft until they rest.  For a bed that is to move by a recording it goes on: the bed
/// is fed above and discharged below, with the gas's pressure gradient on the parcels, and what is seen is recorded.
///
/// Centres of parcels lie between the ends of the shaft: the floor is a largest radius below it, so that the bed is cut
/// through there as it is at the top, and not laid flat.
///
/// Ranks share the parcels in slabs; the motion has the bits of one rank, and each rank gets the whole bed.
class filling {
  public:
    filling(const settings& scene, const ranks& among);

    /// Some more steps.
    void advance();
    bool done() const { return now_ == stage::done; }
    double level() const;  ///< of the bed [m]
    double share() const;  ///< of the expected work, 0 to 1 [-]
    std::vector<dem::particle> parcels() const;  ///< of all ranks, by their ids

    /// The bed that the scene asks for.
    std::unique_ptr<dem::moving_bed> finished() const;

    /// DEM's state is that of this rank's parcels.
    void save(saved_state& into) const;
    /// Throws bad_scene or dem::state_error.
    void restore(const saved_state& from);

  private:
    enum class stage { falling, springing_back, starting, recording, done };

    bool at_rest() const;
    double weight() const;  ///< gravity of the fall and of the motion, over that of the earth [-]
    void set_gravity(double share);
    void begin_motion();
    void make_motion();
    void move();
    void push_by_gas();
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
    std::optional<dem::feed> feed_;
    std::optional<dem::outflow> outflow_;
    std::optional<dem::recorder> recorder_;
    std::vector<double> lift_;  ///< of the gas per volume of bed, over the height [N/m^3]
};

}  // namespace hearth::furnace
