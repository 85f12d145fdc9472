// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <set>
#include <vector>

#include <hearth/voidage/vfs_cells.hpp>

#include "support/random.hpp"

TEST_CASE("ordered set: gives back what was put in, in order, and is empty afterwards") {
    hearth_test::seeded random(1);
    for (const std::size_t size : {0u, 1u, 63u, 64u, 65u, 4096u, 4097u, 300000u}) {
        CAPTURE(size);
        hearth::detail::ordered_set members(size);
        for (int round = 0; round < 3; ++round) {
            std::set<std::size_t> expected;
            if (size > 0) {
                expected = {0, size - 1};
                for (int k = 0; k < 500; ++k) expected.insert(random.index(size));
            }
            for (auto i = expected.rbegin(); i != expected.rend(); ++i) members.insert(*i);
            for (const std::size_t i : expected) members.insert(i);
            std::vector<std::size_t> drained;
            members.drain([&](std::size_t i) { drained.push_back(i); });
            CHECK(drained == std::vector<std::size_t>(expected.begin(), expected.end()));
            members.drain([&](std::size_t) { FAIL("not empty"); });
        }
    }
}

TEST_CASE("two sum: sum and error are exact together") {
    hearth_test::seeded random(2);
    for (int k = 0; k < 10000; ++k) {
        const double a = random.log_uniform(1e-12, 1e12), b = random.uniform(-1e3, 1e3);
        const hearth::detail::two_sum s(a, b);
        CHECK(s.sum == a + b);
        // 2^-53 of either number is below 2^-104 of the other: long double holds both sides where it has 64 bits.
        CHECK(static_cast<double>(static_cast<long double>(a) + static_cast<long double>(b) - static_cast<long double>(s.sum)) ==
              doctest::Approx(s.error).epsilon(1e-3));
    }
    const hearth::detail::two_sum tiny(1.0, 0x1p-80);
    CHECK(tiny.sum == 1.0);
    CHECK(tiny.error == 0x1p-80);
}
