// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <hearth/furnace/ranks.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/shaft_profile.hpp>
#include <hearth/furnace/snapshot.hpp>
#include <hearth/furnace/summary.hpp>

namespace hearth::furnace {

/// Where a run is.  A scene without DEM has nothing to fill; one that starts from the one-dimensional solution ignites
/// at once.
enum class phase {
    fill,      ///< DEM fills the shaft and records how the bed moves
    ignite,    ///< first gas flow and temperatures
    couple,    ///< the planned couplings of gas and bed
    converge,  ///< more of them, until the balance of enthalpy holds and the outlets stand still
    report     ///< nothing is left to do
};
constexpr const char* name(phase p) {
    constexpr const char* names[] = {"fill", "ignite", "couple", "converge", "report"};
    return names[static_cast<int>(p)];
}

/// What a person watches.  Powers are rates by the process's clock.
struct status {
    phase now = phase::fill;
    double share_done = 0;                 ///< of the present phase, 0 to 1 [-]
    double share_of_run = 0;               ///< of all, by expected run time, 0 to 1 [-]
    int couplings = 0;                     ///< so far
    double process_time = 0;               ///< [s]
    double fill_level = 0;                 ///< of the bed in the fill phase [m]
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

/// What a scene will build and cost, before anything is built.
struct plan {
    std::int64_t cells = 0, parcels = 0, particles = 0;  ///< of the shaft; particles: stones that the parcels stand for
    std::int64_t waiting = 0;                            ///< parcels in the hopper
    int couplings = 0;
    double motion_steps = 0;  ///< of DEM in a coupling, where it moves the bed all the time
    double memory = 0;   ///< of all ranks together [bytes]
    double seconds = 0;  ///< of one core like those that this was measured on, +-50 % [s]
    struct omission {
        std::string what;     ///< physics that the scene leaves out
        std::string because;  ///< the key that says so
        std::string saves;    ///< memory or work
    };
    std::vector<omission> left_out;
};
/// On so many ranks, each of which knows the mesh and where everybody is.  Throws bad_scene for a scene that cannot be built.
plan foresee(const settings& scene, int ranks = 1);

/// The reference furnace as a library: a scene becomes a furnace, which steps and can be looked at.
///
///     hearth::furnace::furnace shaft(hearth::furnace::read_scene("column.toml"));
///     while (!shaft.done()) shaft.step();
///     const auto end = shaft.summarise();
///
/// On several ranks the cells of the gas and the work on the bed are shared.  All ranks make the same calls in the same order;
/// what is asked of the furnace as a whole is told to each of them.
///
/// Throws bad_scene for a scene that it cannot run.
class furnace {
  public:
    explicit furnace(const settings& scene, const ranks& among = {});
    ~furnace();
    furnace(furnace&&) noexcept;

    /// A piece of the present phase, below a second or so of work in the scenes that come with it: some steps of DEM, or
    /// one coupling, in which the bed moves and gas and particles exchange for the process time between couplings.
    void step();
    phase current() const;
    int steps_done() const;     ///< couplings so far
    int steps_planned() const;  ///< couplings of the couple phase
    bool done() const { return current() == phase::report; }

    const settings& scene() const;
    status now() const;
    snapshot look() const;  ///< on several ranks its cells are told to rank 0 alone
    cell_shapes cells() const;
    axial_profile axial(int slices = 100) const;
    summary summarise() const;
    const shaft_profile& profile() const;  ///< the one-dimensional solution of the scene

    /// Changes the burners while the furnace runs: premixed gas of all burners [kg/s].
    void set_burner_flow(double mass_flow);

    /// For checkpoints; between two steps, in any phase.  This rank's part.
    saved_state save() const;
    /// Into a furnace of the same settings, on every rank the whole state.  Throws bad_scene, with the furnace as it was, for a state of another scene or
    /// one that lacks something.
    void restore(const saved_state& state);

  private:
    struct parts;
    std::unique_ptr<parts> parts_;
};

}  // namespace hearth::furnace
