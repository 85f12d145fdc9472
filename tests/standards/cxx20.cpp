// SPDX-License-Identifier: MIT
#include "both.hpp"

#include <hearth/version.hpp>

answers cxx20() { return {__cplusplus}; }
