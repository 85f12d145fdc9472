// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/dem/feed.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/snapshot.hpp>

namespace hearth::furnace {

/// What keeps the bed of a shaft moving in DEM: a feed above, a driven discharge below, both at the scene's mass flow
/// times `pace`, and the gas's pressure gradient on the parcels, as the one-dimensional solution has it.
class driven_motion {
  public:
    /// `void_fraction`: of the bed.  Throws bad_scene where there is no one-dimensional solution.
    driven_motion(const settings& scene, double void_fraction);

    static constexpr int stretch = 100;  ///< most steps between two updates of feed, discharge and the gas's push
    /// So many steps, at most a stretch.  On several ranks all make the call together.
    void advance(dem::bed& bed, int steps);
    /// Seconds of the process in a second of DEM: Gamma, and less where a softer bed moves slower.
    double pace() const { return pace_; }
    /// Of the process, from now on [kg/s].
    void set_mass_flow(double kg_per_s);

    double taken() const { return outflow_.now().taken; }  ///< by the discharge so far [kg]
    double waiting() const { return feed_.now().due; }     ///< feed that is due and has not found room [kg]

    /// Under names that begin with `folder`.
    void save(saved_state& into, const std::string& folder) const;
    /// Throws bad_scene.
    void restore(const saved_state& from, const std::string& folder);

  private:
    void push_by_gas(dem::bed& bed) const;

    double height_, pace_;
    double bed_over_solid_;  ///< weight over the share of solid: all of the pressure gradient acts on the solid [-]
    dem::feed feed_;
    dem::outflow outflow_;
    std::vector<double> lift_;  ///< of the gas per volume of bed, over the height [N/m^3]
};

/// Gamma of the motion that DEM makes: of what is recorded, or of all of it.
double motion_acceleration(const settings& scene);

}  // namespace hearth::furnace
