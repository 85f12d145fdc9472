// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

/// A furnace in one dimension: solids that sink, gas that rises, everything uniform over the cross section.
/// Heights are those of the cells' centres; temperatures, pressure and flow are of the cells.
struct shaft_profile {
    std::vector<double> height;             ///< [m]
    std::vector<double> particle_temperature;  ///< [K]
    std::vector<double> gas_temperature;    ///< of the gas that leaves the cell upwards [K]
    std::vector<double> pressure;           ///< absolute [Pa]
    std::vector<double> heat_transfer_coefficient;  ///< h of Gunn [W/(m^2 K)]

    double peak_particle_temperature = 0;   ///< [K]
    double peak_height = 0;                 ///< [m]
    double offgas_temperature = 0;          ///< [K]
    double solids_outlet_temperature = 0;   ///< [K]
    double pressure_drop = 0;               ///< [Pa]
    double wall_heat_loss = 0;              ///< [W]
    double fuel_power = 0;                  ///< lower heating value times fuel flow [W]
    double enthalpy_imbalance = 0;          ///< of the whole shaft, over the fuel power [-]
    int iterations = 0;                     ///< of Newton's method
    bool converged = false;
};

/// Steady counter-current model of a scene: exact exchange in each cell (through-flow by transfer units), Gunn, Ergun
/// with the local density, radiative conduction along the axis, heat loss through the walls, and gas that is burnt where
/// it is mixed.  A furnace starts from it, and a test compares with it; a tenth of a second.
/// Throws bad_scene for a scene that it cannot describe: fuel left over above the burners.
shaft_profile solve_shaft_profile(const settings& scene, int cells = 2000);

/// Between these no stone of a steady shaft can be colder or hotter [K]: the coldest and hottest of what enters and of what
/// surrounds the walls, and the flame of the burners' gas.  Each gas mixes from others and each stone takes its heat from gas
/// and stones beside it, so the extremes are where heat or matter comes in; air that makes up for oxygen that a rich gas lacks
/// counts as hot as the flame.
struct temperature_range {
    double coldest, hottest;
};
temperature_range steady_range(const settings& scene);

/// How far the particles of a shaft are from steady ones [K], one value for each cell over the height, as many as are given.
/// The shaft is any that the model resembles: a finer one, say, whose particles have these temperatures [K] and still store
/// heat [W/m].  What it stores beyond what the model says of the same temperatures is kept as a source, so where nothing is
/// stored the shift is none (a full approximation scheme with the model as its coarse level).  Empty where the model finds no
/// steady state.
std::vector<double> shift_to_steady(const settings& scene, const std::vector<double>& particle_temperature,
                                    const std::vector<double>& storage);

}  // namespace hearth::furnace
