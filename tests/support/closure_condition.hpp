// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "support/random.hpp"

/// How precisely a closure of closure_probes.hpp can be evaluated at all.
namespace hearth_test {

/// Inputs drawn from a probe's ranges.
template <class Probe>
std::vector<double> draw(seeded& random) {
    std::vector<double> x;
    for (const auto& range : Probe::about().inputs) x.push_back(random.log_uniform(range.lo, range.hi));
    return x;
}

/// The same numbers in another precision.
template <class To, class From>
std::vector<To> as(const std::vector<From>& x) {
    return {x.begin(), x.end()};
}

/// |value - exact| / |exact|.
template <class Real>
double relative_error(Real value, long double exact) {
    return static_cast<double>(std::fabs((static_cast<long double>(value) - exact) / exact));
}

/// Derivative by the logarithm of input i, by central differences in long double.
/// The step of 1e-7 leaves an error of 1e-12 by rounding and, at the sharpest bend (a dip 0.03 wide), 1e-8 by
/// curvature.
template <class Probe>
long double logarithmic_slope(const Probe& probe, std::vector<long double> x, std::size_t i) {
    const long double middle = x[i], step = 1e-7L;
    x[i] = middle * (1 + step);
    const long double above = probe(x.data());
    x[i] = middle * (1 - step);
    return (above - probe(x.data())) / (2 * step);
}

/// Relative condition number: how many round-offs of the output one round-off of the inputs makes.
template <class Probe>
double condition(const Probe& probe, const std::vector<long double>& x) {
    const long double f = probe(x.data());
    long double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += std::fabs(logarithmic_slope(probe, x, i));
    return static_cast<double>(sum / std::fabs(f));
}

/// Round-offs that a closure may lose beside its condition number.  The worst sum of magnitudes over result is that of
/// Gunn's second polynomial at void fraction 1, 4.93/0.13 = 38; the largest exponent that is taken is about 30.
inline constexpr double round_offs = 64;

}  // namespace hearth_test
