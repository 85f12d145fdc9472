// SPDX-License-Identifier: MIT
// The program `furnace` from outside: what it prints, writes, refuses, and how it survives.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>
#include <regex>
#include <thread>

#include <doctest/doctest.h>

#include "run_program.hpp"

using namespace furnace_program;

namespace {

/// A run that nothing disturbed.
struct calm_run {
    fs::path results;
    std::string answer;
    std::chrono::duration<double> time;
};

const calm_run& undisturbed() {
    static const calm_run calm = [] {
        calm_run c;
        const fs::path folder = fresh("undisturbed");
        c.results = folder / "results";
        const auto begin = std::chrono::steady_clock::now();
        REQUIRE(run(folder, {small_scene(folder), "--output", c.results}).code == 0);
        c.time = std::chrono::steady_clock::now() - begin;
        c.answer = summary_of(c.results).at("answer_hash");
        CHECK(checkpoints_in(c.results).size() == 2);
        return c;
    }();
    return calm;
}

}  // namespace

TEST_CASE("program: --help teaches every key, and what is wrong is told with its place before anything is written") {
    const fs::path folder = fresh("words");
    const ending help = run(folder, {"--help"});
    CHECK(help.code == 0);
    for (const char* word : {"--restart", "Exit codes", "acceleration_factor = 678  # Gamma", "[[wall.zone]]"}) {
        CHECK(help.out.find(word) != std::string::npos);
    }
    const std::string scene = small_scene(folder), output = folder / "results";
    const auto complaint = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {"--output", output});
        const ending e = run(folder, arguments);
        CHECK(e.code == 2);
        CHECK_FALSE(fs::exists(output));
        return e.err;
    };
    CHECK(complaint({"no.toml"}) == "furnace: no.toml: cannot be opened: No such file or directory\n");
    CHECK(complaint({scene, "--set", "mesh.cells_acros=9"}) ==
          "furnace: --set mesh.cells_acros=9: mesh.cells_acros is not a key of a scene; the nearest one is "
          "mesh.cells_across\n");
    CHECK(complaint({scene, "--set", "mesh.cells_across=1"}) ==
          "furnace: --set mesh.cells_across=1: mesh.cells_across is 1, allowed: 4 to 1000\n");
    CHECK(complaint({scene, "--setup"}).find("--setup") != std::string::npos);
    CHECK(complaint({}).find("SCENE is required") != std::string::npos);
    std::ofstream(folder / "bad.toml") << "[burners]\ncount = 12\nheight_m = 800\n";
    CHECK(complaint({folder / "bad.toml"}) == "furnace: " + (folder / "bad.toml").string() + ":3: burners.height_m is 800, allowed: 0 to 100\n");
}

TEST_CASE("program: --dry-run tells what would be built and writes nothing") {
    const fs::path folder = fresh("dry");
    const ending dry = run(folder, {small_scene(folder), "--dry-run", "--output", folder / "results"});
    CHECK(dry.code == 0);
    CHECK(std::regex_search(dry.out, std::regex("gas +[0-9]+ cells")));
    CHECK(std::regex_search(dry.out, std::regex("expected +[0-9.]+ [MG]B of memory, .* on one core")));
    CHECK(dry.out.find("Left out:") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "results"));
}

TEST_CASE("program: the scenes that come with it are sound") {
    const fs::path folder = fresh("scenes");
    int scenes = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(HEARTH_SOURCE_DIR) / "examples/furnace/scenes")) {
        const ending dry = run(folder, {entry.path(), "--dry-run"});
        INFO(dry.err);
        CHECK(dry.code == 0);
        ++scenes;
    }
    CHECK(scenes >= 2);
}

TEST_CASE("program: a run ends with every number of the summary, its files and its table") {
    const fs::path folder = fresh("run"), results = folder / "results";
    // The paper's own shaft, so that the table has the paper's numbers.
    const ending end = run(folder, {small_scene(folder), "--set", "shaft.height_m=10", "--set", "burners.height_m=8", "--output", results,
                                    "--summary", folder / "copy.json"});
    INFO(end.err);
    REQUIRE(end.code == 0);
    CHECK(end.out.find("peak particle temperature                  |      2243 |") != std::string::npos);
    CHECK(end.out.find(fs::absolute(results).lexically_normal()) != std::string::npos);
    CHECK(text_of(folder / "copy.json") == text_of(results / "summary.json"));
    const auto summary = summary_of(results);
    const std::string all = text_of(results / "summary.json");
    int known = 0;
    for (const char* key :
         {"peak_particle_temperature_K", "peak_height_m", "centre_temperature_at_peak_K", "pressure_drop_Pa", "mean_void_fraction",
          "offgas_temperature_K", "solids_outlet_temperature_K", "centre_minus_wall_K_at_1m", "centre_minus_wall_K_at_5m",
          "oxygen_dry_mole_fraction_outlet", "carbon_monoxide_mole_fraction_outlet", "wall_heat_loss_W", "fuel_power_W",
          "enthalpy_imbalance_W", "gas_mass_imbalance_kg_per_s", "solid_mass_imbalance_kg_per_s",
          "heat_transfer_coefficient_p05_W_per_m2K", "heat_transfer_coefficient_p95_W_per_m2K",
          "nitric_oxide_outlet_mg_per_Nm3_dry_at_11_percent_O2", "methane_mole_fraction_outlet",
          "specific_heat_consumption_kJ_per_kg", "excess_air_ratio", "product_share_above_2130_K", "product_share_above_2320_K",
          "median_time_above_2130_K_s", "bed_mass_kg", "residence_time_h", "maximum_temperature_K", "stranded_volume_m3",
          "clamped_evaluations", "wall_time_s", "peak_memory_bytes", "time_per_phase_s", "time_per_module_s", "version", "scene_hash",
          "ranks"}) {
        CAPTURE(key);
        REQUIRE(summary.count(key) == 1);
        const std::string& value = summary.at(key);
        if (value == "null") {  // never without a reason
            CHECK(std::regex_search(all, std::regex("\n    \"" + std::string(key) + "\": \"[^\"]+\"")));
        } else {
            ++known;
        }
    }
    CHECK(known >= 30);
    // 0.207 kg/s of stoichiometric methane and air, 0.0552 of it methane of 50.0 MJ/kg
    CHECK(std::stod(summary.at("fuel_power_W")) == doctest::Approx(571e3).epsilon(0.01));
    for (const char* file : {"scene.toml", "profiles.csv", "one_dimensional.csv", "history.csv", "picture.py", "cells_0000.hdf",
                             "particles_0002.hdf"}) {
        CAPTURE(file);
        CHECK(fs::file_size(results / file) > 100);
    }
    CHECK(fs::exists(results / "cells_0004.hdf"));  // every second coupling
    CHECK_FALSE(fs::exists(results / "cells_0005.hdf"));
    CHECK(text_of(results / "profiles.csv").find("height_m,particle_temperature_K,") == 0);
    const std::string history = text_of(results / "history.csv");
    CHECK(std::count(history.begin(), history.end(), '\n') == 9);  // a title and 8 couplings
    // The scene that is written is the scene that ran.
    CHECK(run(folder, {results / "scene.toml", "--dry-run"}).out ==
          run(folder, {folder / "small.toml", "--set", "shaft.height_m=10", "--set", "burners.height_m=8", "--dry-run"}).out);
}

TEST_CASE("program: killed at any moment, again and again, it ends with the same bits") {
    const calm_run& calm = undisturbed();
    const fs::path folder = fresh("killed"), results = folder / "results";
    const std::string scene = small_scene(folder);
    const std::uint64_t seed = 20231117;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    int killed = 0;
    for (bool ended = false; !ended;) {
        std::vector<std::string> arguments{scene, "--output", results, "--quiet"};
        if (!checkpoints_in(results).empty()) arguments.insert(arguments.end(), {"--restart", results});
        const ending end = run(folder, arguments, [&](pid_t child) {
            if (killed == 8) return;
            // At any moment of a run that nothing disturbs.
            std::this_thread::sleep_for(calm.time * (static_cast<double>(random() >> 11) * 0x1p-53));
            kill(child, SIGKILL);
        });
        INFO(end.err);
        ended = end.signal != SIGKILL;
        if (ended) CHECK(end.code == 0);
        else ++killed;
    }
    CHECK(killed > 0);
    CHECK(summary_of(results).at("answer_hash") == calm.answer);
    // The watched numbers, too, are those of one run.
    CHECK(text_of(results / "history.csv") == text_of(calm.results / "history.csv"));
}

TEST_CASE("program: SIGTERM and Ctrl-C write a checkpoint and stop; the run goes on with the same bits") {
    const fs::path folder = fresh("stopped"), results = folder / "results";
    const std::string scene = small_scene(folder);
    for (const int signal : {SIGTERM, SIGINT}) {
        const fs::path own = results / std::to_string(signal);
        const std::vector<std::string> all{scene, "--output", own, "--set", "output.checkpoint_interval_s=1000"};
        const ending stopped = run(folder, all, [&](pid_t child) {
            wait_for(own / "cells_0000.hdf");
            kill(child, signal);
        });
        INFO(stopped.err);
        CHECK(stopped.code == 128 + signal);
        CHECK(stopped.err.find("--restart " + own.string()) != std::string::npos);
        std::vector<std::string> again = all;
        again.insert(again.end(), {"--restart", last_checkpoint(own)});
        CHECK(run(folder, again).code == 0);
        CHECK(summary_of(own).at("answer_hash") == undisturbed().answer);
    }
}

TEST_CASE("program: a checkpoint that is damaged, cut off, foreign or of another scene is refused before anything is written") {
    const fs::path whole = undisturbed().results, folder = fresh("refused"), results = folder / "results";
    const std::string scene = small_scene(folder);
    fs::copy(whole, results);
    const std::string last = last_checkpoint(results), good = text_of(last);
    const auto refused = [&](const std::string& place, const std::string& why, int code, std::vector<std::string> more = {}) {
        const auto before = content(results);
        std::vector<std::string> arguments{scene, "--output", results, "--restart", place};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ending e = run(folder, arguments);
        CHECK(e.code == code);
        CHECK(e.err == "furnace: " + place + ": " + why + "\n");
        CHECK(content(results) == before);
    };
    const auto put = [&](const std::string& bytes) { std::ofstream(last, std::ios::binary) << bytes; };
    std::string damaged = good;
    damaged[good.size() / 2] = static_cast<char>(damaged[good.size() / 2] ^ 1);
    put(damaged);
    refused(last, "is damaged: its checksum is not what was written", 3);
    put(good.substr(0, good.size() / 2));
    refused(last, "is no checkpoint, or one that was cut off", 3);
    put("");
    refused(last, "is too short to be a checkpoint", 3);
    put(std::string(5000, 'x'));
    refused(last, "is no checkpoint, or one that was cut off", 3);
    refused(folder / "none.h5", "cannot be opened: No such file or directory", 3);
    refused(results / "cells_0000.hdf", "is no checkpoint, or one that was cut off", 3);
    refused(folder, "holds no checkpoint", 3);
    put(good);
    refused(last, "is of another scene: mesh.cells_across = 4, in the scene: 5; time.couplings = 4, in the scene: 9", 2,
            {"--set", "mesh.cells_across=5", "--set", "time.couplings=9"});

    SUBCASE("of a folder, a damaged one is passed over for the one before it") {
        put(damaged);
        const ending e = run(folder, {scene, "--output", results, "--restart", results});
        CHECK(e.code == 0);
        CHECK(e.err.find("is damaged") != std::string::npos);
        CHECK(summary_of(results).at("answer_hash") == undisturbed().answer);
    }
}

TEST_CASE("program: a full disk is told, and keeps the checkpoints that are there") {
    const fs::path folder = fresh("full"), results = folder / "results";
    const std::string scene = small_scene(folder);
    const ending end = run(folder, {scene, "--output", results}, [&](pid_t child) {
        wait_for(results / "checkpoint_0002.h5");
        const rlimit full{90000, 90000};  // no file can grow beyond, what is told neither; a checkpoint takes more than 100 kB
        prlimit(child, RLIMIT_FSIZE, &full, nullptr);
    });
    CHECK(end.code == 3);
    CHECK(std::regex_search(end.err, std::regex("checkpoint_000[0-9].h5: cannot be written: File too large\n"
                                                "furnace: the checkpoints before it are kept")));
    CHECK(end.err.find("the results are not complete") != std::string::npos);
    for (const auto& [name, text] : content(results)) CHECK(name.find(".part") == std::string::npos);
    const ending again = run(folder, {scene, "--output", results, "--restart", results});
    INFO(again.err);
    CHECK(again.code == 0);
    CHECK(summary_of(results).at("answer_hash") == undisturbed().answer);
}
