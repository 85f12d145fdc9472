// SPDX-License-Identifier: MIT
#include "run.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <hearth/furnace/furnace.hpp>
#include <hearth/furnace/rung.hpp>
#include <hearth/io/hdf5_file.hpp>

#include "checkpoints.hpp"
#include "ladder.hpp"
#include "picture.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "results.hpp"

namespace hearth::furnace::program {
namespace {

volatile std::sig_atomic_t stop_signal = 0;

/// SIGINT and SIGTERM ask for a checkpoint and the end; a second one ends at once.
void listen_to_signals() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { stop_signal = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error to be told, not the end
}

const char* const watched_rows = "program/history";

/// One run from its settings to its report.
class session {
  public:
    explicit session(const command_line& command)
        : command_(command), scene_(read_scene(command.scene)), line_(stdout, command.quiet) {
        for (const std::string& assignment : command.assignments) set_key(scene_, assignment);
        planned_ = foresee(scene_);
    }

    int run() {
        if (command_.dry_run) {
            std::fputs(expectation(scene_, planned_).c_str(), stdout);
            return exit_code::done;
        }
        saved_state saved;
        std::string remark;
        if (!command_.restart.empty()) saved = read_checkpoint(command_.restart, scene_, remark);
        listen_to_signals();
        if (!remark.empty()) std::fputs(remark.c_str(), stderr);
        line_.say(expectation(scene_, planned_));
        furnace shaft(scene_);
        if (!command_.restart.empty()) {
            watched_.rows = saved[watched_rows];
            shaft.restore(saved);
            line_.say("goes on from " + command_.restart + ", coupling " + std::to_string(shaft.steps_done()));
        }
        results_ = std::make_unique<results>(command_.output);
        results_->scene(scene_);  // a folder that cannot be written is told at once
        while (!shaft.done()) {
            step(shaft);
            line_.show(shaft.now());
            if (stop_signal != 0) return stop(shaft);
            if (interval() >= scene_.output.interval) write_checkpoint(shaft);
        }
        return end(shaft);
    }

  private:
    void step(furnace& shaft) {
        const int before = shaft.steps_done();
        if (shaft.current() == phase::couple && before == 0) frame(shaft, 0);
        shaft.step();
        if (shaft.steps_done() == before) return;
        watched_.add(shaft.now());
        if (scene_.output.frames == 0) return;
        const int every = std::max(1, shaft.steps_planned() / scene_.output.frames);
        const int done = shaft.steps_done();
        if (done % every == 0) frame(shaft, done / every);
        else if (shaft.done()) frame(shaft, done / every + 1);
    }

    void frame(const furnace& shaft, int number) {
        if (scene_.output.frames > 0) keep([&] { results_->frame(number, shaft); });
    }

    double interval() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_checkpoint_).count(); }

    bool write_checkpoint(const furnace& shaft) {
        const bool written = keep([&] {
            saved_state state = shaft.save();
            state[watched_rows] = watched_.rows;
            checkpoints(command_.output).write(state, scene_);
        });
        last_checkpoint_ = std::chrono::steady_clock::now();
        if (!written) std::fprintf(stderr, "furnace: the checkpoints before it are kept\n");
        return written;
    }

    int stop(const furnace& shaft) {
        line_.end();
        const bool written = write_checkpoint(shaft);
        std::fprintf(stderr, "furnace: stopped by signal %d%s\n", static_cast<int>(stop_signal),
                     written ? (", go on with --restart " + command_.output).c_str() : ", without a new checkpoint");
        return written ? exit_code::stopped + static_cast<int>(stop_signal) : exit_code::bad_file;
    }

    int end(const furnace& shaft) {
        line_.end();
        const summary ending = shaft.summarise();
        keep([&] { results_->summary_file(shaft, ending, planned_, command_.summary); });
        keep([&] { results_->end(shaft, watched_); });
        write_checkpoint(shaft);
        std::string picture = command_.output + "/furnace.png", reason;
        if (!scene_.output.picture) {
            picture = "python3 " + command_.output + "/picture.py draws it";
        } else if (!draw(command_.output, reason)) {
            picture = "none: " + reason;
        }
        if (!command_.quiet) {
            std::printf("\n%s\n%s\nresults  %s\npicture  %s\n", scene_.title.c_str(), comparison(scene_, ending).c_str(),
                        std::filesystem::absolute(command_.output).lexically_normal().c_str(), picture.c_str());
        }
        for (const std::string& warning : ending.warnings) std::fprintf(stderr, "furnace: warning: %s\n", warning.c_str());
        if (complete_) return exit_code::done;
        std::fprintf(stderr, "furnace: the results are not complete: see above\n");
        return exit_code::bad_file;
    }

    /// Writes; a file that cannot be written is told, and the run goes on with the files that it has.
    template <class Write>
    bool keep(Write&& write) {
        try {
            write();
            return true;
        } catch (const io::file_error& error) {
            line_.end();
            std::fprintf(stderr, "furnace: %s\n", error.what());
            complete_ = false;
            return false;
        }
    }

    command_line command_;
    settings scene_;
    plan planned_;
    progress line_;
    history watched_;
    std::unique_ptr<results> results_;
    std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
    bool complete_ = true;
};

}  // namespace

int run(const command_line& command) {
    return kind_of_scene(command.scene) == settings::kind ? session(command).run() : climb(command);
}

}  // namespace hearth::furnace::program
