// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <hearth/core/error.hpp>

namespace hearth::test {

/// What the bad_value that body() throws says, or nothing.
template <class Body>
std::string complaint(Body&& body) {
    try {
        body();
    } catch (const bad_value& error) {
        return error.what();
    }
    return "";
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace hearth::test
