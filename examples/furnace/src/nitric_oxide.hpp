// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "shaft_gas.hpp"

namespace hearth::furnace {

/// Thermal NO in the gas as it is: formed and decomposed by cells, carried along the mass fluxes (first-order upwind, no
/// dispersion).  Amount per mass of gas in every cell [mol/kg].
std::vector<double> thermal_nitric_oxide_of(const shaft_gas& shaft);

}  // namespace hearth::furnace
