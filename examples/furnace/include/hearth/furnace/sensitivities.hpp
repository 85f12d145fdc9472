// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/settings.hpp>
#include <hearth/furnace/shaft_profile.hpp>

namespace hearth::furnace {

/// What one input does to a furnace: its one-dimensional solution with less and with more of it.
struct sensitivity {
    std::string input;  ///< "burner flow, 0.186 to 0.228 kg/s"
    bool in_paper;      ///< whether the paper says it; the others are assumed
    shaft_profile less, more;
};

/// How the one-dimensional solution of a scene answers to what the paper leaves open, and to the flows of solids and air, which it
/// says; each alone, about the value of the scene.  Some seconds.  Throws bad_scene for a scene that has none.
std::vector<sensitivity> sensitivities(const settings& scene);

}  // namespace hearth::furnace
