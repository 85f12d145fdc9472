// SPDX-License-Identifier: MIT
#pragma once


#include <hearth/gas/array.hpp>
#include <hearth/gas/gradient.hpp>
#include <hearth/gas/linear.hpp>
#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// Whether gas that leaves through a boundary with a given value takes it: where conduction outweighs convection.
inline bool leaves_with_given_value(double mass_flux, double boundary_diffusion) {
    return mass_flux > 0 && boundary_diffusion > mass_flux;
}

/// Convection and diffusion of scalars per mass of gas (enthalpy, mass fractions, k, epsilon), second order and limited.
///
/// In the form F.grad f = div(F f) - f div F, which leaves a uniform f uniform for any fluxes, storage and void fraction,
/// and which is the conservative form wherever the fluxes fulfil the balance of mass.
class transport {
  public:
    transport(const mesh& m, const pattern& p, const gradient& g, const parallel& ranks, workspace& work);

    /// Per cell with ghosts, times density and void fraction [kg/(m s)]; the caller sets it before each assemble().
    array<double>& diffusivity;

    /// Puts convection and diffusion into the matrix: the same for all scalars of one diffusivity.
    ///     mass_flux           per face [kg/s]
    ///     boundary_diffusion  per boundary face: conductance to the boundary value [kg/s]; 0 for most
    void assemble(const array<double>& mass_flux, const array<double>& boundary_diffusion);

    /// The matrix and the right-hand side of one scalar; the caller adds storage and sources, then solves.
    matrix& a;
    array<double>& right;

    /// Three scalars per cell that the caller may use until the next momentum equation.
    double* spare(int i) { return workspace::part(work_->third, i); }

    /// Right-hand side of a scalar: boundary values, limited and non-orthogonal corrections from its present field.
    ///     boundary_value      per boundary face: what inflow brings and what boundary diffusion leads to
    void start(const double* field, const array<double>& boundary_value);

    solve_report solve(double* field, const solve_settings& settings) {
        return solver_.solve(a, right.data(), field, settings);
    }

  private:
    double face_diffusivity(int face) const;

    const mesh* mesh_;
    const pattern* pattern_;
    const gradient* gradients_;
    const parallel* ranks_;
    workspace* work_;
    general_solver solver_;
    const double* mass_flux_ = nullptr;
    const double* boundary_diffusion_ = nullptr;
    array<double> values_;
};

}  // namespace hearth::gas
