// SPDX-License-Identifier: MIT
#pragma once

/// Version of the headers.  The only place where it is written: CMake reads it from here.
#define HEARTH_VERSION_MAJOR 0
#define HEARTH_VERSION_MINOR 1
#define HEARTH_VERSION_PATCH 0
