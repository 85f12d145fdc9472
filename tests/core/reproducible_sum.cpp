// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <hearth/core/reproducible_sum.hpp>

namespace {

double sum_of(const std::vector<double>& terms, double bound) {
    hearth::reproducible_sum sum(bound, static_cast<std::int64_t>(terms.size()));
    for (const double term : terms) sum.add(term);
    return sum.value();
}

}  // namespace

TEST_CASE("reproducible sum: the order of the terms does not change a bit") {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        CAPTURE(seed);
        std::mt19937_64 random(seed);
        std::vector<double> terms;
        for (int k = 0; k < 2000; ++k) {
            const double mantissa = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
            terms.push_back(std::ldexp(mantissa, static_cast<int>(random() % 60) - 30));
        }
        const double bound = 0x1p30;
        const double expected = sum_of(terms, bound);
        long double exact = 0;  // 64 bits of 2^30: the terms reach down to 2^-83, so this rounds at 2^-34 a step
        for (const double term : terms) exact += static_cast<long double>(term);
        // long double itself rounds 2000 times at 2^-64 of at most 2^41
        CHECK(std::abs(static_cast<long double>(expected) - exact) <= 2000 * 0x1p-23L + std::abs(exact) * 0x1p-52L);
        for (int k = 0; k < 5; ++k) {
            std::shuffle(terms.begin(), terms.end(), random);
            CHECK(sum_of(terms, bound) == expected);
        }
    }
}

TEST_CASE("reproducible sum: exact where the sum is a double") {
    CHECK(sum_of({}, 1.0) == 0.0);
    CHECK(sum_of({0.0}, 0.0) == 0.0);
    CHECK(sum_of({1e300, -1e300, 1.0}, 1e300) == 0.0);  // 1 lies below the resolution of 1e300, as documented
    CHECK(sum_of({1e16, 1.0, -1e16}, 1e16) == 1.0);
    const double tiny = std::numeric_limits<double>::denorm_min();
    CHECK(sum_of({tiny, tiny, tiny}, tiny) == 3 * tiny);
    CHECK(sum_of({std::numeric_limits<double>::max()}, std::numeric_limits<double>::max()) ==
          std::numeric_limits<double>::max());
}

TEST_CASE("reproducible sum: a million equal terms lose nothing") {
    const std::vector<double> terms(1000000, 0.1);
    // 0.1 as a double times a million, exactly, then rounded once
    CHECK(sum_of(terms, 0.1) == static_cast<double>(1000000.0L * static_cast<long double>(0.1)));
}
