// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

/// The two halves of the device test: kernels.cu is for the device's compiler, device.cpp for the host's alone, because
/// the check needs long double, which devices do not have.
namespace hearth_test {

/// Empty, or why nothing can run here.
const char* missing_device();

/// Runs the function of that number (in the order of for_each_device_function) on all rows of inputs; false after an
/// error of the device.
bool evaluate_on_device(int number, const std::vector<float>& in, std::vector<float>& out);
bool evaluate_on_device(int number, const std::vector<double>& in, std::vector<double>& out);

}  // namespace hearth_test
