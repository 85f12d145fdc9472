// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <hearth/furnace/furnace.hpp>
#include <hearth/furnace/sensitivities.hpp>

namespace hearth::furnace::program {

/// What a scene will build, what it leaves out, and what that takes: the answer of --dry-run.
std::string expectation(const settings& scene, const plan& planned);

/// The end of a run: quantity | paper | this run | unit, and what each number hangs on that the paper leaves open.
std::string comparison(const settings& scene, const summary& s);

/// What --sensitivities prints.
std::string table_of(const shaft_profile& base, const std::vector<sensitivity>& all);

/// "1 h 05 min", "2 min 10 s", "8 s".
std::string duration(double seconds);

}  // namespace hearth::furnace::program
