// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include <hearth/furnace/furnace.hpp>

namespace hearth::furnace::program {

/// The line that a person watches: phase, share done, time left, and the numbers that tell how it goes.  On a terminal it
/// stays in its place; elsewhere, in a log, there is a new one every tenth of the run and every half minute.
class progress {
  public:
    progress(std::FILE* out, bool quiet);

    void show(const status& now);
    /// The same of a run that tells its share done and a text.
    void show(double share_done, const std::string& text);
    /// A line of its own, below the progress line.
    void say(const std::string& line);
    /// Ends the progress line.
    void end();

  private:
    using clock = std::chrono::steady_clock;

    template <class Line>
    void show(double share, bool at_once, Line&& line_with_time_left);

    std::FILE* out_;
    bool quiet_, terminal_, open_ = false;
    clock::time_point begin_ = clock::now(), last_ = begin_;
    double share_at_begin_ = -1, share_at_last_ = 0;
};

/// The progress line itself; `left` is the time that is left [s], negative where it is not known yet.
std::string progress_line(const status& now, double left);

}  // namespace hearth::furnace::program
