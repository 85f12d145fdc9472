// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstdint>

#include <hearth/mpi/communicator.hpp>

#include "support/vfs_distributed.hpp"

using namespace hearth;
using namespace hearth::test;

TEST_CASE("vfs over MPI: field, transfer and report are bitwise those of one rank") {
    const mpi::communicator world;
    for (int seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        const vfs_case example(static_cast<std::uint64_t>(seed), 2000);
        CHECK(compare_with_serial(example, static_cast<std::uint64_t>(seed), world) == "");
    }
}

TEST_CASE("vfs over MPI: every rank refuses what any of them has to refuse") {
    const mpi::communicator world;
    for (int seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        const vfs_case example(static_cast<std::uint64_t>(seed), 500);
        CHECK(compare_errors(example, static_cast<std::uint64_t>(seed), world) == "");
    }
}

TEST_CASE("vfs over MPI: a rank does and holds no more than its cells and what is near them asks for") {
    CHECK(compare_work(mpi::communicator()) == "");
}
