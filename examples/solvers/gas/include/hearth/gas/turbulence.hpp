// SPDX-License-Identifier: MIT
#pragma once


#include <hearth/gas/array.hpp>
#include <hearth/gas/fields.hpp>
#include <hearth/gas/transport.hpp>

namespace hearth::gas {

/// Standard k-epsilon with wall functions: Launder & Spalding, Comput. Methods Appl. Mech. Eng. 3 (1974) 269,
/// doi:10.1016/0045-7825(74)90029-2.  Solved in free cells only; gas that leaves the bed brings the bed's turbulence.
class k_epsilon {
  public:
    struct constants {
        double c_mu = 0.09, c1 = 1.44, c2 = 1.92, sigma_k = 1.0, sigma_epsilon = 1.3;
        double kappa = 0.41, roughness = 9.8;  ///< log law: u+ = ln(E y+) / kappa
        /// In the bed: fluctuation over interstitial velocity, and length over particle diameter. [-]
        double bed_intensity = 0.2, bed_length = 0.1;
        double relaxation = 0.8;
    };
    k_epsilon(const mesh& m, const gradient& g, const constants& c);

    /// One implicit pass over k and epsilon, then the eddy viscosity and the wall viscosities of `boundary`.
    /// `free` marks the cells outside the bed.  step 0: steady.  Returns the rms change of k over its rms.
    double iterate(gas_fields& gas, const bed_fields& bed, const array<char>& free, transport& scalars,
                   const array<vector3>& velocity_gradient, flow_boundary& boundary,
                   const array<double>& boundary_kinetic, const array<double>& boundary_dissipation,
                   const gas_fields* before, double step);

  private:
    struct wall_face { int face, cell; double distance; };
    void wall_treatment(const gas_fields&, const array<char>& free, flow_boundary&);
    void fix(transport&, int cell, double value) const;

    const mesh* mesh_;
    constants c_;
    array<double> production_, fixed_dissipation_, diffusivity_, no_diffusion_, k_, e_;
};

}  // namespace hearth::gas
