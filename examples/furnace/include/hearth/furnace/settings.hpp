// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// The reference furnace: a shaft in which gas burns inside a moving bed of stones.
namespace hearth::furnace {

/// A scene file, an option or a setting is wrong: says where, what was given and what is allowed.
struct bad_scene : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A share of the particles with one diameter.
struct size_class {
    double diameter;    ///< [m]
    double mass_share;  ///< [-], all shares sum to 1
};

/// A stretch of the shaft's wall with its own heat loss.
struct wall_zone {
    double from;                 ///< height of its lower end [m]
    double to;                   ///< height of its upper end [m]
    double transmittance;        ///< U from the inner face to the ambient [W/(m^2 K)]
    double ambient_temperature;  ///< [K]
};

/// A number that may be left to the program.
struct number_or_auto {
    number_or_auto(double given) : value(given) {}
    operator double() const { return value; }

    double value;
    bool automatic = false;
};

enum class bed_motion { dem, recorded, plug, frozen };
enum class burning { none, mixed_is_burnt, equilibrium, jones_lindstedt };
enum class gas_mixing { at_once, bed };
enum class voidage_method { filtered, vfs };
enum class bed_packing { dem, lattice, dense };
enum class burner_feed { nozzles, section };
enum class start_from { one_dimensional, cold };

/// Everything that a scene says, in SI units.  The defaults are the furnace of the paper (Spijker, Pollhammer and
/// Raupenstrauch 2023, doi:10.1002/ceat.202200617); what the paper leaves open is marked "assumed" in describe.hpp.
struct settings {
    static constexpr const char* kind = "furnace";  ///< of scene; see rung.hpp for the others

    std::string title = "shaft furnace";

    struct {
        double height = 10;
        double diameter = 0.85;
        double hopper_height = 1;          ///< of the free space between bed and hopper
        double hopper_fill = 0;            ///< height to which stones stand in the hopper, at the shaft's diameter
        double offgas_pipe_diameter = 0.3;
        std::vector<wall_zone> zones{{0, 10, 3, 320}};
    } shaft;

    struct {
        double mass_flow = 3000.0 / 3600.0;
        double feed_temperature = 300;
        double density = 3580;
        double emissivity = 1;
        std::vector<size_class> sizes{{16e-3, 0.2}, {17e-3, 0.3}, {18e-3, 0.3}, {19.5e-3, 0.2}};
    } particles;

    struct {
        double volume_flow = 2000.0 / 3600.0;  ///< at 273.15 K and 101325 Pa [m^3/s]
        double temperature = 300;
    } air;

    struct {
        burner_feed feed = burner_feed::nozzles;
        int count = 12;
        double diameter = 15e-3;
        double height = 8;
        double mass_flow = 0.207;          ///< of all burners, fuel and air [kg/s]
        double equivalence_ratio = 1;
        double temperature = 300;
    } burners;

    struct {
        double pressure = 1e5;
        double ignition_temperature = 2000;
    } gas;

    struct {
        bed_packing packing = bed_packing::dem;
        bed_motion motion = bed_motion::recorded;
        double coarse_graining = 4;
        double void_fraction = 0.418;      ///< of a bed that is not packed by DEM
        double softened_modulus = 3.77e8;
        double modulus = 2e11;
        double poisson_ratio = 0.26;
        double friction = 0.52;
        double restitution = 0.3;
        double recorded_diameters = 3;     ///< by which the bed sinks while DEM is recorded
        double recording_acceleration_factor = 200;  ///< Gamma of the recorded motion
    } bed;

    struct {
        voidage_method method = voidage_method::filtered;
        double threshold = 0.74;
        double width_in_diameters = 0.5;
        double exchange_width_in_diameters = 0.15;
    } voidage;

    struct {
        int across = 24;
        double axial_size = 0.05;
        double axial_size_bottom = 0.02;
        double axial_size_burners = 0.02;
    } mesh;

    struct {
        bool radiation = true;
        bool conduction = true;
        bool nitric_oxide = true;
        burning combustion = burning::equilibrium;
        gas_mixing mixing = gas_mixing::at_once;  ///< of gas that burns at finite rates
    } physics;

    struct {
        number_or_auto acceleration_factor = 678;  ///< Gamma; the furnace replaces auto by what it stands for
        double acceleration_tolerance = 0.01;      ///< that auto allows [-]
        int couplings = 360;
        double residence_times = 6;
        double first_step_factor = 1;      ///< steps of the first half of the couplings over those of the second
        int steadying_interval = 0;        ///< couplings between two leaps towards the steady state; 0: none
        start_from start = start_from::one_dimensional;
        double balance_tolerance = 0.01;   ///< enthalpy imbalance over fuel power at which a run is converged
    } time;

    struct {
        double interval = 60;              ///< wall time between checkpoints [s]
        int frames = 20;                   ///< of the time series
        bool picture = true;               ///< drawn at the end
        std::uint64_t seed = 1;
    } output;
};

/// Where a value came from, for messages: "furnace.toml:12" or "--set".
using origin = std::string;

/// Reads a scene file; keys that it does not name keep their defaults.  Throws bad_scene.
settings read_scene(const std::string& path);
/// The same from text, as a scene file would hold it.
settings parse_scene(const std::string& text, const origin& where = "scene");
/// Applies each `key=value`, the value as in a scene file, then checks the whole scene: their order is of no account.
/// Throws bad_scene, and changes nothing then.
void set_keys(settings& scene, const std::vector<std::string>& assignments);
/// Checks what a single key cannot tell: zones that overlap, burners above the shaft, shares that do not sum to 1.
void check(const settings& scene);
/// The scene as a file that read_scene reads back, with the meaning and range of every key.
std::string document(const settings& scene);
/// FNV-1a of all values: two runs with the same hash had the same scene.
std::uint64_t hash(const settings& scene);

}  // namespace hearth::furnace
