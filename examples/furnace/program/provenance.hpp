// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include <hearth/version.hpp>

namespace hearth::furnace::program {

inline std::string version() {
    return std::to_string(HEARTH_VERSION_MAJOR) + '.' + std::to_string(HEARTH_VERSION_MINOR) + '.' + std::to_string(HEARTH_VERSION_PATCH);
}

inline std::string hexadecimal(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

}  // namespace hearth::furnace::program
