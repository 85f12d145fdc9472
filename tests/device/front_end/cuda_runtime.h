// SPDX-License-Identifier: MIT
#pragma once

/// Stands in for CUDA's header where no CUDA is installed: just enough for Clang to check, without producing code, that
/// functions called in kernels are functions of the device.
#define __CUDACC__ 1
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))

#include <stdlib.h>

extern "C" {
__device__ double atan2(double, double) noexcept;
__device__ double cbrt(double) noexcept;
__device__ double exp(double) noexcept;
__device__ double expm1(double) noexcept;
__device__ double fabs(double) noexcept;
__device__ double log(double) noexcept;
__device__ double log1p(double) noexcept;
__device__ double pow(double, double) noexcept;
__device__ double sqrt(double) noexcept;
}

struct dim3 {
    unsigned x, y, z;
    dim3(unsigned x_ = 1, unsigned y_ = 1, unsigned z_ = 1) : x(x_), y(y_), z(z_) {}
};
struct device_index {
    unsigned x, y, z;
};
extern __device__ const device_index threadIdx, blockIdx, blockDim;

enum cudaError_t { cudaSuccess };
enum cudaMemcpyKind { cudaMemcpyHostToDevice, cudaMemcpyDeviceToHost };
cudaError_t cudaConfigureCall(dim3, dim3, decltype(sizeof(0)) = 0, void* = nullptr);
cudaError_t cudaMemcpy(void*, const void*, decltype(sizeof(0)), cudaMemcpyKind);
cudaError_t cudaFree(void*);
cudaError_t cudaGetLastError();
cudaError_t cudaGetDeviceCount(int*);
const char* cudaGetErrorString(cudaError_t);
template <class T>
cudaError_t cudaMalloc(T**, decltype(sizeof(0)));
