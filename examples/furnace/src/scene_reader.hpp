// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "describe.hpp"

namespace hearth::furnace {

/// As short as reads back to the same number.
inline std::string format(double value) {
    char text[32];
    for (int digits = 6; digits <= 17; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::stod(text) == value) break;
    }
    return text;
}

inline std::string path_of(std::string_view table, std::string_view name) {
    return table.empty() ? std::string(name) : std::string(table) + "." + std::string(name);
}

/// Letters to insert, delete or change to get from one word to the other (Levenshtein).
inline std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

/// Reads values out of TOML and says where a value is wrong.
class scene_reader {
  public:
    scene_reader(const toml::table& root, origin where) : root_(root), where_(std::move(where)) {}

    [[noreturn]] void refuse(const toml::node* node, const std::string& what) const {
        std::ostringstream out;
        out << where_;
        if (node != nullptr && node->source().begin.line > 0 && where_.rfind("--", 0) != 0) out << ':' << node->source().begin.line;
        out << ": " << what;
        throw bad_scene(out.str());
    }

    double number(const toml::node& node, const std::string& path, const range& allowed) const {
        const auto value = node.value<double>();
        if (!value || node.is_boolean()) refuse(&node, path + " is not a number");
        if (!(*value >= allowed.from && *value <= allowed.to)) {
            refuse(&node, path + " is " + format(*value) + ", allowed: " + format(allowed.from) + " to " + format(allowed.to));
        }
        return *value * allowed.to_si;
    }

    std::string word(const toml::node& node, const std::string& path) const {
        if (!node.is_string()) refuse(&node, path + " is not a text in quotes");
        return *node.value<std::string>();
    }

    template <class Value>
    void read(std::string_view table, std::string_view name, Value& value, const range& allowed) {
        const std::string path = path_of(table, name);
        known_.insert(path);
        const toml::node_view<const toml::node> view = root_.at_path(path);
        if (!view) return;
        const toml::node& node = *view.node();
        if constexpr (std::is_same_v<Value, bool>) {
            if (!node.is_boolean()) refuse(&node, path + " is neither true nor false");
            value = *node.value<bool>();
        } else if constexpr (std::is_same_v<Value, std::string>) {
            value = word(node, path);
        } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
            const toml::array* list = node.as_array();
            if (list == nullptr || list->empty()) refuse(&node, path + " is not a list of numbers");
            value.clear();
            for (const toml::node& entry : *list) value.push_back(number(entry, path, allowed));
        } else if constexpr (std::is_enum_v<Value>) {
            const std::string given = word(node, path);
            constexpr auto words = names(Value{});
            const auto found = std::find(words.begin(), words.end(), given);
            if (found == words.end()) {
                std::string all;
                for (const std::string_view allowed_word : words) all += (all.empty() ? "" : ", ") + std::string(allowed_word);
                refuse(&node, path + " is \"" + given + "\", allowed: " + all);
            }
            value = static_cast<Value>(found - words.begin());
        } else if constexpr (std::is_same_v<Value, number_or_auto>) {
            value.automatic = node.is_string() && *node.value<std::string>() == "auto";
            if (node.is_string() && !value.automatic) refuse(&node, path + " is neither a number nor \"auto\"");
            if (!value.automatic) value.value = number(node, path, allowed);
        } else if constexpr (std::is_integral_v<Value>) {
            if (!node.is_integer()) refuse(&node, path + " is not a whole number");
            value = static_cast<Value>(number(node, path, allowed));
        } else {
            value = number(node, path, allowed);
        }
    }

    /// The kind of scene, which the reader's settings are for.
    void read_kind(std::string_view expected) {
        std::string given(expected);
        read("", "kind", given, range{});
        if (given != expected) refuse(root_.get("kind"), "kind is \"" + given + "\", allowed here: " + std::string(expected));
    }

    /// An array of tables, each with these numbers and no other key.
    template <class Item>
    void read_list(const std::string& path, std::vector<Item>& items,
                   const list_members<Item>& members) {
        known_.insert(path);
        const auto view = root_.at_path(path);
        if (!view) return;
        const toml::array* list = view.as_array();
        if (list == nullptr || list->empty()) refuse(view.node(), path + " is not a list of tables");
        items.clear();
        for (const toml::node& entry : *list) {
            const toml::table* table = entry.as_table();
            if (table == nullptr) refuse(&entry, "an entry of " + path + " is not a table");
            Item item{};
            for (const auto& [name, member] : members) {
                const toml::node* node = table->get(name);
                if (node == nullptr) refuse(&entry, "an entry of " + path + " lacks " + name);
                item.*member.first = number(*node, path + "." + name, member.second);
            }
            for (const auto& [key, node] : *table) {
                const std::string_view given = key.str();
                if (std::none_of(members.begin(), members.end(), [&](const auto& m) { return m.first == given; })) {
                    std::vector<std::string> allowed;
                    for (const auto& member : members) allowed.push_back(member.first);
                    refuse(&node, unknown(path + "." + std::string(given), std::string(given), allowed));
                }
            }
            items.push_back(item);
        }
    }

    /// Every key that was not read is unknown.
    void refuse_unknown() const { refuse_unknown(root_, ""); }

  private:
    static std::string unknown(const std::string& path, const std::string& given, const std::vector<std::string>& all) {
        // A key in the wrong table is near too, so the last word alone counts as well.
        const auto last = [](std::string_view key) { return key.substr(key.rfind('.') + 1); };
        const auto far = [&](const std::string& key) { return std::min(distance(given, key), distance(last(given), last(key))); };
        const auto nearest =
            std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) { return far(a) < far(b); });
        return path + " is not a key of a scene; the nearest one is " + *nearest;
    }

    void refuse_unknown(const toml::table& table, const std::string& prefix) const {
        for (const auto& [key, node] : table) {
            const std::string path = path_of(prefix, key.str());
            if (known_.count(path) != 0) continue;
            const bool is_group = node.is_table() && std::any_of(known_.begin(), known_.end(), [&](const std::string& k) {
                return k.compare(0, path.size() + 1, path + ".") == 0;
            });
            if (!is_group) refuse(&node, unknown(path, path, {known_.begin(), known_.end()}));
            refuse_unknown(*node.as_table(), path);
        }
    }

    const toml::table& root_;
    origin where_;
    std::set<std::string> known_;
};

}  // namespace hearth::furnace
