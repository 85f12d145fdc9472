// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>

#include "burner.hpp"
#include "cold_bed.hpp"
#include "heated_bed.hpp"
#include "plates.hpp"
#include "rung_of.hpp"
#include "silo.hpp"
#include "two_spheres.hpp"

namespace hearth::furnace {
namespace {

const std::vector<rungs::rung_kind>& all_rungs() {
    static const std::vector<rungs::rung_kind> all{
        rungs::kind_for<rungs::two_spheres>("two spheres, and a sphere and a wall: heat over contact force (Fig. 1)"),
        rungs::kind_for<rungs::plates>("a bed between a hot and a cold plate: its effective conductivity (Figs. 2 and 3)"),
        rungs::kind_for<rungs::cold_bed>("cold air through a packed bed: pressure drop over velocity (Fig. 5)"),
        rungs::kind_for<rungs::heated_bed>("hot air heats a fixed bed, with and without Time Scale Splitting (Fig. 6)"),
        rungs::kind_for<rungs::silo>("a silo that is filled, fed and emptied: Janssen, plug flow, mass flow"),
        rungs::kind_for<rungs::burner>("one burner in a slab of a bed that stands still: flame limit, burn-out"),
    };
    return all;
}

/// The kind that a scene names; one that does not exist is refused with its line.
std::string kind_in(const toml::table& root, const origin& where) {
    const toml::node* node = root.get("kind");
    if (node == nullptr) return settings::kind;
    const scene_reader read(root, where);
    const std::string given = read.word(*node, "kind");
    std::string allowed;
    for (const scene_kind& k : scene_kinds()) {
        if (k.name == given) return given;
        allowed += (allowed.empty() ? "" : ", ") + k.name;
    }
    read.refuse(node, "kind is \"" + given + "\", allowed: " + allowed);
}

}  // namespace

double rung_result::operator[](const std::string& key) const {
    for (const finding& f : findings) {
        if (f.key == key) return f.value;
    }
    throw std::out_of_range("no finding " + key);
}

const std::vector<double>& rung_result::column(const std::string& file, const std::string& title) const {
    for (const curves& table : tables) {
        if (table.file != file) continue;
        for (const auto& [name, values] : table.columns) {
            if (name == title) return values;
        }
    }
    throw std::out_of_range("no column " + title + " in " + file);
}

std::uint64_t hash(const rung& scene) { return hash_of(scene.document()); }

std::vector<scene_kind> scene_kinds() {
    std::vector<scene_kind> kinds{{settings::kind, "the shaft furnace; what a scene is that names no kind"}};
    for (const rungs::rung_kind& k : all_rungs()) kinds.push_back(k.said);
    return kinds;
}

std::string kind_of_scene(const std::string& path) { return kind_in(parse_toml(read_text(path), path), path); }

std::unique_ptr<rung> parse_rung(const std::string& text, const origin& where) {
    const toml::table root = parse_toml(text, where);
    const std::string kind = kind_in(root, where);
    for (const rungs::rung_kind& k : all_rungs()) {
        if (k.said.name == kind) return k.make(root, where);
    }
    throw bad_scene(where + ": kind is \"" + kind + "\", which is no rung of the ladder");
}

std::unique_ptr<rung> read_rung(const std::string& path) { return parse_rung(read_text(path), path); }

}  // namespace hearth::furnace
