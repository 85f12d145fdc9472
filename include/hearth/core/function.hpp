// SPDX-License-Identifier: MIT
#pragma once

/// Marks what hosts may also call inside GPU kernels.  Empty for a plain C++ compiler.
/// A host with a spelling of its own (KOKKOS_FUNCTION, AMREX_GPU_HOST_DEVICE) may define it before the first include.
#ifndef HEARTH_FUNCTION
#if defined(__CUDACC__) || defined(__HIPCC__)
#define HEARTH_FUNCTION __host__ __device__
#else
#define HEARTH_FUNCTION
#endif
#endif
