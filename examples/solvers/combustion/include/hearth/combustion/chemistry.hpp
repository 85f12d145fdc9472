// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <hearth/combustion/jones_lindstedt.hpp>
#include <hearth/combustion/reactor.hpp>
#include <hearth/combustion/species.hpp>
#include <hearth/core/interval.hpp>

namespace hearth::combustion {

/// How the cells of a flow react.
struct chemistry {
    enum class model {
        finite_rate,    ///< Jones-Lindstedt, integrated
        equilibrium,    ///< equilibrium of the seven species, at once
        mixed_is_burnt  ///< CO2 and H2O, at once
    };
    model kind = model::finite_rate;
    jones_lindstedt mechanism;  ///< its regularisation is used as no less than the absolute tolerance
    tolerance accuracy{1e-3, 1e-6};
    double ignition_temperature = 900;  ///< below, the two models without rates leave a cell as it is [K]
};

/// Cells as arrays of `count` values each.
struct cell_arrays {
    std::size_t count = 0;
    const double* pressure = nullptr;                    ///< [Pa]
    double* temperature = nullptr;                       ///< [K]
    std::array<double*, species_count> mass_fraction{};  ///< of the first cell [-]
    std::size_t stride = 1;                              ///< from cell to cell, of the mass fractions (and their rates)
    const double* mixing_time = nullptr;                 ///< see mixing.hpp; none: mixed at once [s]
};

/// What a call did.
struct chemistry_report {
    std::size_t reacting = 0;        ///< cells that were computed; the others cannot react and cost nothing
    std::size_t failed = 0;          ///< of these, left as they were because the integration did not finish
    std::int64_t first_failed = -1;  ///< index of the first of them
    std::size_t extrapolated = 0;    ///< cells that end above 3500 K, where the thermodynamics is extrapolated
    long steps = 0, rejected = 0, limited = 0;  ///< of the integrations, see `integration`
    double error = 0;  ///< largest over the cells: sum of the estimated errors, in units of the tolerance [-]
    double element_imbalance = 0;   ///< largest over cells and elements: change over all elements of the cell [-]
    double enthalpy_imbalance = 0;  ///< largest over the cells: change over cp T [-]
};

/// Temperatures that a cell may start from.  Above 3500 K, which only fuel with pure or preheated oxygen reaches, the
/// heat capacities of 3500 K are used and the cell is counted.  [K]
constexpr interval temperature_limits() { return {200.0, 6000.0}; }

/// Lets every cell react on its own for dt [s] at constant pressure and enthalpy: temperature and mass fractions become
/// those after dt.  One half of a Strang splitting is this for dt/2, then transport for dt, then this for dt/2 again.
///
/// With mixing times, rates are multiplied by the reacting fraction (PaSR) of the state at the start; the models
/// without rates reach 1 - exp(-dt/mixing time) of their change.
///
/// A cell is left out where it cannot react, which is told from comparisons alone: it is so cold that even the best
/// mixture would change by less than a thousandth of the tolerance in dt; or it has no CH4, CO or H2 and no products
/// that are hot enough to dissociate; or it has nothing but these fuels.
///
/// Throws bad_value, with all cells as they were, where a temperature is outside its limits, a pressure is not
/// positive, a mass fraction is below -1e-9 or the sum of the fractions more than 1e-6 off one, or anything is NaN.
/// Negative fractions above that, round-off of a transport step, count as zero and are passed through unchanged.
[[nodiscard]] chemistry_report advance(const chemistry& settings, double dt, const cell_arrays& cells);

/// The same change as a source, (Y after dt - Y)/dt [1/s], with the cells left as they are: times density, the source
/// of a species equation.  An equation of the enthalpy with formation has none.
[[nodiscard]] chemistry_report mean_rates(const chemistry& settings, double dt, const cell_arrays& cells,
                                          const std::array<double*, species_count>& rate);

}  // namespace hearth::combustion
