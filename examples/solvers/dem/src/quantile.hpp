// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <hearth/dem/ranks.hpp>

namespace hearth::dem::detail {

/// About the coordinate below which `wanted` of those of all ranks lie: an interval is narrowed by counts to 2^-30 of its
/// width.  Counts are integers, so the result is the same on any number of ranks.
template <class Coordinate>
double quantile(std::size_t count, Coordinate&& at, double low, double high, std::int64_t wanted, const ranks& among) {
    constexpr std::size_t bins = 64;
    for (int round = 0; round < 5 && low < high; ++round) {
        const double per_width = bins / (high - low);
        std::array<std::int64_t, bins + 1> inside{};  // below the interval, then bin by bin
        for (std::size_t i = 0; i < count; ++i) {
            const double place = (at(i) - low) * per_width;
            if (place < bins) ++inside[place < 0 ? 0 : static_cast<std::size_t>(place) + 1];
        }
        among.sum(inside.data(), inside.size());
        std::int64_t below = inside[0];
        std::size_t bin = 0;
        while (bin + 1 < bins && below + inside[bin + 1] < wanted) below += inside[++bin];
        const double width = (high - low) / bins, begin = low + static_cast<double>(bin) * width;
        low = begin;
        high = begin + width;
    }
    return high;
}

}  // namespace hearth::dem::detail
