// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <hearth/closure/drag.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/gas/array.hpp>
#include <hearth/gas/flow.hpp>
#include <hearth/gas/vector3.hpp>

namespace hearth::gas {

/// State of the gas, per cell (owned, then ghosts) or per face.
struct gas_fields {
    array<double> temperature;    ///< [K]
    array<double> enthalpy;       ///< absolute [J/kg]
    array<double> mass_fraction;  ///< cell by cell, species_count each [-]
    array<double> density;        ///< [kg/m^3]
    array<double> viscosity;      ///< laminar [Pa s]
    array<double> conductivity;   ///< laminar [W/(m K)]
    array<double> specific_heat;  ///< [J/(kg K)]
    array<double> kinetic;        ///< turbulent kinetic energy k [m^2/s^2]
    array<double> dissipation;    ///< its dissipation [m^2/s^3]
    array<double> eddy_viscosity; ///< [Pa s]
    flow_state flow;                    ///< gauge pressure, superficial velocity, mass fluxes, pressure gradient
};

/// beta of momentum model a [kg/(m^3 s)] for the flow in one cell.
using drag_function = std::function<double(const closure::bed_flow<double>&)>;

/// Any drag closure of the library; one of model b is turned into model a, which has the same pressure drop.
template <class Drag>
drag_function make_drag(Drag drag) {
    return [drag](const closure::bed_flow<double>& flow) {
        const double beta = closure::exchange_coefficient(drag, flow);
        return Drag::model() == closure::momentum_model::b ? flow.void_fraction * beta : beta;
    };
}

/// The particles as the gas sees them, per cell.
struct bed_fields {
    array<double> void_fraction;       ///< (0, 1] [-]
    array<double> diameter;            ///< Sauter mean of the particles there [m]
    array<vector3> particle_velocity;  ///< the true one: that of the accelerated motion over Gamma; empty: at rest [m/s]
    /// Exchange by particles through a transfer operator, used instead of the closure where not empty:
    /// sum W K [kg/(m^3 s)], with particle_velocity the mean weighted by it.
    array<double> exchange;
    // Heat exchange through the same operator, implicit: the gas loses heat_conductance * T - heat_source.
    array<double> heat_conductance;    ///< sum W K [W/K] per cell
    array<double> heat_source;         ///< sum W K T_particle [W] per cell
};

/// What comes into the gas beside the boundaries, per cell; zero by default.
struct source_fields {
    array<double> species;    ///< [kg/s], cell by cell, species_count each; drying, reaction, nozzles
    array<double> enthalpy;   ///< absolute enthalpy of what comes, and any heat [W]
    array<vector3> force;     ///< momentum of what comes, and any force; empty: none [N]
    // Reaction, implicit: a species gains conversion * (converted - Y), cell by cell, species_count each.  It brings no
    // mass: who fills them sees to it that what some gain others lose.  Empty: none.
    array<double> conversion;  ///< [kg/s]
    array<double> converted;   ///< mass fractions that it drives to [-]
};

}  // namespace hearth::gas
