// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "report.hpp"

namespace hearth::furnace::program {

namespace {

/// Open MPI gives its ranks a terminal of their own for what they print, wherever it sends that: then the launcher's counts.
bool is_terminal(std::FILE* out) {
    if (isatty(fileno(out)) != 1) return false;
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return true;
    std::error_code unknown;
    const std::string end = std::filesystem::read_symlink("/proc/" + std::to_string(getppid()) + "/fd/1", unknown).string();
    return unknown || end.find("/dev/pts/") == 0 || end.find("/dev/tty") == 0;
}

}  // namespace

progress::progress(std::FILE* out, bool quiet) : out_(out), quiet_(quiet), terminal_(is_terminal(out)) {}

std::string progress_line(const status& now, double left) {
    char text[256];
    // How long it takes to converge nobody knows, so that phase has a share of its own.
    const double share = now.now == phase::converge ? now.share_done : now.share_of_run;
    int length = std::snprintf(text, sizeof text, "%-8s %3.0f %%  ", name(now.now), 100 * std::clamp(share, 0.0, 1.0));
    const auto add = [&](const char* format, auto... values) {
        const auto used = static_cast<std::size_t>(length);
        if (used < sizeof text) length += std::snprintf(text + used, sizeof text - used, format, values...);
    };
    if (left >= 0) add("%s left  ", duration(left).c_str());
    if (now.now == phase::fill) {
        add("bed %.2f m high", now.fill_level);
        return text;
    }
    if (now.peak_particle_temperature > 0) add("peak %.0f K at %.2f m  ", now.peak_particle_temperature, now.peak_height);
    if (now.offgas_temperature > 0) add("off-gas %.0f K  ", now.offgas_temperature);
    if (now.solids_outlet_temperature > 0) add("product %.0f K  ", now.solids_outlet_temperature);
    if (now.fuel_power > 0) add("heat balanced to %.2f %%", 100 * std::abs(now.enthalpy_imbalance) / now.fuel_power);
    return text;
}

template <class Line>
void progress::show(double share, bool at_once, Line&& line_with_time_left) {
    if (quiet_) return;
    const auto time = clock::now();
    const auto seconds = [](clock::duration d) { return std::chrono::duration<double>(d).count(); };
    if (share_at_begin_ < 0) share_at_begin_ = share;
    const bool due = terminal_ ? seconds(time - last_) > 0.2 : share >= share_at_last_ + 0.1 || seconds(time - last_) > 30;
    if (!due && !at_once) return;
    last_ = time;
    share_at_last_ = share;
    const double done = share - share_at_begin_;
    std::string line = line_with_time_left(done > 0.01 && share < 1 ? seconds(time - begin_) * (1 - share) / done : -1);
    if (!terminal_) {
        std::fprintf(out_, "%s\n", line.c_str());
        std::fflush(out_);
        return;
    }
    winsize window{};
    const bool known = ioctl(fileno(out_), TIOCGWINSZ, &window) == 0 && window.ws_col > 1;
    line.resize(std::min<std::size_t>(line.size(), known ? window.ws_col - 1U : 79U));
    std::fprintf(out_, "\r%s\033[K", line.c_str());  // to the end of the line: what was longer before
    std::fflush(out_);
    open_ = true;
}

void progress::show(const status& now) {
    show(now.share_of_run, now.now == phase::report, [&](double left) { return progress_line(now, left); });
}

void progress::show(double share_done, const std::string& text) {
    show(share_done, false, [&](double left) {
        char share[16];
        std::snprintf(share, sizeof share, "%3.0f %%  ", 100 * std::clamp(share_done, 0.0, 1.0));
        return share + (left >= 0 ? duration(left) + " left  " : std::string()) + text;
    });
}

void progress::say(const std::string& line) {
    end();
    if (!quiet_) std::fprintf(out_, "%s\n", line.c_str());
    std::fflush(out_);
}

void progress::end() {
    if (open_) std::fputc('\n', out_);
    open_ = false;
}

}  // namespace hearth::furnace::program
