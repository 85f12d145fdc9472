// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "support/thread_communicator.hpp"
#include "support/vfs_distributed.hpp"

using namespace hearth;
using namespace hearth::test;

namespace {

/// What each rank has to say, in one text.
template <class Body>
std::string on_all(int ranks, Body&& body) {
    std::vector<std::string> found(static_cast<std::size_t>(ranks));
    on_ranks(ranks, [&](const thread_communicator& communicator) {
        found[static_cast<std::size_t>(communicator.rank())] = body(communicator);
    });
    std::string all;
    for (const std::string& text : found) all += text;
    return all;
}

}  // namespace

TEST_CASE("vfs on ranks: field, transfer and report are bitwise those of one rank") {
    for (int seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        const vfs_case example(static_cast<std::uint64_t>(seed), 2000);
        for (const int ranks : {1, 2, 3, 5, 8}) {
            CAPTURE(ranks);
            CHECK(on_all(ranks, [&](const thread_communicator& communicator) {
                      return compare_with_serial(example, static_cast<std::uint64_t>(seed), communicator);
                  }) == "");
        }
    }
}

TEST_CASE("vfs on ranks: every rank refuses what any of them has to refuse") {
    for (int seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        const vfs_case example(static_cast<std::uint64_t>(seed), 500);
        for (const int ranks : {1, 2, 4, 7}) {
            CAPTURE(ranks);
            CHECK(on_all(ranks, [&](const thread_communicator& communicator) {
                      return compare_errors(example, static_cast<std::uint64_t>(seed), communicator);
                  }) == "");
        }
    }
}

TEST_CASE("vfs on ranks: a rank does and holds no more than its cells and what is near them asks for") {
    for (const int ranks : {2, 4, 8}) {
        CAPTURE(ranks);
        CHECK(on_all(ranks, [](const thread_communicator& communicator) { return compare_work(communicator); }) == "");
    }
}
