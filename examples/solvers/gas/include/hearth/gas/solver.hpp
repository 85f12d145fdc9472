// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include <hearth/gas/array.hpp>
#include <hearth/gas/boundary.hpp>
#include <hearth/gas/fields.hpp>
#include <hearth/gas/flow.hpp>
#include <hearth/gas/model.hpp>
#include <hearth/gas/transport.hpp>
#include <hearth/gas/turbulence.hpp>

namespace hearth::gas {

struct solver_settings {
    double reference_pressure = 1.01325e5;  ///< flow.pressure is the difference to it [Pa]
    vector3 gravity{0, 0, -9.81};           ///< [m/s^2]
    double bed_threshold = 0.1;             ///< solid fraction above which a cell is bed: drag, no turbulence [-]
    drag_function drag = make_drag(closure::ergun{});
    bool energy = true, species = true, turbulence = true;
    double dispersion = 1.0 / 11;           ///< in the bed: rho D = dispersion * G * d, G the superficial mass flux [-]
    double turbulent_prandtl = 0.85;        ///< also the turbulent Schmidt number; Lewis number 1 throughout [-]
    /// The term e dp/dt of the enthalpy in transients.  Off, as in Eq. 11 of the paper: at low Mach number it is sound.
    bool pressure_work = false;
    double energy_relaxation = 0.9;         ///< of enthalpy and species between outer iterations, (0, 1] [-]
    k_epsilon::constants turbulence_constants;
    flow_settings flow;
    solve_settings scalars{1e-3, 0, 300};
    double tolerance = 1e-6;                ///< change per outer iteration at which a solution counts as converged [-]
    int max_iterations = 2000;              ///< outer iterations of steady()
    int max_inner = 200;                    ///< outer iterations of one time step
};

/// What goes in and out of one conserved quantity in the last iteration or step, and what is missing.
struct balance {
    double in = 0, out = 0;      ///< through boundaries [kg/s] or [W]
    double source = 0;           ///< from cells: nozzles, reaction, particles, walls; positive into the gas
    double stored = 0;           ///< rate of storage times its factor
    double turnover = 0;         ///< the largest of in, out, and the sums of |source| and |stored| over the cells
    double error = 0;            ///< |in - out + source - stored| over the turnover [-]
};

/// How an iteration, a steady solution or a time step ended.
struct report {
    int iterations = 0;
    bool converged = false;
    bool broken = false;             ///< a field became infinite; a time step then leaves the state as it was
    std::string reason;              ///< empty where converged, else why not
    flow_report flow;
    double temperature_change = 0;   ///< of the last iteration, greatest [K]
    double species_change = 0;       ///< greatest [-]
    double turbulence_change = 0;    ///< rms over rms [-]
    std::int64_t turbulence_floored = 0;   ///< free cells whose k or epsilon the last iteration lifted to its least value
    std::int64_t eddy_viscosity_capped = 0;  ///< free cells that hold the greatest eddy viscosity allowed
    std::int64_t pressure_floored = 0;     ///< cells whose density counts a tenth of the reference pressure
    int scalar_iterations = 0;
    std::int64_t temperature_limited = 0;  ///< cells whose enthalpy lies outside the gas model's range
    std::int64_t backflow_faces = 0;       ///< outlet faces through which gas comes in
    balance mass, enthalpy;
    array<balance> species;
};

/// Gas in a packed bed and in the free space around it: low-Mach flow, enthalpy, species, turbulence.
///
///     solver gas(mesh, std::make_shared<simple_gas>());
///     gas.set("bottom", mass_flow_inlet(0.7, {300}));
///     gas.set("top", pressure_outlet(1e5));
///     gas.bed.void_fraction = ...;
///     gas.initialise(300);
///     report r = gas.steady();
///
/// Patches that are not set are adiabatic walls without slip.  The normal slope of the void fraction is taken as zero at
/// boundaries.
class solver {
  public:
    solver(const mesh& m, std::shared_ptr<const gas_model> model, solver_settings settings = {},
           const parallel& ranks = single_rank());

    /// Sets the condition of a patch.  Throws std::invalid_argument on an unknown patch or a bad value.
    void set(const std::string& patch, const patch_condition& condition);
    /// Adds a nozzle to the sources of its cell.
    void add(const nozzle& n);

    /// Resting gas of one temperature [K] and composition.
    void initialise(double temperature, const array<double>& mass_fraction = {1.0});

    /// Darcy-Forchheimer flow: resistance and body forces only; always possible, the start of everything else.
    report level_zero(int iterations = 8);
    /// One steady outer iteration of everything that is switched on.
    report iterate();
    /// The same of species and enthalpy alone, in the flow as it is: for hosts that exchange heat more often than it moves.
    report iterate_scalars();
    /// Iterates until nothing changes by more than the tolerance.
    report steady();
    /// One implicit time step [s].  The fields of the bed are those at its end.  `storage` multiplies the storage of mass,
    /// enthalpy and species (time scale splitting).
    report step(double dt, double storage = 1);

    const mesh& grid() const { return *mesh_; }
    const gas_model& model() const { return *model_; }
    double absolute_pressure(int cell) const { return settings.reference_pressure + gas.flow.pressure[cell]; }
    /// Mass flow out of the domain through a patch [kg/s].
    double mass_flow(const std::string& patch) const;
    /// Mean temperature of what leaves through a patch, weighted by mass flow [K].
    double mean_temperature(const std::string& patch) const;
    /// Mean pressure on a patch, taken from its cells, weighted by area, absolute [Pa].
    double mean_pressure(const std::string& patch) const;

    /// Temperature and density of each cell from enthalpy, composition and pressure; call it after changing those.
    void update_properties();

    /// Shows what the next iteration depends on beside gas, bed, sources and settings: part(name, array or number).  A
    /// checkpoint holds it too.
    template <class Part>
    void each_memory(Part&& part) {
        part("wall_viscosity", boundary_.wall_viscosity);
        part("old_void", old_void_);
        flow_.each_memory(part);
    }
    /// Builds the coarse levels of the multigrid anew at the next iteration.  They are the one thing that cannot be saved:
    /// who restarts bit for bit calls this at moments that do not depend on when a checkpoint was made.
    void forget_levels() { flow_.forget_levels(); }

    gas_fields gas;
    bed_fields bed;
    source_fields sources;
    solver_settings settings;

    static const parallel& single_rank();

  private:
    struct scalar_boundary { array<double> temperature, enthalpy, fixed, kinetic, dissipation; };
    const double* composition(int cell) const { return &gas.mass_fraction[species_ * cell]; }
    void check_bed() const;
    void take_bed();
    double density_pressure(int cell) const;
    std::int64_t update_density();
    void update_medium();
    void update_diffusivity();
    void solve_enthalpy(report& r, const gas_fields* before, double dt, double storage);
    void solve_species(report& r, const gas_fields* before, double dt, double storage);
    void check_balances(report& r, const gas_fields* before, double dt, double storage) const;
    void inner_iteration(report& r, const flow_history& history, const gas_fields* before);
    bool is_settled(report& r) const;
    void confirm(report& r) const;
    void start_from_rest();
    double through_flow_rate() const;

    const mesh* mesh_;
    std::shared_ptr<const gas_model> model_;
    const parallel* ranks_;
    int species_;
    pattern pattern_;
    gradient gradients_;
    workspace work_;
    flow flow_;
    transport scalars_;
    k_epsilon turbulence_;
    flow_medium medium_;
    flow_boundary boundary_;
    scalar_boundary scalar_boundary_;
    array<array<double>> boundary_fraction_;   // per species, per boundary face
    array<double> face_conductance_, face_source_;         // of walls, per boundary face [W/K], [W]
    array<double> boundary_diffusion_, old_void_;
    array<double> stored_density_;  // that the balance of mass of the last iteration ended with [kg/m^3]
    array<char> free_;
};

}  // namespace hearth::gas
