// SPDX-License-Identifier: MIT
#include "ladder.hpp"

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include <hearth/furnace/rung.hpp>

#include "ladder_script.hpp"
#include "picture.hpp"
#include "progress.hpp"
#include "provenance.hpp"
#include "report.hpp"
#include "text_files.hpp"

namespace hearth::furnace::program {
namespace {

namespace fs = std::filesystem;

std::string expectation(const rung& scene) {
    const rung_plan p = scene.foresee();
    char text[160];
    std::snprintf(text, sizeof text, "  expected   %.0f MB of memory, %s on one core (+-50 %%)\n", p.memory / 1e6, duration(p.seconds).c_str());
    std::string out = scene.title() + "\n\n  kind       " + scene.kind() + "\n  builds     " + p.builds + "\n" + text + "\nLeft out:\n";
    for (const plan::omission& o : p.left_out) out += "  " + o.what + ", because " + o.because + "; saves " + o.saves + "\n";
    return out;
}

std::string printed(const finding& f) {
    char text[32];
    std::snprintf(text, sizeof text, f.format.c_str(), f.value);
    return text;
}

/// quantity | paper or reference | this run | unit
std::string comparison(const rung_result& r) {
    std::string out;
    const auto row = [&](const std::string& a, const std::string& b, const std::string& c, const std::string& d) {
        char text[256];
        std::snprintf(text, sizeof text, "  %-46s | %22s | %10s | %s\n", a.c_str(), b.c_str(), c.c_str(), d.c_str());
        out += text;
    };
    row("quantity", "paper or reference", "this run", "unit");
    out += "  -----------------------------------------------+------------------------+------------+---------\n";
    for (const finding& f : r.findings) row(f.quantity, f.expected.empty() ? "-" : f.expected, printed(f), f.unit);
    return out;
}

std::string json(const rung& scene, const rung_result& r, double wall, double cpu) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    std::string out = "{\n  \"title\": " + quoted(scene.title()) + ",\n  \"kind\": " + quoted(scene.kind()) + ",\n";
    std::string expected;
    for (const finding& f : r.findings) {
        out += "  " + quoted(f.key) + ": " + number(f.value) + ",\n";
        if (!f.expected.empty()) expected += (expected.empty() ? "\n" : ",\n") + ("    " + quoted(f.key)) + ": " + quoted(f.expected);
    }
    out += "  \"expected\": {" + expected + "\n  },\n  \"wall_time_s\": " + number(wall) + ",\n  \"cpu_time_s\": " + number(cpu) +
           ",\n  \"peak_memory_bytes\": " + number(1024.0 * static_cast<double>(used.ru_maxrss)) + ",\n  \"warnings\": [";
    for (std::size_t k = 0; k < r.warnings.size(); ++k) out += (k == 0 ? "" : ", ") + quoted(r.warnings[k]);
    out += "],\n  \"left_out\": [";
    const rung_plan planned = scene.foresee();
    for (std::size_t k = 0; k < planned.left_out.size(); ++k) {
        const plan::omission& o = planned.left_out[k];
        out += (k == 0 ? "" : ", ") + ("{\"what\": " + quoted(o.what)) + ", \"because\": " + quoted(o.because) + ", \"saves\": " +
               quoted(o.saves) + "}";
    }
    return out + "],\n  \"version\": " + quoted(version()) + ",\n  \"scene_hash\": " + quoted(hexadecimal(hash(scene))) +
           ",\n  \"ranks\": 1\n}\n";
}

}  // namespace

std::string keys_of_kind(const std::string& kind) {
    if (kind == settings::kind) return document(settings{});
    return parse_rung("kind = \"" + kind + "\"", "--keys")->document();
}

int climb(const command_line& command) {
    const std::unique_ptr<rung> scene = read_rung(command.scene);
    scene->set_keys(command.assignments);
    if (!command.restart.empty()) {
        throw bad_scene(std::string("--restart: a scene of kind \"") + scene->kind() + "\" is short and writes no checkpoints");
    }
    if (command.dry_run) {
        std::fputs(expectation(*scene).c_str(), stdout);
        return exit_code::done;
    }
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error to be told, not the end
    progress line(stdout, command.quiet);
    line.say(expectation(*scene));
    const fs::path folder = command.output;
    make_folder(folder);
    write_text(folder / "scene.toml", scene->document());  // a folder that cannot be written is told at once

    const auto began = std::chrono::steady_clock::now();
    const std::clock_t cpu_began = std::clock();
    const rung_result result = scene->run([&](double share, const std::string& at) { line.show(share, at); });
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const double cpu = static_cast<double>(std::clock() - cpu_began) / CLOCKS_PER_SEC;
    line.end();

    for (const curves& table : result.tables) {
        csv file;
        for (const auto& [title, values] : table.columns) file.columns.emplace_back(title, &values);
        write_text(folder / table.file, file.text());
    }
    const std::string summary = json(*scene, result, wall, cpu);
    write_text(folder / "summary.json", summary);
    if (!command.summary.empty()) write_text(command.summary, summary);
    write_text(folder / "picture.py", ladder_script);
    std::string reason, picture = (folder / (std::string(scene->kind()) + ".png")).string();
    if (!draw(folder.string(), reason)) picture = "none: " + reason;
    if (!command.quiet) {
        std::printf("\n%s\n%s\nrun time %.1f s on the clock, %.1f s of processor\nresults  %s\npicture  %s\n", scene->title().c_str(),
                    comparison(result).c_str(), wall, cpu, fs::absolute(folder).lexically_normal().c_str(), picture.c_str());
    }
    for (const std::string& warning : result.warnings) std::fprintf(stderr, "furnace: warning: %s\n", warning.c_str());
    return exit_code::done;
}

}  // namespace hearth::furnace::program
