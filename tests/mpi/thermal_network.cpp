// SPDX-License-Identifier: MIT
#include <cstdint>

#include <doctest/doctest.h>

#include <hearth/mpi/communicator.hpp>

#include "support/network_ranks.hpp"

TEST_CASE("thermal network: over MPI ranks it is that of one rank, and no joule is lost between them") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        CAPTURE(seed);
        CHECK(hearth_test::compare_networks(hearth::mpi::communicator(), seed) == "");
    }
}
