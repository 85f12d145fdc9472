// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <cstdio>
#include <sstream>

#include <CLI/CLI.hpp>

#include <hearth/furnace/rung.hpp>
#include <hearth/furnace/settings.hpp>

#include "ladder.hpp"
#include "provenance.hpp"

namespace hearth::furnace::program {
namespace {

const char* const lesson = R"(
Try it:
  furnace column.toml --dry-run             what will be built, its memory and time, what is left out
  furnace column.toml                       run it; results go to furnace-results
  furnace column.toml --set burners.mass_flow_kg_per_s=0.3 --set time.couplings=100 --output more-fuel
  furnace column.toml --restart furnace-results      go on from the last checkpoint of a run that was stopped or killed

Results:
  summary.json                              every number of the run, with units in the keys
  profiles.csv, one_dimensional.csv         over the height: this run, and the one-dimensional solution of the scene
  history.csv                               what the progress line showed, coupling by coupling
  furnace.png                               pictures, if python3-matplotlib is there; python3 picture.py draws them again
  particles_*.hdf, cells_*.hdf        the time series, for ParaView 5.11 and later
  scene.toml                                the scene as it ran, every key with its value
  checkpoint_*.h5                           the last two checkpoints

Ctrl-C and SIGTERM write a checkpoint and stop.

On several cores: mpirun -np 4 furnace column.toml.  A run goes on from its checkpoints on any number of ranks.  Open MPI kills
ranks a second after it has told them to stop; --mca odls_base_sigkill_timeout 30 gives long steps the time to end.

Exit codes: 0 done; 1 failed while it ran; 2 the command line or the scene is wrong; 3 a file is wrong or cannot be written;
128 + signal: stopped by it, with a checkpoint.

Scene files are TOML.  A scene names what differs from the furnace of Spijker, Pollhammer and Raupenstrauch (2023),
doi:10.1002/ceat.202200617, which is what all keys are by default:
)";

}  // namespace

command_or_exit read_command_line(int count, char** arguments, bool tells) {
    command_line command;
    CLI::App app("A shaft furnace: gas burns inside a bed of stones that sinks through the shaft.", "furnace");
    app.add_option("SCENE", command.scene, "Scene file (TOML)")->required();
    app.add_option("--set", command.assignments, "Set a key of the scene, e.g. mesh.cells_across=32; may be given often")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
    app.add_option("--output", command.output, "Folder of the results; made where it is not there")->type_name("DIR")->capture_default_str();
    app.add_option("--restart", command.restart, "Go on from a checkpoint, or from the latest one of a folder")->type_name("FILE");
    app.add_option("--summary", command.summary, "Write summary.json there too")->type_name("FILE.json");
    app.add_flag("--dry-run", command.dry_run, "Tell what would be built, its memory and time, and what is left out; run nothing");
    app.add_flag("--sensitivities", command.sensitivities,
                 "Print how the scene's one-dimensional solution answers to its inputs; seconds; run nothing");
    app.add_flag("--quiet", command.quiet, "No progress, no table");
    app.add_option_function<std::string>(
           "--keys", [tells](const std::string& kind) {
               if (const std::string keys = keys_of_kind(kind); tells) std::fputs(keys.c_str(), stdout);
               throw CLI::Success();
           }, "Print every key of a kind of scene and end")
        ->type_name("KIND")
        ->trigger_on_parse();
    app.set_version_flag("--version", version());
    app.get_formatter()->column_width(28);
    app.footer([] {
        std::string kinds = "\nKinds of scenes; a scene file names one with the key `kind`, and --keys KIND prints all its keys:\n";
        for (const scene_kind& k : scene_kinds()) kinds += "  " + k.name + std::string(k.name.size() < 14 ? 14 - k.name.size() : 1, ' ') + k.meaning + '\n';
        return kinds + lesson + document(settings{});
    });
    try {
        app.parse(count, arguments);
    } catch (const CLI::ParseError& end) {
        std::ostringstream nowhere;
        const int code = tells ? app.exit(end) : app.exit(end, nowhere, nowhere);
        return {std::nullopt, code == 0 ? exit_code::done : exit_code::bad_input};
    } catch (const bad_scene& error) {
        if (tells) std::fprintf(stderr, "furnace: %s\n", error.what());
        return {std::nullopt, exit_code::bad_input};
    }
    return {command, 0};
}

}  // namespace hearth::furnace::program
