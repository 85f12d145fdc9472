// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/error.hpp>

namespace hearth::dem::detail {

inline void check(bool good, const char* name, double value, const char* allowed,
                  std::int64_t at = bad_value::no_index) {
    if (!good) throw bad_value(name, at, value, allowed);
}

}  // namespace hearth::dem::detail
