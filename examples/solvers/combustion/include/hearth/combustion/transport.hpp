// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <hearth/combustion/species.hpp>
#include <hearth/combustion/thermo.hpp>

namespace hearth::combustion {

/// Molecular transport of a mixture.
struct transport_properties {
    double viscosity;         ///< dynamic [Pa s]
    double conductivity;      ///< [W/(m K)]
    per_species diffusivity;  ///< of each species into the mixture, for fluxes -rho D grad Y [m^2/s]
};

namespace detail {

constexpr double square_root(double x) {  // constexpr, for the tables below
    double r = x > 1 ? x : 1.0;
    for (int i = 0; i < 60; ++i) r = 0.5 * (r + x / r);
    return r;
}
constexpr double cube_root(double x) {
    double r = x > 1 ? x : 1.0;
    for (int i = 0; i < 120; ++i) r = (2 * r + x / (r * r)) / 3;
    return r;
}

/// Lennard-Jones diameter [1e-10 m], well depth over k [K], its power 0.14874, and Stockmayer's delta^2 (of the dipole
/// of water, 1.844 D) [-]: GRI-Mech 3.0, transport.dat.
struct molecule {
    double diameter, depth, depth_power, polarity;
};
// clang-format off
inline constexpr std::array<molecule, species_count> molecules{{
    {3.746, 141.40, 2.088612, 0},
    {3.458, 107.40, 2.004895, 0},
    {3.621, 97.53, 1.976353, 0},
    {3.650, 98.10, 1.978066, 0},
    {3.763, 244.00, 2.265168, 0},
    {2.920, 38.00, 1.717817, 0},
    {2.605, 572.40, 2.571463, 1.4811}}};
// clang-format on

/// Diffusion volumes: Fuller, Schettler & Giddings; Poling, Prausnitz & O'Connell, 5th ed., table 11-1.  [cm^3/mol]
inline constexpr per_species diffusion_volume{25.14, 16.3, 18.5, 18.0, 26.9, 6.12, 13.1};

using pair_table = std::array<per_species, species_count>;

/// Fuller's D p / T^1.75 [m^2 Pa / (s K^1.75)].
inline constexpr pair_table fuller = [] {
    pair_table d{};
    for (std::size_t i = 0; i < species_count; ++i)
        for (std::size_t j = 0; j < species_count; ++j) {
            const double reach = cube_root(diffusion_volume[i]) + cube_root(diffusion_volume[j]);
            d[i][j] =
                1e-7 * standard_pressure * square_root(1e-3 / molar_mass[i] + 1e-3 / molar_mass[j]) / (reach * reach);
        }
    return d;
}();

/// Wilke's weights without the viscosities: 1/sqrt(8 (1 + M_i/M_j)).
inline constexpr pair_table wilke = [] {
    pair_table w{};
    for (std::size_t i = 0; i < species_count; ++i)
        for (std::size_t j = 0; j < species_count; ++j)
            w[i][j] = 1 / square_root(8 * (1 + molar_mass[i] / molar_mass[j]));
    return w;
}();

inline constexpr per_species fourth_root_of_mass = [] {
    per_species r{};
    for (std::size_t k = 0; k < species_count; ++k) r[k] = square_root(square_root(molar_mass[k]));
    return r;
}();

}  // namespace detail

/// Viscosities of the pure gases by kinetic theory, 5/16 sqrt(pi m k T) / (pi d^2 Omega), with the collision integral
/// of Neufeld, Janzen & Aziz, J. Chem. Phys. 57 (1972) 1100, doi:10.1063/1.1678363, for 0.3 < T k/depth < 100, and
/// Brokaw's term for polar gases.  Within 3 % of tabulated values at 300 and 600 K, water within 8 %.  [Pa s]
inline per_species viscosities(double temperature) {
    const double power = std::pow(temperature, -0.14874), root_t = std::sqrt(temperature);
    per_species mu;
    for (std::size_t k = 0; k < species_count; ++k) {
        const detail::molecule& m = detail::molecules[k];
        const double t = temperature / m.depth;
        const double omega = 1.16145 * power * m.depth_power + 0.52487 * std::exp(-0.77320 * t) +
                             2.16178 * std::exp(-2.43787 * t) + 0.2 * m.polarity / t;
        const double root_mass = detail::fourth_root_of_mass[k] * detail::fourth_root_of_mass[k];
        mu[k] = 8.4411e-5 * root_mass * root_t / (m.diameter * m.diameter * omega);
    }
    return mu;
}

namespace detail {

/// How much each gas of a mixture is hindered by all: Wilke's sum over j of x_j phi_ij, 1 in a pure gas [-].
inline per_species crowding(const per_species& mu, const per_species& x) {
    per_species r, sum{};  // r: sqrt(mu) M^-1/4
    for (std::size_t k = 0; k < species_count; ++k) r[k] = std::sqrt(mu[k]) / fourth_root_of_mass[k];
    for (std::size_t i = 0; i < species_count; ++i)
        for (std::size_t j = 0; j < species_count; ++j) {
            const double q = 1 + r[i] / r[j];
            sum[i] += x[j] * q * q * wilke[i][j];
        }
    return sum;
}

}  // namespace detail

/// Viscosity of a mixture at a temperature [K] and mole fractions [-]; all positive, not checked.  [Pa s]
/// Wilke, J. Chem. Phys. 18 (1950) 517, doi:10.1063/1.1747673.
inline double viscosity(double temperature, const per_species& x) {
    const per_species mu = viscosities(temperature), crowd = detail::crowding(mu, x);
    double sum = 0;
    for (std::size_t k = 0; k < species_count; ++k) sum += x[k] * mu[k] / crowd[k];
    return sum;
}

/// Transport of a mixture at a temperature [K], a pressure [Pa] and mole fractions [-]; all positive, not checked.
/// Viscosity: as above.
/// Conductivity: Stiel & Thodos, AIChE J. 10 (1964) 26, doi:10.1002/aic.690100114, (mu/M) (1.15 cv + 2.03 R), for
/// nonpolar gases; for water (mu/M) 1.37 cv, our fit to steam tables from 400 to 1000 K; mixed with Wilke's weights.
/// Diffusivity: Fuller, Schettler & Giddings, Ind. Eng. Chem. 58(5) (1966) 18, doi:10.1021/ie50677a007, for pairs, and
/// 1/D_i = sum_{j != i} x_j/D_ij + x_i/(1 - Y_i) sum_{j != i} Y_j/D_ij in the mixture, which is D_12 in a pair (Kee,
/// Coltrin & Glarborg, Chemically Reacting Flow, 2003, sec. 3.5).
/// Against tables from 300 to 1000 K: conductivity within 7 %, diffusivity of pairs within 10 %.
inline transport_properties transport(double temperature, double pressure, const per_species& x) {
    const per_species mu = viscosities(temperature), crowd = detail::crowding(mu, x);
    const double root = std::sqrt(temperature), t_1_75 = temperature * root * std::sqrt(root);
    transport_properties out{0, 0, {}};
    for (std::size_t i = 0; i < species_count; ++i) {
        const double cv = thermo_table[i].heat_capacity(temperature) - gas_constant;
        const double lambda = mu[i] / molar_mass[i] * (i == H2O ? 1.37 * cv : 1.15 * cv + 2.03 * gas_constant);
        out.viscosity += x[i] * mu[i] / crowd[i];
        out.conductivity += x[i] * lambda / crowd[i];
        double by_moles = 0, by_mass = 0, others = 0;
        for (std::size_t j = 0; j < species_count; ++j) {
            if (j == i) continue;
            const double present = x[j] + 1e-12;  // so that a pure gas has the limit of a nearly pure one
            by_moles += present / detail::fuller[i][j];
            by_mass += present * molar_mass[j] / detail::fuller[i][j];
            others += present * molar_mass[j];
        }
        out.diffusivity[i] = t_1_75 / pressure / (by_moles + x[i] * by_mass / others);
    }
    return out;
}

}  // namespace hearth::combustion
