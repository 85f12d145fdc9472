// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include <hearth/gas/array.hpp>
#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// A gas that enters: temperature, composition, turbulence.
struct stream {
    double temperature = 300;                  ///< [K]
    array<double> mass_fraction{1.0};    ///< adds up to 1 [-]
    double turbulence_intensity = 0.05;        ///< velocity fluctuation over velocity [-]
    double turbulence_length = 0.01;           ///< [m]
};

/// How a wall passes heat: through a transmittance to a temperature behind it.  A transmittance of 0 is adiabatic.
struct wall_heat {
    double transmittance = 0;      ///< U, from the gas in the wall cell to the ambient [W/(m^2 K)]
    double ambient = 320;          ///< [K]
};

/// The condition on one patch.
struct patch_condition {
    enum class kind { inlet, outlet, wall, slip };

    kind type = kind::wall;
    double mass_flow = 0;                ///< inlet: into the domain, over the whole patch [kg/s]
    double pressure = 1.01325e5;         ///< outlet: absolute [Pa]
    stream gas;                          ///< inlet: what enters; outlet: what would come back
    vector3 velocity;                    ///< wall: of the wall itself (tangential) [m/s]
    /// Wall: heat by position, so that zones need no patches of their own.  Empty: adiabatic.
    std::function<wall_heat(const vector3&)> heat;
    /// Inlet with a profile: superficial velocity at a point [m/s]; replaces mass_flow.
    std::function<vector3(const vector3&)> profile;
    /// Inlet with a profile of temperature [K]; wall with a given temperature.
    std::function<double(const vector3&)> temperature;
    /// Outlet with a profile of absolute pressure [Pa].
    std::function<double(const vector3&)> pressure_profile;
};

/// Mass flow into the domain, spread evenly over the patch. [kg/s]
inline patch_condition mass_flow_inlet(double mass_flow, stream gas) {
    if (!(mass_flow >= 0)) throw std::invalid_argument("hearth::gas: mass flow must be >= 0 [kg/s]");
    patch_condition c;
    c.type = patch_condition::kind::inlet;
    c.mass_flow = mass_flow;
    c.gas = std::move(gas);
    return c;
}

/// Volume flow at normal conditions (273.15 K, 101325 Pa) of an ideal gas.  [m^3/s], molar mass [kg/mol]
inline patch_condition normal_volume_inlet(double volume_flow, double molar_mass, stream gas) {
    constexpr double normal_molar_volume = 8.31446261815324 * 273.15 / 101325;  // [m^3/mol]
    return mass_flow_inlet(volume_flow * molar_mass / normal_molar_volume, std::move(gas));
}

inline patch_condition pressure_outlet(double pressure, stream back = {}) {
    if (!(pressure > 0)) throw std::invalid_argument("hearth::gas: outlet pressure must be > 0 [Pa]");
    patch_condition c;
    c.type = patch_condition::kind::outlet;
    c.pressure = pressure;
    c.gas = std::move(back);
    return c;
}

inline patch_condition wall() { return {}; }

inline patch_condition wall(wall_heat heat) {
    if (!(heat.transmittance >= 0)) throw std::invalid_argument("hearth::gas: transmittance must be >= 0 [W/(m^2 K)]");
    patch_condition c;
    c.heat = [heat](const vector3&) { return heat; };
    return c;
}

/// Slip wall; a plane of symmetry is the same.
inline patch_condition slip() {
    patch_condition c;
    c.type = patch_condition::kind::slip;
    return c;
}

/// Gas that enters a cell where the nozzle is smaller than the cell's faces.
struct nozzle {
    int cell = 0;
    double mass_flow = 0;   ///< [kg/s]
    vector3 velocity;       ///< of the jet [m/s]
    stream gas;
};

}  // namespace hearth::gas
