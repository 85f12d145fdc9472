// SPDX-License-Identifier: MIT
// The program `furnace` on several ranks, from outside.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "run_program.hpp"

using namespace furnace_program;

namespace {

const std::vector<std::string> on_two{HEARTH_MPIEXEC, "-np", "2"};

ending run_on_two(const fs::path& folder, const std::vector<std::string>& arguments, const std::function<void(pid_t)>& meanwhile = {}) {
    return run(folder, arguments, meanwhile, on_two);
}

/// How often a text holds a word.
int count_of(const std::string& text, const std::string& word) {
    int found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("program on ranks: one voice, whole files, and the answer of one rank") {
    const fs::path folder = fresh("ranks"), results = folder / "results";
    const std::string scene = small_scene(folder);
    const ending end = run_on_two(folder, {scene, "--output", results});
    INFO(end.err);
    REQUIRE(end.code == 0);
    CHECK(count_of(end.out, "peak particle temperature") == 1);
    auto two = summary_of(results);
    CHECK(two.at("ranks") == "2");
    CHECK(run(folder, {scene, "--output", folder / "one"}).code == 0);
    auto one = summary_of(folder / "one");
    // To the tolerance of the gas's iterations, see ranks.cpp.
    for (const char* key : {"peak_particle_temperature_K", "offgas_temperature_K", "solids_outlet_temperature_K"}) {
        CAPTURE(key);
        CHECK(std::abs(std::stod(two.at(key)) - std::stod(one.at(key))) < 0.4);
    }
    // The same files, with as much in them.
    const auto of_two = content(results), of_one = content(folder / "one");
    for (const auto& entry : of_one) {
        const std::string &name = entry.first, &text = entry.second;
        CAPTURE(name);
        REQUIRE(of_two.count(name) == 1);
        if (name.find(".hdf") != std::string::npos) CHECK(of_two.at(name).size() == text.size());
        if (name == "scene.toml" || name == "one_dimensional.csv") CHECK(of_two.at(name) == text);
    }
}

TEST_CASE("program on ranks: stopped by a signal to mpirun, it goes on with the same bits") {
    const fs::path folder = fresh("ranks_stopped"), calm = folder / "calm", own = folder / "stopped";
    const auto arguments = [&, scene = small_scene(folder).string()](const fs::path& output) {
        // Long enough for the signal to pass through mpirun, which takes a second.
        return std::vector<std::string>{scene, "--output", output, "--set", "output.checkpoint_interval_s=1000", "--set", "time.couplings=60"};
    };
    CHECK(run_on_two(folder, arguments(calm)).code == 0);
    const ending stopped = run_on_two(folder, arguments(own), [&](pid_t child) {
        wait_for(own / "scene.toml");
        kill(child, SIGTERM);
    });
    INFO(stopped.err);
    CHECK(stopped.code != 0);
    CHECK(count_of(stopped.err, "stopped by signal 15, go on with --restart " + own.string()) == 1);
    std::vector<std::string> again = arguments(own);
    again.insert(again.end(), {"--restart", last_checkpoint(own)});
    CHECK(run_on_two(folder, again).code == 0);
    CHECK(summary_of(own).at("answer_hash") == summary_of(calm).at("answer_hash"));
}

TEST_CASE("program on ranks: what is wrong is said once, and nobody waits") {
    const fs::path folder = fresh("ranks_wrong"), output = folder / "results";
    const std::string scene = small_scene(folder);
    const auto said = [&](std::vector<std::string> arguments, const std::string& complaint, int code) {
        arguments.insert(arguments.end(), {"--output", output});
        const ending end = run_on_two(folder, arguments);
        INFO(end.err);
        CHECK(end.code == code);
        CHECK(count_of(end.err, complaint) == 1);
        CHECK(count_of(end.err, "furnace: ") == 1);
        CHECK_FALSE(fs::exists(output));
    };
    said({scene, "--set", "mesh.cells_across=1"},
         "furnace: --set mesh.cells_across=1: mesh.cells_across is 1, allowed: 4 to 1000\n", 2);
    std::ofstream(folder / "foreign.h5") << std::string(5000, 'x');
    said({scene, "--restart", folder / "foreign.h5"}, "is no checkpoint, or one that was cut off\n", 3);

    // A folder that cannot be made is met by rank 0 alone, and ends both.
    std::ofstream(folder / "file") << "no folder";
    const ending end = run_on_two(folder, {scene, "--output", folder / "file" / "results"});
    INFO(end.err);
    CHECK(end.code == 3);
    CHECK(count_of(end.err, "cannot be made") == 1);
}

TEST_CASE("program on ranks: an error that one rank alone meets ends all, with its words") {
    const fs::path folder = fresh("ranks_alone");
    const std::string scene = small_scene(folder), output = folder / "results";
    // Two programs in one run: the second has a scene of its own, which is wrong.
    const ending end = run(folder, {scene, "--output", output, ":", "-np", "1", HEARTH_FURNACE_PROGRAM, scene, "--set", "mesh.cells_across=1"}, {},
                           {HEARTH_MPIEXEC, "-np", "1"});
    INFO(end.err);
    CHECK(end.code == 2);
    CHECK(count_of(end.err,
                   "furnace: rank 1: --set mesh.cells_across=1: mesh.cells_across is 1, allowed: 4 to 1000\n") == 1);
}
