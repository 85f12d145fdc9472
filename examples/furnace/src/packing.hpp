// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <hearth/dem/moving_bed.hpp>
#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

/// Diameter with the surface per volume of all stones [m].
double sauter_diameter(const settings& scene);

/// The wall of the shaft as parcels see it; `top`: to which height.
dem::wall shaft_wall(const settings& scene, double top);
dem::material softened(const settings& scene);
dem::contact_settings contact_of(const settings& scene);

/// A bed without DEM: equal parcels on a face-centred lattice, stretched to the scene's void fraction, that sinks as a plug.
/// The lattice leans a little, so that parcels leave one by one and not by layers.
std::unique_ptr<dem::moving_bed> lattice_bed(const settings& scene);

/// A bed of these spheres that sinks as a plug; centres within the shaft.
std::unique_ptr<dem::moving_bed> remake_bed(const settings& scene, std::vector<dem::sphere> spheres, std::vector<double> masses);

/// DEM lets parcels fall from a loose start until they rest, up to the top of the shaft.
class filling {
  public:
    explicit filling(const settings& scene);

    /// Some more steps.
    void advance(int steps);
    bool at_rest() const { return at_rest_; }
    double level() const;   ///< of the bed [m]
    double share() const;   ///< of the expected time, 0 to 1 [-]
    dem::bed& bed() { return bed_; }
    const dem::bed& bed() const { return bed_; }

    /// The packing with its spare top cut off, as a bed that sinks as a plug.
    std::unique_ptr<dem::moving_bed> finished() const;

    double gravity() const { return bed_.settings().gravity.z; }  ///< [m/s^2]
    std::vector<char> state() const { return bed_.state(); }
    void restore(double gravity, const std::vector<char>& state);

  private:
    void judge();

    settings scene_;
    dem::bed bed_;
    double top_;
    bool at_rest_ = false;
};

}  // namespace hearth::furnace
