// SPDX-License-Identifier: MIT
#pragma once

/// Checks a caller's contract (an index, a size) where a check in every build would cost too much.  Does what `assert`
/// does: nothing when NDEBUG is defined.  A host with its own abort defines HEARTH_ASSERT(condition) before it includes
/// any header of hearth.
#ifndef HEARTH_ASSERT
#include <cassert>
#define HEARTH_ASSERT(condition) assert(condition)
#endif
