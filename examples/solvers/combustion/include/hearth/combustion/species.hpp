// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace hearth::combustion {

/// The gases of four-step methane combustion, as the index of every array below.  Spelled as chemistry prints them.
enum species : std::size_t { CH4, O2, N2, CO, CO2, H2, H2O };
inline constexpr std::size_t species_count = 7;
inline constexpr std::array<const char*, species_count> species_names{"CH4", "O2", "N2", "CO", "CO2", "H2", "H2O"};

/// One number per species: mass fractions [-], mole fractions [-], or amounts [mol/kg] of a kilogram of mixture.
using per_species = std::array<double, species_count>;

/// Elements, as the index of `atoms`.
enum element : std::size_t { carbon, hydrogen, oxygen, nitrogen };
inline constexpr std::size_t element_count = 4;
using per_element = std::array<double, element_count>;

/// Atoms of each element in a molecule [-].
inline constexpr std::array<per_element, species_count> atoms{
    {{1, 4, 0, 0}, {0, 0, 2, 0}, {0, 0, 0, 2}, {1, 0, 1, 0}, {1, 0, 2, 0}, {0, 2, 0, 0}, {0, 2, 1, 0}}};

/// Atomic masses of GRI-Mech 3.0's elements [kg/mol].
inline constexpr per_element atomic_mass{0.0120107, 0.00100794, 0.0159994, 0.0140067};

/// Molar mass [kg/mol], summed from the atoms, so that a reaction keeps the mass to round-off.
/// (Tables often print 16.0425e-3 for CH4, 2.5e-6 more than its atoms; that much mass would be lost in each reaction.)
inline constexpr per_species molar_mass = [] {
    per_species mass{};
    for (std::size_t k = 0; k < species_count; ++k)
        for (std::size_t e = 0; e < element_count; ++e) mass[k] += atoms[k][e] * atomic_mass[e];
    return mass;
}();

/// Amounts [mol/kg] of a mixture given by mass fractions [-].
constexpr per_species amounts(const per_species& mass_fraction) {
    per_species n{};
    for (std::size_t k = 0; k < species_count; ++k) n[k] = mass_fraction[k] / molar_mass[k];
    return n;
}

/// Mass fractions [-] of a mixture given by its amounts [mol/kg].
constexpr per_species mass_fractions(const per_species& amount) {
    per_species y{};
    for (std::size_t k = 0; k < species_count; ++k) y[k] = amount[k] * molar_mass[k];
    return y;
}

/// The sum over the species; of amounts it is the reciprocal of the mean molar mass [mol/kg].
constexpr double sum(const per_species& x) {
    double s = 0;
    for (const double v : x) s += v;
    return s;
}

/// Mole fractions [-] of a mixture given by its amounts [mol/kg] or by any multiple of them.
constexpr per_species mole_fractions(per_species amount) {
    const double total = sum(amount);
    for (double& n : amount) n /= total;
    return amount;
}

/// Amounts [mol/kg] of a mixture given by mole fractions, which need not be normalised: parts by volume will do.
constexpr per_species amounts_from_moles(per_species parts) {
    double mass = 0;
    for (std::size_t k = 0; k < species_count; ++k) mass += parts[k] * molar_mass[k];
    for (double& n : parts) n /= mass;
    return parts;
}

/// Amounts of the elements [mol/kg] in a mixture given by its amounts [mol/kg].
constexpr per_element element_amounts(const per_species& amount) {
    per_element b{};
    for (std::size_t k = 0; k < species_count; ++k)
        for (std::size_t e = 0; e < element_count; ++e) b[e] += atoms[k][e] * amount[k];
    return b;
}

}  // namespace hearth::combustion
