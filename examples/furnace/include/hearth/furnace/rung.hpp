// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <hearth/furnace/furnace.hpp>
#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

/// A number that a rung ends with.
struct finding {
    std::string key;       ///< of summary.json, with its unit
    std::string quantity;  ///< in words
    std::string expected;  ///< by the paper or a reference, which it names; empty: nothing to compare with
    double value = 0;
    std::string unit;
    std::string format = "%.4g";
};

/// Curves that a rung draws: a CSV file, columns of one length with their units in the titles.
struct curves {
    std::string file;
    std::vector<std::pair<std::string, std::vector<double>>> columns;
};

struct rung_result {
    std::vector<finding> findings;
    std::vector<curves> tables;
    std::vector<std::string> warnings;

    /// The finding of that key; throws std::out_of_range.
    double operator[](const std::string& key) const;
    /// The column of that title in a file; throws std::out_of_range.
    const std::vector<double>& column(const std::string& file, const std::string& title) const;
};

/// What a rung builds and costs, before anything is built.
struct rung_plan {
    std::string builds;  ///< in words
    double memory = 0;   ///< [bytes]
    double seconds = 0;  ///< of one core, +-50 % [s]
    std::vector<plan::omission> left_out;
};

/// Told while a rung runs: its share done, 0 to 1, and what it is at.
using watcher = std::function<void(double share_done, const std::string& at)>;

/// A rung of the ladder to the furnace: a small scene of a type of its own, into which only the physics that it names is
/// compiled, and which ends beside a measurement, a law or an exact answer.  The key `kind` of a scene file says which.
class rung {
  public:
    virtual ~rung() = default;
    virtual const char* kind() const = 0;
    virtual const std::string& title() const = 0;
    /// As set_keys of settings.
    virtual void set_keys(const std::vector<std::string>& assignments) = 0;
    /// Every key with its value, meaning and range, as a file that reads back.
    virtual std::string document() const = 0;
    virtual rung_plan foresee() const = 0;
    virtual rung_result run(const watcher& watch = [](double, const std::string&) {}) const = 0;
};

/// FNV-1a of all keys and values.
std::uint64_t hash(const rung& scene);

/// A kind of scene, and what it is for in a line.
struct scene_kind {
    std::string name, meaning;
};
/// All of them; "furnace" is the first, and no rung.
std::vector<scene_kind> scene_kinds();

/// The kind that a scene file names; "furnace" where it names none.  Throws bad_scene for one that does not exist.
std::string kind_of_scene(const std::string& path);
/// Reads a scene file of any kind but "furnace".  Throws bad_scene.
std::unique_ptr<rung> read_rung(const std::string& path);
/// The same from text, as a scene file would hold it.
std::unique_ptr<rung> parse_rung(const std::string& text, const origin& where = "scene");

}  // namespace hearth::furnace
