// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <hearth/dem/particles.hpp>

namespace hearth::dem::detail {

/// One to one from the spheres `to` to as many spheres `from`, near ones and of like size: of each of `to`, its partner.
/// A difference of radii counts as `size_weight` times as long a way.  Halving both sets again and again along their
/// longest side, then exchanges between neighbours as long as they shorten the sum of squared ways; the same on every run.
std::vector<index> matched(const std::vector<sphere>& from, const std::vector<sphere>& to, double size_weight);

}  // namespace hearth::dem::detail
