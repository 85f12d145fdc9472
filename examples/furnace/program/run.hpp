// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"

namespace hearth::furnace::program {

/// Makes the run that the command line asks for and returns the exit code.  Throws bad_scene, io::file_error.
int run(const command_line& command);

}  // namespace hearth::furnace::program
