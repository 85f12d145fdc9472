// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hearth::furnace::program {

/// How the program ends; `furnace --help` lists them.
namespace exit_code {
constexpr int done = 0, failed = 1, bad_input = 2, bad_file = 3, stopped = 128;  // stopped: and the signal's number
}

/// What was asked on the command line.
struct command_line {
    std::string scene;
    std::vector<std::string> assignments;  ///< key=value of --set
    std::string output = "furnace-results";
    std::string restart;                   ///< a checkpoint or a folder of them; empty: from the start
    std::string summary;                   ///< a second place for summary.json; empty: none
    bool dry_run = false, quiet = false, sensitivities = false;
};

/// Reads the command line; where it holds no run to be made (--help, --version, a mistake) it prints what there is to say
/// and returns the exit code; `tells`: whether this rank prints.
struct command_or_exit {
    std::optional<command_line> command;
    int exit = 0;
};
command_or_exit read_command_line(int count, char** arguments, bool tells = true);

}  // namespace hearth::furnace::program
