// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include <hearth/combustion/jones_lindstedt.hpp>

namespace hearth::combustion {

/// What the mixing time of a cell depends on.
struct mixing_state {
    double solid_fraction = 0;       ///< [-]
    double interstitial_speed = 0;   ///< of the gas against the particles [m/s]
    double particle_diameter = 0;    ///< [m]
    double turbulent_energy = 0;     ///< k [m^2/s^2]
    double dissipation = 0;          ///< of the turbulent energy, epsilon_t [m^2/s^3]
    double effective_viscosity = 0;  ///< kinematic, molecular and turbulent [m^2/s]
};

/// Time in which gas mixes on the small scale, by the regime of the cell.
struct mixing_model {
    double bed_threshold = 0.1;     ///< solid fraction above which a cell is a bed, as for its momentum [-]
    double turbulent_factor = 0.1;  ///< C_mix of the turbulent time, 0.001 to 1 in use [-]

    /// Turbulent: C_mix sqrt(nu_eff/epsilon_t), the geometric mean of the integral and the Kolmogorov time scales for
    /// C_mix = 1 and nu_eff = nu_t (Golovitchev, Nordin et al., SAE 2000-01-1891).  [s]
    /// Without turbulence there is nothing left to mix: 0.
    double turbulent_time(double effective_viscosity, double dissipation) const {
        return dissipation > 0 ? turbulent_factor * std::sqrt(effective_viscosity / dissipation) : 0.0;
    }

    /// Bed: streams meet after a pore, so a pore's length over the interstitial speed, void fraction * d / u.  [s]
    /// No flow, no mixing: infinite.  Own closure, to be seen beside the turbulent time, which a bed does not have.
    static double bed_time(double solid_fraction, double particle_diameter, double interstitial_speed) {
        return interstitial_speed > 0 ? (1 - solid_fraction) * particle_diameter / interstitial_speed
                                      : std::numeric_limits<double>::infinity();
    }

    /// The one of the cell's regime [s].
    double time(const mixing_state& cell) const {
        return cell.solid_fraction > bed_threshold
                   ? bed_time(cell.solid_fraction, cell.particle_diameter, cell.interstitial_speed)
                   : turbulent_time(cell.effective_viscosity, cell.dissipation);
    }
};

/// Time in which the forward steps consume the mixture: steps * c / sum over steps and products of (moles made * rate),
/// as in OpenFOAM's PaSR.  Infinite where nothing reacts.  [s]
inline double chemical_time(const jones_lindstedt& mechanism, double temperature, double pressure,
                            const per_species& x) {
    const step_rates r = rates(mechanism, temperature, pressure, x);
    double made = 0;
    for (std::size_t s = 0; s < step_count; ++s)
        for (const double moles : stoichiometry[s]) made += moles > 0 ? moles * r.forward[s] : 0.0;
    const double concentration = pressure / (gas_constant * temperature);
    return made > 0 ? step_count * concentration / made : std::numeric_limits<double>::infinity();
}

/// Partially stirred reactor: the fraction of a cell that reacts, t_c / (t_c + t_mix), which multiplies every rate.
/// Karlsson & Chomiak; Golovitchev & Nordin, SAE 2000-01-1891.  1 where mixing is instant, 0 where there is none.  [-]
inline double reacting_fraction(double chemical_time, double mixing_time) {
    if (!(mixing_time > 0) || std::isinf(chemical_time)) return 1;
    return std::isinf(mixing_time) ? 0.0 : chemical_time / (chemical_time + mixing_time);
}

}  // namespace hearth::combustion
