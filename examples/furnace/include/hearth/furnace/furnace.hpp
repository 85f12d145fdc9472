// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/shaft_profile.hpp>

namespace hearth::furnace {

/// The furnace at one moment, for who reads it.
struct snapshot {
    double process_time = 0;                        ///< [s]
    std::vector<std::array<double, 3>> particle_position;  ///< of parcels [m]
    std::vector<double> particle_temperature;       ///< [K]
    std::vector<std::array<double, 3>> cell_centre; ///< [m]
    std::vector<double> void_fraction;              ///< [-]
    std::vector<double> gas_temperature;            ///< [K]
    std::vector<double> pressure;                   ///< absolute [Pa]
};

/// What a person watches, and what a run ends with.  Powers are rates by the process's clock.
struct status {
    double process_time = 0;               ///< [s]
    double peak_particle_temperature = 0;  ///< [K]
    double peak_height = 0;                ///< [m]
    double maximum_gas_temperature = 0;    ///< [K]
    double offgas_temperature = 0;         ///< [K]
    double solids_outlet_temperature = 0;  ///< mean of what left in the last coupling [K]
    double pressure_drop = 0;              ///< [Pa]
    double mean_void_fraction = 0;         ///< of the bed [-]
    double fuel_power = 0;                 ///< [W]
    double wall_heat_loss = 0;             ///< [W]
    double gas_enthalpy_out = 0;           ///< off-gas less air and burner gas [W]; negative where the gas heats the bed
    double particle_enthalpy_gain = 0;     ///< of the solids in the shaft, by storage [W]
    double solids_enthalpy_out = 0;        ///< leaving less entering [W]
    double enthalpy_imbalance = 0;         ///< what the sum of these lacks [W]
    double coupling_share = 0;             ///< of the wall time: voidage and transfer between particles and cells [-]
};

/// The reference furnace as a library: a scene becomes a furnace, which steps and can be looked at.
///
///     hearth::furnace::furnace shaft(hearth::furnace::read_scene("column.toml"));
///     while (!shaft.done()) shaft.step();
///     const auto now = shaft.now();
///
/// Throws bad_scene for a scene that it cannot run.
class furnace {
  public:
    explicit furnace(const settings& scene);
    ~furnace();
    furnace(furnace&&) noexcept;

    /// One coupling: the bed moves, then gas and particles exchange for the process time between couplings.
    void step();
    int steps_done() const;
    int steps_planned() const;
    bool done() const { return steps_done() >= steps_planned(); }

    status now() const;
    snapshot look() const;
    const shaft_profile& profile() const;  ///< the one-dimensional solution of the scene

    /// Changes the burners while the furnace runs: premixed gas of all burners [kg/s].
    void set_burner_flow(double mass_flow);

  private:
    struct parts;
    std::unique_ptr<parts> parts_;
};

}  // namespace hearth::furnace
