// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

/// What a number may be, in the unit of its key, and the factor from there to SI.
struct range {
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
    double to_si = 1;
};

/// The numbers of an entry in a list of tables: name, member and what it may be.
template <class Item>
using list_members = std::vector<std::pair<std::string, std::pair<double Item::*, range>>>;

inline const list_members<wall_zone> zone_members{{"z_min_m", {&wall_zone::from, {-10, 100}}},
                                                  {"z_max_m", {&wall_zone::to, {-10, 100}}},
                                                  {"transmittance_W_per_m2K", {&wall_zone::transmittance, {0, 1000}}},
                                                  {"ambient_temperature_K", {&wall_zone::ambient_temperature, {200, 2000}}}};
inline const list_members<size_class> size_members{{"diameter_mm", {&size_class::diameter, {0.1, 500, 1e-3}}},
                                                   {"mass_share", {&size_class::mass_share, {0, 1}}}};

/// The words that a key of the enumeration takes, in the order of its values.
constexpr auto names(bed_motion) { return std::array<std::string_view, 4>{"dem", "recorded", "plug", "frozen"}; }
constexpr auto names(burning) { return std::array<std::string_view, 4>{"none", "mixed_is_burnt", "equilibrium", "jones_lindstedt"}; }
constexpr auto names(gas_mixing) { return std::array<std::string_view, 2>{"at_once", "bed"}; }
constexpr auto names(voidage_method) { return std::array<std::string_view, 2>{"filtered", "vfs"}; }
constexpr auto names(bed_packing) { return std::array<std::string_view, 3>{"dem", "lattice", "dense"}; }
constexpr auto names(burner_feed) { return std::array<std::string_view, 2>{"nozzles", "section"}; }
constexpr auto names(start_from) { return std::array<std::string_view, 2>{"one_dimensional", "cold"}; }

/// Every key of a scene, once: reading, checking, documenting and hashing all walk this list.
///     key(table, name, value, range, meaning)
///     key(path, list of tables, their members)
/// Settings is settings or const settings.
template <class Settings, class Key>
void describe(Settings& s, Key&& key) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    key("", "title", s.title, range{}, "What the scene is called in tables and pictures");

    key("shaft", "height_m", s.shaft.height, range{0.1, 100}, "Height of the shaft");
    key("shaft", "diameter_m", s.shaft.diameter, range{0.05, 20}, "Inner diameter");
    key("shaft", "hopper_height_m", s.shaft.hopper_height, range{0, 20}, "Height of the free space between bed and hopper, with the off-gas pipe (assumed); 0: none, and the off-gas leaves at the top");
    key("shaft", "hopper_fill_m", s.shaft.hopper_fill, range{0, 100}, "Height of the stones that wait in the hopper, above the free space and as wide as the shaft: cold, beside gas and heat, and next to enter the shaft one by one; 0: the feed comes from nowhere");
    key("shaft", "offgas_pipe_diameter_m", s.shaft.offgas_pipe_diameter, range{0.01, 5}, "Side pipe of the off-gas, in the free space below the hopper (assumed)");

    key("particles", "mass_flow_kg_per_h", s.particles.mass_flow, range{0, 1e6, 1 / 3600.0}, "Solids fed at the top and taken out at the bottom");
    key("particles", "feed_temperature_K", s.particles.feed_temperature, range{200, 3000}, "Temperature of the feed");
    key("particles", "density_kg_per_m3", s.particles.density, range{100, 2e4}, "Density of the stone (assumed: spinel, fits 1.8 million particles)");
    key("particles", "emissivity", s.particles.emissivity, range{0.2, 1}, "Emissivity of the stone (assumed: 1, as the paper's equations are black)");

    key("air", "volume_flow_Nm3_per_h", s.air.volume_flow, range{0, 1e7, 1 / 3600.0}, "Secondary air through the bottom, at 273.15 K and 101325 Pa");
    key("air", "temperature_K", s.air.temperature, range{200, 2000}, "Temperature of the secondary air");

    key("burners", "feed", s.burners.feed, range{}, "How the premixed gas enters: as jets in a circle, or over the whole section and 0.1 m of height, as in one dimension");
    key("burners", "count", s.burners.count, range{0, 1000}, "Burners in a circle, flush with the wall");
    key("burners", "diameter_mm", s.burners.diameter, range{1, 500, 1e-3}, "Diameter of a burner's mouth");
    key("burners", "height_m", s.burners.height, range{0, 100}, "Height of the circle above the bottom");
    key("burners", "mass_flow_kg_per_s", s.burners.mass_flow, range{0, 1000}, "Premixed gas and air of all burners (assumed: not in the paper)");
    key("burners", "equivalence_ratio", s.burners.equivalence_ratio, range{0, 5}, "Fuel over stoichiometric fuel (assumed: 'near stoichiometric')");
    key("burners", "temperature_K", s.burners.temperature, range{200, 1000}, "Temperature of the premixed gas (assumed)");

    key("gas", "outlet_pressure_Pa", s.gas.pressure, range{1e3, 1e7}, "Absolute pressure in the off-gas pipe");
    key("gas", "ignition_temperature_K", s.gas.ignition_temperature, range{300, 3000}, "Gas around the burners at the start");

    key("bed", "packing", s.bed.packing, range{}, "Where the parcels lie: as DEM lets them fall; on a lattice of bed.void_fraction; or dense, at random and pushed apart to bed.void_fraction, which needs no fall, in a piece of the shaft that repeats upwards");
    key("bed", "motion", s.bed.motion, range{}, "How the bed moves: by DEM with feed and discharge, all the time, Gamma times too fast and seen Gamma times slower; as a stretch of that, recorded and repeated; as a body that sinks, and what leaves below comes back on top as feed; or not at all");
    key("bed", "recorded_diameters", s.bed.recorded_diameters, range{0.5, 1000}, "By how many parcels the bed sinks while it is recorded");
    key("bed", "recording_acceleration_factor", s.bed.recording_acceleration_factor, range{1, 1e4}, "Gamma of the DEM that is recorded; the flow stays quasi-static up to 200");
    key("bed", "coarse_graining", s.bed.coarse_graining, range{1, 10}, "Diameter of a parcel over that of its particles");
    key("bed", "void_fraction", s.bed.void_fraction, range{0.3, 0.7}, "Mean void fraction of a bed that is not packed by DEM (assumed)");
    key("bed", "softened_modulus_Pa", s.bed.softened_modulus, range{1e5, 1e12}, "Young's modulus of the motion");
    key("bed", "modulus_Pa", s.bed.modulus, range{1e6, 1e13}, "True Young's modulus, for the contact areas");
    key("bed", "poisson_ratio", s.bed.poisson_ratio, range{0, 0.49}, "Poisson ratio (assumed: spinel)");
    key("bed", "friction", s.bed.friction, range{0, 2}, "Friction between particles and with walls (assumed)");
    key("bed", "restitution", s.bed.restitution, range{0.01, 1}, "Coefficient of restitution (assumed)");

    key("voidage", "method", s.voidage.method, range{}, "How parcels become a solid fraction, and spread what they exchange: deposited over the cells that they touch, spread by a kernel, capped; or the volume fraction smoother of the paper, all to the cell of the centre, then what is above the threshold to its neighbours");
    key("voidage", "threshold", s.voidage.threshold, range{0.1, 1}, "Largest solid fraction of a cell (0.9 in the paper)");
    key("voidage", "width_in_diameters", s.voidage.width_in_diameters, range{0.1, 5}, "Width sigma of the kernel over the particle diameter");

    key("voidage", "exchange_width_in_diameters", s.voidage.exchange_width_in_diameters, range{0.05, 5}, "The same of the kernel that spreads a parcel's heat exchange: a parcel is wider than what it stands for, and its heat ought not to be");

    key("mesh", "cells_across", s.mesh.across, range{4, 1000}, "Cells over the diameter");
    key("mesh", "axial_size_m", s.mesh.axial_size, range{1e-3, 10}, "Height of the cells");
    key("mesh", "axial_size_bottom_m", s.mesh.axial_size_bottom, range{1e-3, 10}, "Height of the cells in the lowest 0.8 m, where cold air meets hot stones");
    key("mesh", "axial_size_burners_m", s.mesh.axial_size_burners, range{1e-3, 10}, "Height of the cells around the burners");

    key("physics", "radiation", s.physics.radiation, range{}, "Radiation between particles; the wall sees them in any case, or its loss would have no meaning");
    key("physics", "conduction", s.physics.conduction, range{}, "Conduction through contacts and gas films");
    key("physics", "nitric_oxide", s.physics.nitric_oxide, range{}, "Thermal NO, computed after the run");
    key("physics", "combustion", s.physics.combustion, range{}, "How the gas burns: not at all (the burners blow air), to CO2 and H2O or to equilibrium where it is mixed, or by Jones and Lindstedt's four steps at finite rates");
    key("physics", "mixing", s.physics.mixing, range{}, "Of gas that burns at finite rates: at once, or in the time in which it passes a pore of the bed (partially stirred reactor)");

    key("time", "acceleration_factor", s.time.acceleration_factor, range{1, 1e4}, "Gamma, or \"auto\". The gas is at rest with the bed at every instant, so heat does not feel it; motion does, where DEM makes it. auto: the largest at which the bed moves quasi-statically, a fifth of sqrt(g d) (120 for stones of the paper's furnace)");
    key("time", "acceleration_tolerance", s.time.acceleration_tolerance, range{1e-6, 1}, "Error of a stone's temperature, over the step of the gas's that it follows, that auto allows Gamma to cause");
    key("time", "couplings", s.time.couplings, range{1, 1e7}, "Exchanges between gas and bed in all");
    key("time", "residence_times", s.time.residence_times, range{1e-6, 1000}, "Process time over the residence time of the solids; a little less where whole couplings are to make a turn of a recorded motion");
    key("time", "first_step_factor", s.time.first_step_factor, range{1, 100}, "Steps of the first half of the couplings over those of the second: long ones first, for the shaft settles within hours, and short ones then, for exactness");
    key("time", "steadying_interval", s.time.steadying_interval, range{0, 1e7}, "Couplings after which what the bed still stores is taken from it by a step of Newton's in the one-dimensional model, for its slowest mode takes a residence time; 0: never, as in a transient that is to be followed");
    key("time", "start", s.time.start, range{}, "Where the temperatures start from");
    key("time", "balance_tolerance", s.time.balance_tolerance, range{1e-6, 1}, "Enthalpy imbalance over fuel power at which the run is converged");

    key("output", "checkpoint_interval_s", s.output.interval, range{0, 1e6}, "Wall time between checkpoints; 0: after every step");
    key("output", "frames", s.output.frames, range{0, 1e5}, "Frames of the time series for ParaView");
    key("output", "picture", s.output.picture, range{}, "Draw the pictures at the end, with python3-matplotlib");
    key("output", "seed", s.output.seed, range{0, inf}, "Seed of the feed and of random packings");

    key("particles.size", s.particles.sizes, size_members);
    key("wall.zone", s.shaft.zones, zone_members);
}

}  // namespace hearth::furnace
