// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace hearth_test {

/// Integral over a length by Takahashi and Mori's double exponential rule in long double: the oracle for integrands
/// that are steep or have a root at an end.  integrand(from_start, to_end) gets the distance from either end, so that
/// neither loses its digits close to it.
template <class Integrand>
long double tanh_sinh(long double length, Integrand&& integrand) {
    if (!(length > 0)) return 0;
    const long double half_pi = 1.57079632679489661923L, step = 1.0L / 64;
    long double sum = 0;
    for (int k = -400; k <= 400; ++k) {
        const long double x = step * static_cast<long double>(k);
        const long double decay = std::exp(-2 * std::fabs(half_pi * std::sinh(x)));
        const long double near = length * decay / (1 + decay), far = length / (1 + decay);
        const long double weight = half_pi * std::cosh(x) * 2 * near / (1 + decay);
        if (weight > 0) sum += step * weight * (x < 0 ? integrand(near, far) : integrand(far, near));
    }
    return sum;
}

}  // namespace hearth_test
