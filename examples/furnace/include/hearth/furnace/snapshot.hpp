// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hearth::furnace {

/// The furnace at one moment, for who reads it.  Fields that a scene does not have are empty.
struct snapshot {
    double process_time = 0;                               ///< [s]
    std::vector<std::array<double, 3>> particle_position;  ///< of parcels [m]
    std::vector<double> particle_radius;                   ///< of parcels [m]
    std::vector<double> particle_temperature;              ///< [K]
    std::vector<double> heat_transfer_coefficient;         ///< to the gas, interior included [W/(m^2 K)]
    std::vector<std::array<double, 3>> cell_centre;        ///< [m]
    std::vector<double> cell_volume;                       ///< [m^3]
    std::vector<double> void_fraction;                     ///< [-]
    std::vector<double> gas_temperature;                   ///< [K]
    std::vector<double> pressure;                          ///< absolute [Pa]
    std::vector<std::array<double, 3>> superficial_velocity;  ///< [m/s]
    std::map<std::string, std::vector<double>> mole_fraction; ///< of each gas: CH4, O2, ... [-]
};

/// The cells as hexahedra, in the order of snapshot's cell fields; it does not change while a furnace runs.
struct cell_shapes {
    std::vector<std::array<double, 3>> points;       ///< [m]
    std::vector<std::array<std::int64_t, 8>> cells;  ///< points, in the order of VTK's hexahedron
};

/// Means over the cross section, in slices of equal height from the bottom to the top of the shaft.
struct axial_profile {
    std::vector<double> height;                ///< of the slices' middles [m]
    std::vector<double> particle_temperature;  ///< [K]; NaN in a slice without particles
    std::vector<double> particle_temperature_centre;  ///< within a third of the radius [K]; NaN the same
    std::vector<double> particle_temperature_wall;    ///< beyond 85 % of the radius [K]; NaN the same
    std::vector<double> gas_temperature;       ///< by mass flow upwards [K]
    std::vector<double> pressure;              ///< absolute [Pa]
    std::vector<double> void_fraction;         ///< [-]
    // Heat that particles receive, per height of shaft [W/m]; empty where the scene has no such mechanism.
    std::vector<double> convection, radiation, conduction, wall;
};

/// All that the next step depends on, by name: a furnace that restores it goes on as if it had never stopped, bit for bit.
/// DEM's state is bytes; they are held in the numbers' bits.  Wall times are in it too, under "seconds".
/// On several ranks each rank saves a part.  The state is then, under every name, the parts' numbers one behind the other in
/// order of rank; any number of ranks goes on from it, another number to the solvers' tolerance.
using saved_state = std::map<std::string, std::vector<double>>;

}  // namespace hearth::furnace
