// SPDX-License-Identifier: MIT
// Closures, integrators and limits on a device, against the same functions on the host and in long double.
// Exit code 77: there is no device, the kernels were compiled and not run.
#include "device/device.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <vector>

#include "device/probes.hpp"
#include "support/closure_condition.hpp"

namespace {

/// True if each result is within 16 units in the last place of the host's, or, like the host's, within 4 units times
/// the condition number of the exact one.
template <class Real, class Probe>
bool agrees(const Probe& probe, int number) {
    const char* const name = Probe::about().name;
    const std::size_t rows = 2048, inputs = Probe::about().inputs.size();
    std::vector<Real> in, out(rows);
    hearth_test::seeded random(51);
    for (std::size_t row = 0; row < rows; ++row)
        for (const double x : hearth_test::draw<Probe>(random)) in.push_back(static_cast<Real>(x));
    if (!hearth_test::evaluate_on_device(number, in, out)) {
        std::printf("%s: failed on the device\n", name);
        return false;
    }

    const double unit = static_cast<double>(std::numeric_limits<Real>::epsilon());
    double farthest = 0;
    int wrong = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        const Real* const x = in.data() + row * inputs;
        const double apart = hearth_test::relative_error(out[row], static_cast<long double>(probe(x))) / unit;
        if (!(apart <= farthest)) farthest = apart;
        if (apart <= 16) continue;
        const std::vector<long double> exact_x(x, x + inputs);
        const double error = hearth_test::relative_error(out[row], probe(exact_x.data())) / unit;
        if (!(error <= 4 * hearth_test::condition(probe, exact_x))) ++wrong;
    }
    std::printf("%-30s %2d bits: at most %4.1f units in the last place from the host, %d of %d wrong\n", name,
                std::numeric_limits<Real>::digits, farthest, wrong, static_cast<int>(rows));
    return wrong == 0;
}

}  // namespace

int main() {
    const char* const missing = hearth_test::missing_device();
    if (*missing != '\0') {
        std::printf("skipped: %s; the kernels were compiled\n", missing);
        return 77;
    }
    bool all = true;
    int number = 0;
    hearth_test::for_each_device_function([&](const auto& probe) {
        all = agrees<float>(probe, number) && all;
        all = agrees<double>(probe, number) && all;
        ++number;
    });
    return all ? 0 : 1;
}
