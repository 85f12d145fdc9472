// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace hearth::dem {

/// Random numbers whose whole state is one number, the same on every machine: splitmix64 of Steele, Lea and Flood,
/// doi:10.1145/2660193.2660195.
struct random_source {
    std::uint64_t state = 1;

    std::uint64_t next() {
        std::uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double uniform() { return std::ldexp(static_cast<double>(next() >> 11), -53); }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
};

}  // namespace hearth::dem
