// SPDX-License-Identifier: MIT
#pragma once

#include "pair_list.hpp"
#include "store.hpp"
#include "wall_list.hpp"

namespace hearth::dem::detail {

/// Adds the forces of all pairs to the loads and moves their springs on by `step`.  Returns the place in the list of a
/// pair that overlaps by more than `deepest` of the smaller radius, or -1.
std::ptrdiff_t add_pair_forces(const contact_law& law, double step, double deepest, store& particles, pair_list& list);

/// The same for contacts with one wall; the list holds the wall's reaction afterwards.
std::ptrdiff_t add_wall_forces(const contact_law& law, double step, double deepest, store& particles, wall_list& list);

}  // namespace hearth::dem::detail
