// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <hearth/furnace/rung.hpp>

#include "../scene_text.hpp"

namespace hearth::furnace::rungs {

// Inside of rung_of the names of these functions are those of its own.
template <class Settings>
rung_plan plan_of(const Settings& scene) {
    return foresee(scene);
}
template <class Settings>
rung_result result_of(const Settings& scene, const watcher& watch) {
    return run(scene, watch);
}

/// A rung from its settings, which have a `kind`, a `title`, a static describe(settings, key) with every key as in
/// describe.hpp, and beside them the functions
///     check(settings)               what a single key cannot tell; throws bad_scene
///     foresee(settings)             a rung_plan
///     run(settings, watcher)        a rung_result
template <class Settings>
class rung_of final : public rung {
  public:
    rung_of(const toml::table& root, const origin& where) {
        read_into(scene_, root, where);
        check(scene_);
    }
    const char* kind() const override { return Settings::kind; }
    const std::string& title() const override { return scene_.title; }
    void set_keys(const std::vector<std::string>& assignments) override { assign(scene_, assignments); }
    std::string document() const override { return document_of(scene_); }
    rung_plan foresee() const override { return plan_of(scene_); }
    rung_result run(const watcher& watch) const override { return result_of(scene_, watch); }

  private:
    Settings scene_;
};

/// One kind of rung.
struct rung_kind {
    scene_kind said;
    std::unique_ptr<rung> (*make)(const toml::table& root, const origin& where);
};
template <class Settings>
rung_kind kind_for(const char* meaning) {
    return {{Settings::kind, meaning}, [](const toml::table& root, const origin& where) -> std::unique_ptr<rung> {
                return std::make_unique<rung_of<Settings>>(root, where);
            }};
}

constexpr double pi = 3.14159265358979323846;

/// Processor time of this program [s].
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace hearth::furnace::rungs
