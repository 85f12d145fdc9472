// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

/// The shaft's wall in rings, each of one temperature, which lose heat to the ambient of their zones.
class wall_rings {
  public:
    /// Rings of about the given height; a ring ought to have stones beside it always.
    wall_rings(const settings& scene, double height, double ring_height)
        : height_(height), temperature_(static_cast<std::size_t>(std::max(1.0, std::floor(height / ring_height))), 300.0) {
        constexpr double pi = 3.14159265358979323846;
        constexpr int slices = 20;  // of a ring, for zones that begin within one
        const auto rings = static_cast<double>(temperature_.size());
        const double area = pi * scene.shaft.diameter * height / rings / slices;
        for (std::size_t r = 0; r < temperature_.size(); ++r) {
            double conductance = 0, pull = 0;
            for (int s = 0; s < slices; ++s) {
                const double z = (static_cast<double>(r) + (s + 0.5) / slices) * height / rings;
                for (const wall_zone& zone : scene.shaft.zones) {
                    if (z < zone.from || z >= zone.to) continue;
                    conductance += zone.transmittance * area;
                    pull += zone.transmittance * area * zone.ambient_temperature;
                }
            }
            conductance_.push_back(conductance);
            pull_.push_back(pull);
        }
    }

    std::size_t size() const { return temperature_.size(); }
    const std::vector<double>& temperature() const { return temperature_; }
    std::vector<double>& temperature() { return temperature_; }

    int ring(double z) const {
        const auto count = static_cast<double>(temperature_.size());
        return static_cast<int>(std::clamp(z / height_ * count, 0.0, count - 1));
    }

    double middle(std::size_t ring) const {  ///< its height [m]
        return (static_cast<double>(ring) + 0.5) * height_ / static_cast<double>(temperature_.size());
    }
    double conductance(std::size_t ring) const { return conductance_[ring]; }  ///< to the ambient [W/K]
    double ambient(std::size_t ring) const {                                   ///< [K]
        return conductance_[ring] > 0 ? pull_[ring] / conductance_[ring] : 300;
    }

  private:
    double height_;
    std::vector<double> temperature_, conductance_, pull_;  // [K], [W/K], [W]
};

}  // namespace hearth::furnace
