// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "describe.hpp"
#include "scene_reader.hpp"

#include <toml++/toml.h>

/// Scenes as text, for any settings that have a `kind` and are described key by key (describe.hpp).
namespace hearth::furnace {

/// Throws bad_scene, with file and line, for what is not TOML.
toml::table parse_toml(const std::string& text, const origin& where);
/// The whole file.  Throws bad_scene.
std::string read_text(const std::string& path);
/// "key=value" of a command line; a word needs no quotes.  Throws bad_scene.
toml::table parse_assignment(const std::string& assignment);
/// FNV-1a.
std::uint64_t hash_of(std::string_view text);

template <class... Functions>
struct overloaded : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
overloaded(Functions...) -> overloaded<Functions...>;

/// Every key and list of some settings: by describe.hpp, or by their own static describe(settings, key).
template <class Settings, class Key>
void each_key(Settings& scene, Key&& key) {
    if constexpr (std::is_same_v<std::remove_const_t<Settings>, settings>) describe(scene, key);
    else std::remove_const_t<Settings>::describe(scene, key);
}

template <class Settings>
void read_into(Settings& scene, const toml::table& root, const origin& where) {
    scene_reader read(root, where);
    read.read_kind(Settings::kind);
    each_key(scene, overloaded{[&](auto table, auto name, auto& value, const range& allowed, const char*) {
                                   read.read(table, name, value, allowed);
                               },
                               [&](const char* path, auto& items, const auto& members) {
                                   read.read_list(path, items, members);
                               }});
    read.refuse_unknown();
}

/// Applies "key=value" one after the other, and checks what they make together once (check(scene)): they may come in
/// any order.  Throws bad_scene, and changes nothing then.
template <class Settings>
void assign(Settings& scene, const std::vector<std::string>& assignments) {
    Settings changed = scene;
    for (const std::string& one : assignments) read_into(changed, parse_assignment(one), "--set " + one);
    check(changed);
    scene = std::move(changed);
}

template <class Value>
std::string written(const Value& value, const range& allowed) {
    if constexpr (std::is_same_v<Value, bool>) {
        return value ? "true" : "false";
    } else if constexpr (std::is_same_v<Value, std::string>) {
        return '"' + value + '"';
    } else if constexpr (std::is_enum_v<Value>) {
        return '"' + std::string(names(Value{})[static_cast<std::size_t>(value)]) + '"';
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
        std::string list;
        for (const double item : value) list += (list.empty() ? "[" : ", ") + written(item, allowed);
        return list + "]";
    } else if constexpr (std::is_same_v<Value, number_or_auto>) {
        return value.automatic ? "\"auto\"" : written(value.value, allowed);
    } else if constexpr (std::is_integral_v<Value>) {
        return std::to_string(value);
    } else {
        return format(static_cast<double>(value) / allowed.to_si);
    }
}

/// A scene as a file that reads back as the same scene, with the meaning and range of every key.
template <class Settings>
std::string document_of(const Settings& scene) {
    std::ostringstream out;
    std::string open;
    out << "kind = \"" << Settings::kind << "\"\n";
    each_key(scene, overloaded{[&](std::string_view table, std::string_view name, const auto& value,
                                   const range& allowed, const char* meaning) {
                                   using value_type = std::decay_t<decltype(value)>;
                                   if (table != open) {
                                       open = table;
                                       out << "\n[" << open << "]\n";
                                   }
                                   out << name << " = " << written(value, allowed) << "  # " << meaning;
                                   if constexpr (std::is_enum_v<value_type>) {
                                       out << ':';
                                       for (const std::string_view word : names(value_type{})) out << ' ' << word;
                                   } else if constexpr (!std::is_same_v<value_type, bool> &&
                                                        !std::is_same_v<value_type, std::string>) {
                                       out << ", " << format(allowed.from) << " to " << format(allowed.to);
                                   }
                                   out << '\n';
                               },
                               [&](const char* path, const auto& items, const auto& members) {
                                   for (const auto& item : items) {
                                       out << "\n[[" << path << "]]\n";
                                       for (const auto& [name, member] : members)
                                           out << name << " = " << format(item.*member.first / member.second.to_si)
                                               << '\n';
                                   }
                               }});
    return out.str();
}

}  // namespace hearth::furnace
