// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace hearth_test {

/// Seeded numbers that are the same on every platform: the distributions of <random> are not specified bit for bit.
class seeded {
  public:
    explicit seeded(std::uint64_t seed) : engine_(seed) {}

    /// In [lo, hi).
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
    }
    /// Logarithmically uniform in [lo, hi).
    double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
    /// In [0, count).
    std::size_t index(std::size_t count) { return static_cast<std::size_t>(uniform(0.0, static_cast<double>(count))); }

  private:
    std::mt19937_64 engine_;
};

}  // namespace hearth_test
