// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/furnace/ranks.hpp>

#include "command_line.hpp"

namespace hearth::furnace::program {

/// Makes the run that the command line asks for and returns the exit code, the same on every rank.  Throws bad_scene,
/// io::file_error.
int run(const command_line& command, const ranks& among);

}  // namespace hearth::furnace::program
