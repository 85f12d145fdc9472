// SPDX-License-Identifier: MIT
#pragma once


#include <hearth/gas/array.hpp>
#include <hearth/gas/gradient.hpp>
#include <hearth/gas/linear.hpp>
#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// What drives and resists the flow, handed in before each outer iteration.  Fields per cell with ghosts.
struct flow_medium {
    view<double> density;             ///< [kg/m^3]
    array<double> compressibility;    ///< d(density)/d(pressure) [kg/(m^3 Pa)]; of time steps only
    view<double> void_fraction;       ///< [-]
    view<double> viscosity;           ///< effective; 0 in the bed, where the drag holds all friction [Pa s]
    array<double> exchange;           ///< drag on the particles per slip of the interstitial gas [kg/(m^3 s)]
    view<vector3> particle_velocity;  ///< empty: they rest [m/s]
    array<double> mass_source;        ///< [kg/s] per cell
    view<vector3> momentum_source;    ///< with the mass source, and any other force; empty: none [N] per cell
    vector3 gravity;                        ///< [m/s^2]
};

/// Conditions per boundary face.
struct flow_boundary {
    enum class kind : unsigned char { inlet, outlet, wall, slip };
    array<kind> type;
    array<double> mass_flux;      ///< inlet: out of the domain, so negative [kg/s]
    array<double> pressure;       ///< outlet: above the reference [Pa]
    array<vector3> velocity;      ///< superficial; inlet and wall [m/s]
    array<double> wall_viscosity; ///< wall: effective, from the wall function [Pa s]
};

/// The state of the flow.
struct flow_state {
    array<double> pressure;       ///< above the reference, per cell [Pa]
    array<vector3> velocity;      ///< superficial, per cell [m/s]
    array<double> mass_flux;      ///< through each face, from owner to neighbour [kg/s]
    array<vector3> pressure_gradient;  ///< per cell, consistent with the fluxes [Pa/m]
};

/// What a time step keeps of the step before.  step = 0: steady, and always so without inertia.
struct flow_history {
    double step = 0;                    ///< [s]
    double storage = 1;                 ///< factor s on the storage of mass (time scale splitting) [-]
    view<double> density, void_fraction, mass_flux;
    view<vector3> velocity;
};

struct flow_settings {
    /// Of the momentum equation, (0, 1]; the steady result does not depend on it.  0.9 is faster where friction rules,
    /// above 0.8 free jets at high Reynolds number may not settle. [-]
    double relaxation = 0.7;
    bool inertia = true;                ///< false: Darcy-Forchheimer, only resistance and body forces
    /// Least resistance [kg/(m^3 s)].  Without inertia it is what gas outside the bed feels; with inertia it only relaxes.
    double resistance_floor = 1e-3;
    int momentum_sweeps = 2;            ///< Gauss-Seidel sweeps over the three components
    solve_settings pressure{0.05, 0, 200};
};

struct flow_report {
    double mass_imbalance = 0;          ///< before the pressure solve: sum of |net flux| over the through-flow [-]
    double velocity_change = 0;         ///< of this iteration, rms over rms (1e-9 m/s at least) [-]
    double pressure_change = 0;         ///< rms over the range of pressures [-]
    solve_report pressure;
};

/// Momentum and pressure: SIMPLEC (Van Doormaal & Raithby 1984, doi:10.1080/01495728408961817) for the superficial
/// velocity w = void fraction * u of a gas in a bed.
///
/// Momentum over the void fraction e, so that the pressure gradient stands bare (model A, Bernoulli across jumps of e):
///     (1/e) [ rho e du/dt + rho w.grad u - div(mu grad w) ] = -grad p + rho g - (beta / e)(u - v).
///
/// Each face carries the momentum equation integrated from one cell centre to the other, the coefficients of each cell
/// over that cell's part of the way; the mass flux per area is the same on both sides.  So a resistance that jumps
/// acts harmonically, Ergun's column comes out exactly, a resting gas rests, and pressures cannot alternate.  The cell's
/// velocity is rebuilt from its face fluxes, and the pressure gradient of the cell is the one that these satisfy.
class flow {
  public:
    flow(const mesh& m, const pattern& p, const gradient& g, const parallel& ranks, workspace& work);

    flow_state make_state() const;

    /// One outer iteration: predicts the velocity, solves the pressure, corrects the fluxes.
    flow_report iterate(flow_state& state, const flow_medium& medium, const flow_boundary& boundary,
                        const flow_history& history, const flow_settings& settings);

    /// Velocity gradients of the last iteration, three vectors per cell; gone once a scalar is solved. [1/s]
    const array<vector3>& velocity_gradient() const { return work_->gradient; }

    /// See solver.
    template <class Part>
    void each_memory(Part&& part) {
        part("pressure_slope", slope_);
    }
    void forget_levels() { pressure_solver_.forget(); }

  private:
    /// What a time step resists with against the interstitial flux of its cell [kg/(m^3 s)].
    static double step_inertia(int cell, const flow_medium&, const flow_history&);
    void assemble_momentum(const flow_state&, const flow_medium&, const flow_boundary&, const flow_history&,
                           const flow_settings&);
    void add_convection_and_diffusion(const flow_state&, const flow_medium&, const flow_boundary&);
    void predict(flow_state&, const flow_medium&, const flow_history&, const flow_settings&);
    void assemble_pressure(flow_state&, const flow_medium&, const flow_boundary&, const flow_history&);
    void correct(flow_state&, const flow_medium&, const flow_history&, bool inertia);
    void find_pressure_slope(const flow_state&, const flow_medium&, const flow_boundary&, const flow_settings&);

    const mesh* mesh_;
    const pattern* pattern_;
    const gradient* gradients_;
    const parallel* ranks_;
    workspace* work_;
    symmetric_solver pressure_solver_;
    // In the workspace: source_ of momentum, without the pressure gradient [N / e]; drive_, forces of the neighbours and
    // sources, the cell's own share taken off [N/m^3]; the previous velocity.
    array<vector3>&source_, &drive_, &previous_;
    array<double>& inverse_void_;
    array<vector3> boundary_velocity_;
    array<double> resistance_;          // diagonal without couplings, relaxation and inertia [kg/s]
    array<double> relax_;               // what relaxation adds to it; then both per volume [kg/(m^3 s)]
    array<double> outlet_conductance_;  // per boundary face [m s]; before that, the pressure from the cell to the face [Pa]
    array<double> previous_pressure_;
    array<vector3> slope_;              // of the pressure, where the mesh leans [Pa/m]
};

}  // namespace hearth::gas
