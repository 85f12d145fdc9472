// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

/// What the two translation units answer; main compares.
struct answers {
    long standard;
};
answers cxx17();
answers cxx20();
