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
    session(const command_line& command, const ranks& among)
        : command_(command),
          among_(among),
          scene_(read_scene(command.scene)),
          line_(stdout, command.quiet || !tells()) {
        set_keys(scene_, command.assignments);
        planned_ = foresee(scene_, among_.size());
    }

    int run() {
        if (command_.dry_run) {
            if (tells()) std::fputs(expectation(scene_, planned_).c_str(), stdout);
            return exit_code::done;
        }
        if (command_.sensitivities) {
            if (tells()) std::fputs(table_of(solve_shaft_profile(scene_), sensitivities(scene_)).c_str(), stdout);
            return exit_code::done;
        }
        saved_state saved;
        std::string remark;
        if (!command_.restart.empty()) saved = read_checkpoint(command_.restart, scene_, remark);
        listen_to_signals();
        if (tells() && !remark.empty()) std::fputs(remark.c_str(), stderr);
        line_.say(expectation(scene_, planned_));
        furnace shaft(scene_, among_);
        if (!command_.restart.empty()) {
            watched_.rows = saved[watched_rows];
            shaft.restore(saved);
            line_.say("goes on from " + command_.restart + ", coupling " + std::to_string(shaft.steps_done()));
        }
        results_ = std::make_unique<results>(command_.output, among_);
        results_->scene(scene_);  // a folder that cannot be written is told at once
        while (!shaft.done()) {
            step(shaft);
            line_.show(shaft.now());
            // What one rank has heard or what one clock says, all do.
            if (const double signal = among_.max(static_cast<double>(stop_signal)); signal > 0) return stop(shaft, static_cast<int>(signal));
            if (among_.any(interval() >= scene_.output.interval)) write_checkpoint(shaft);
        }
        return end(shaft);
    }

  private:
    bool tells() const { return among_.rank() == 0; }
    void complain(const std::string& text) const {
        if (tells()) std::fprintf(stderr, "furnace: %s\n", text.c_str());
    }

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
            state[watched_rows] = tells() ? watched_.rows : std::vector<double>();
            checkpoints(command_.output, among_).write(state, scene_);
        });
        last_checkpoint_ = std::chrono::steady_clock::now();
        if (!written) complain("the checkpoints before it are kept");
        return written;
    }

    int stop(const furnace& shaft, int signal) {
        line_.end();
        const bool written = write_checkpoint(shaft);
        complain("stopped by signal " + std::to_string(signal) +
                 (written ? ", go on with --restart " + command_.output : ", without a new checkpoint"));
        return written ? exit_code::stopped + signal : exit_code::bad_file;
    }

    int end(const furnace& shaft) {
        line_.end();
        const summary ending = shaft.summarise();
        const snapshot seen = shaft.look();
        keep([&] { results_->summary_file(shaft, seen, ending, planned_, command_.summary); });
        keep([&] { results_->end(shaft, seen, watched_); });
        write_checkpoint(shaft);
        const int code = complete_ ? exit_code::done : exit_code::bad_file;
        if (!tells()) return code;
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
        for (const std::string& warning : ending.warnings) complain("warning: " + warning);
        if (!complete_) complain("the results are not complete: see above");
        return code;
    }

    /// Writes; a file that cannot be written is told, and the run goes on with the files that it has.
    template <class Write>
    bool keep(Write&& write) {
        try {
            write();
            return true;
        } catch (const io::file_error& error) {
            line_.end();
            complain(error.what());
            complete_ = false;
            return false;
        }
    }

    command_line command_;
    ranks among_;
    settings scene_;
    plan planned_;
    progress line_;
    history watched_;
    std::unique_ptr<results> results_;
    std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
    bool complete_ = true;
};

}  // namespace

int run(const command_line& command, const ranks& among) {
    const std::string kind = kind_of_scene(command.scene);
    if (kind == settings::kind) return session(command, among).run();
    if (among.size() > 1) throw bad_scene("a scene of kind \"" + kind + "\" is short and runs on one rank");
    return climb(command);
}

}  // namespace hearth::furnace::program
