// SPDX-License-Identifier: MIT
#include "scene_text.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace hearth::furnace {

toml::table parse_toml(const std::string& text, const origin& where) {
    try {
        return toml::parse(text, where);
    } catch (const toml::parse_error& error) {
        std::ostringstream out;
        out << where;
        if (where.rfind("--", 0) != 0) out << ':' << error.source().begin.line;
        out << ": " << error.description();
        throw bad_scene(out.str());
    }
}

std::string read_text(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw bad_scene(path + ": cannot be opened: " + std::strerror(errno));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

toml::table parse_assignment(const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos) throw bad_scene("--set " + assignment + ": is not KEY=VALUE");
    const std::string value = assignment.substr(equals + 1);
    const bool is_word =
        std::all_of(value.begin(), value.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }) &&
        !value.empty() && std::isalpha(static_cast<unsigned char>(value[0])) != 0;
    const bool is_text = is_word && value != "true" && value != "false" && value != "inf" && value != "nan";
    return parse_toml(is_text ? assignment.substr(0, equals + 1) + '"' + value + '"' : assignment,
                      "--set " + assignment);
}

std::uint64_t hash_of(std::string_view text) {
    std::uint64_t value = 14695981039346656037U;
    for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return value;
}

}  // namespace hearth::furnace
