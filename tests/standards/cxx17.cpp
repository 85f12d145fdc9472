// SPDX-License-Identifier: MIT
#include "both.hpp"

#include <hearth/version.hpp>

answers cxx17() { return {__cplusplus}; }
