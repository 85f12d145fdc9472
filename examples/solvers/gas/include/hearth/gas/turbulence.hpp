// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

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
    struct iteration {
        double change = 0;           ///< rms change of k over its rms [-]
        std::int64_t floored = 0;    ///< free cells whose k or epsilon fell below `least` and was lifted to it
        std::int64_t capped = 0;     ///< free cells whose eddy viscosity was held at `greatest_ratio`
    };
    static constexpr double greatest_ratio = 1e5;  ///< of eddy to laminar viscosity: where epsilon has not grown yet [-]
    static constexpr double least = 1e-12;  ///< of k [m^2/s^2] and epsilon [m^2/s^3]: limited convection may undershoot

    k_epsilon(const mesh& m, const parallel& ranks, const constants& c);

    /// One implicit pass over k and epsilon, then the eddy viscosity and the wall viscosities of `boundary`.
    /// `free` marks the cells outside the bed.  step 0: steady.
    iteration iterate(gas_fields& gas, const bed_fields& bed, const array<char>& free, transport& scalars,
                      const array<vector3>& velocity_gradient, flow_boundary& boundary,
                      const array<double>& boundary_kinetic, const array<double>& boundary_dissipation,
                      const gas_fields* before, double step);

  private:
    struct wall_face { int face, cell; double distance; };
    void wall_treatment(const gas_fields&, const array<char>& free, flow_boundary&, double* production,
                        double* fixed_dissipation);
    void fix(transport&, int cell, double value) const;

    const mesh* mesh_;
    const parallel* ranks_;
    constants c_;
    array<double> no_diffusion_;  // zero, per boundary face
};

}  // namespace hearth::gas
