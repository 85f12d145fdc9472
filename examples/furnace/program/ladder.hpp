// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command_line.hpp"

namespace hearth::furnace::program {

/// Runs a scene of any kind but "furnace" and returns the exit code.  Throws bad_scene, io::file_error.
int climb(const command_line& command);

/// Every key of a kind of scene, with its default, meaning and range.  Throws bad_scene for a kind that does not exist.
std::string keys_of_kind(const std::string& kind);

}  // namespace hearth::furnace::program
