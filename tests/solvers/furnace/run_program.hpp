// SPDX-License-Identifier: MIT
// Runs the program `furnace` from outside, and reads what it wrote.
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

extern char** environ;

namespace furnace_program {

namespace fs = std::filesystem;

inline std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// A folder of its own for each test case.
inline fs::path fresh(const std::string& name) {
    const fs::path folder = fs::path("furnace_program") / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

/// A furnace that takes a second, and writes a checkpoint after every step.  It is too short to converge, so it ends after
/// twice the couplings that it plans.
inline fs::path small_scene(const fs::path& folder) {
    std::ofstream(folder / "small.toml") << "title = \"small\"\n"
                                            "shaft.height_m = 3\nshaft.hopper_height_m = 0\nburners.height_m = 2\n"
                                            "bed.packing = \"dem\"\nbed.motion = \"recorded\"\nbed.coarse_graining = 10\n"
                                            "physics.combustion = \"mixed_is_burnt\"\n"
                                            "mesh.cells_across = 4\nmesh.axial_size_m = 0.3\nmesh.axial_size_bottom_m = 0.15\n"
                                            "mesh.axial_size_burners_m = 0.15\n"
                                            "time.couplings = 4\ntime.residence_times = 0.1\n"
                                            "output.frames = 2\noutput.checkpoint_interval_s = 0\noutput.picture = false\n";
    return folder / "small.toml";
}

struct ending {
    int code = -1;    ///< exit code
    int signal = 0;   ///< that ended it, or 0
    std::string out, err;
};

/// Runs the program; `meanwhile` gets its process id while it runs.  Behind a launcher, that of mpirun, if one is given.
inline ending run(const fs::path& folder, std::vector<std::string> arguments, const std::function<void(pid_t)>& meanwhile = {},
                  const std::vector<std::string>& launcher = {}) {
    const std::string out = folder / "out.txt", err = folder / "err.txt";
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    arguments.insert(arguments.begin(), HEARTH_FURNACE_PROGRAM);
    arguments.insert(arguments.begin(), launcher.begin(), launcher.end());
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t child = 0;
    REQUIRE(posix_spawn(&child, pointers.front(), &files, nullptr, pointers.data(), environ) == 0);
    posix_spawn_file_actions_destroy(&files);
    if (meanwhile) meanwhile(child);
    int status = 0;
    waitpid(child, &status, 0);
    ending e;
    if (WIFEXITED(status)) e.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) e.signal = WTERMSIG(status);
    e.out = text_of(out);
    e.err = text_of(err);
    return e;
}

inline void wait_for(const fs::path& file) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!fs::exists(file) && std::chrono::steady_clock::now() < give_up) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    REQUIRE(fs::exists(file));
}

/// Keys and values of the outer object of summary.json, as text.
inline std::map<std::string, std::string> summary_of(const fs::path& results) {
    std::map<std::string, std::string> values;
    const std::string text = text_of(results / "summary.json");
    const std::regex line("\n  \"([^\"]+)\": ([^\n]*[^,\n]),?");
    for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i) values[(*i)[1]] = (*i)[2];
    return values;
}

/// All files of a folder with their content.
inline std::map<std::string, std::string> content(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder)) files[entry.path().filename()] = text_of(entry.path());
    return files;
}

/// Names of the checkpoints in a folder, in their order.
inline std::vector<std::string> checkpoints_in(const fs::path& folder) {
    std::set<std::string> names;
    if (fs::exists(folder)) {
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename();
            if (std::regex_match(name, std::regex("checkpoint_[0-9]+\\.h5"))) names.insert(name);
        }
    }
    return {names.begin(), names.end()};
}

inline std::string last_checkpoint(const fs::path& folder) {
    const auto names = checkpoints_in(folder);
    REQUIRE_FALSE(names.empty());
    return folder / names.back();
}

}  // namespace furnace_program
