// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <hearth/dem/moving_bed.hpp>

#include "driven_motion.hpp"
#include "shaft_bed.hpp"

namespace hearth::furnace {

/// A bed that DEM moves all the time, on the clock of the process: a second of DEM is `pace` seconds.  What leaves is
/// the mass flow times time to a parcel, and so is what the feed brings.
///
/// A parcel is of the bed from when it has landed, on two others or on one and a wall; it comes as feed then.  Who
/// still falls moves at its true speed, in a thousandth of the time that the bed would see: it takes no part in
/// anything (at Gamma 1 its heat would be a Gamma-th), as in a bed that is recorded.
///
/// Ranks share the work of DEM; each has all parcels, by their ids, with the bits of one rank.
class driven_bed final : public dem::moving_bed {
  public:
    /// A bed that moves already.  Together.
    driven_bed(const settings& scene, const ranks& among, dem::bed parcels, driven_motion motion, double void_fraction);
    /// From what save() wrote; restore() of the base follows.  Throws bad_scene or dem::state_error.  Together.
    static std::unique_ptr<driven_bed> read(const settings& scene, const ranks& among, const saved_state& from);
    /// DEM's state is that of this rank's parcels; that of the base is not in it.
    void save(saved_state& into) const;

    dem::vector3 velocity(dem::index i) const override;   ///< its way in the last move over the time that it took
    double waiting() const { return motion_.waiting(); }  ///< feed that is due and has not found room [kg]
    double flying() const;                                ///< what the feed has brought and has not landed [kg]

  private:
    driven_bed(population known, const settings& scene, const ranks& among, dem::bed&& parcels, driven_motion motion,
               double void_fraction);
    void move(double seconds, dem::passage& done) override;
    std::uint64_t fingerprint() const override { return 3; }  ///< what it was made of is what DEM restores
    void see_who_lands(std::map<std::int64_t, double>& mass_of);

    ranks among_;
    dem::bed parcels_;
    driven_motion motion_;
    double void_fraction_;  ///< that the motion was made for
    double behind_ = 0;     ///< time that DEM has not made up for, less than a step [s]
    std::vector<dem::vector3> velocities_;
};

}  // namespace hearth::furnace
