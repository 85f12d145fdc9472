// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cuda_runtime.h>
#include <vector>

#include "device/device.hpp"
#include "device/probes.hpp"

namespace {

template <class Probe, class Real>
__global__ void evaluate(Probe probe, const Real* in, std::size_t inputs, Real* out, std::size_t rows) {
    const std::size_t row = std::size_t(blockIdx.x) * blockDim.x + threadIdx.x;
    if (row < rows) out[row] = probe(in + row * inputs);
}

/// A copy of the inputs or room for the outputs on the device.
template <class Real>
class device_array {
  public:
    explicit device_array(std::size_t size) : bytes_(size * sizeof(Real)), status_(cudaMalloc(&data_, bytes_)) {}
    ~device_array() { cudaFree(data_); }
    device_array(const device_array&) = delete;
    device_array& operator=(const device_array&) = delete;

    Real* data() const { return data_; }
    bool take(const Real* from) {
        if (status_ == cudaSuccess) status_ = cudaMemcpy(data_, from, bytes_, cudaMemcpyHostToDevice);
        return status_ == cudaSuccess;
    }
    bool give(Real* to) {
        if (status_ == cudaSuccess) status_ = cudaMemcpy(to, data_, bytes_, cudaMemcpyDeviceToHost);
        return status_ == cudaSuccess;
    }

  private:
    Real* data_ = nullptr;
    std::size_t bytes_;
    cudaError_t status_;
};

template <class Real>
bool run(int number, const std::vector<Real>& in, std::vector<Real>& out) {
    device_array<Real> device_in(in.size()), device_out(out.size());
    if (!device_in.take(in.data())) return false;
    int next = 0;
    hearth_test::for_each_device_function([&](const auto& probe) {
        if (next++ != number) return;
        const unsigned threads = 128, blocks = static_cast<unsigned>((out.size() + threads - 1) / threads);
        evaluate<<<blocks, threads>>>(probe, device_in.data(), in.size() / out.size(), device_out.data(), out.size());
    });
    return cudaGetLastError() == cudaSuccess && device_out.give(out.data());
}

}  // namespace

const char* hearth_test::missing_device() {
    int devices = 0;
    const cudaError_t status = cudaGetDeviceCount(&devices);
    if (status != cudaSuccess) return cudaGetErrorString(status);
    return devices == 0 ? "no device" : "";
}

bool hearth_test::evaluate_on_device(int number, const std::vector<float>& in, std::vector<float>& out) {
    return run(number, in, out);
}

bool hearth_test::evaluate_on_device(int number, const std::vector<double>& in, std::vector<double>& out) {
    return run(number, in, out);
}
