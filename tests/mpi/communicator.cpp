// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/mpi/communicator.hpp>

TEST_CASE("mpi communicator: reductions over all ranks") {
    const hearth::mpi::communicator ranks;
    const int n = ranks.size();
    CHECK(ranks.max(static_cast<double>(ranks.rank())) == n - 1);
    CHECK(ranks.max(std::int64_t{1} << (40 + ranks.rank())) == std::int64_t{1} << (39 + n));
    std::int64_t sums[] = {1, ranks.rank()};
    ranks.sum(sums, 2);
    CHECK(sums[0] == n);
    CHECK(sums[1] == std::int64_t{n} * (n - 1) / 2);
    CHECK(ranks.any(ranks.rank() == n - 1));
    CHECK_FALSE(ranks.any(false));
}

TEST_CASE("mpi communicator: parcels arrive once, whole and in order of rank") {
    struct value { std::int64_t from, to, k; };
    const hearth::mpi::communicator ranks;
    for (int round = 0; round < 20; ++round) {  // repeated: messages of two rounds must not mix
        std::vector<hearth::parcel<value>> outgoing;
        for (int to = 0; to < ranks.size(); ++to) {
            if ((to + ranks.rank() + round) % 3 == 0) continue;  // some ranks get nothing
            outgoing.push_back({to, {}});
            for (int k = 0; k < 5 * to + round; ++k) outgoing.back().values.push_back({ranks.rank(), to, k});
        }
        int next = 0, wrong = 0;
        for (const auto& from : ranks.exchange(std::move(outgoing))) {
            wrong += from.rank < next;
            next = from.rank + 1;
            wrong += (ranks.rank() + from.rank + round) % 3 == 0;
            wrong += from.values.size() != static_cast<std::size_t>(5 * ranks.rank() + round);
            for (std::size_t k = 0; k < from.values.size(); ++k) {
                wrong += from.values[k].from != from.rank || from.values[k].to != ranks.rank() ||
                         from.values[k].k != static_cast<std::int64_t>(k);
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("mpi communicator: a ring of ghosts, two gathers under way at once") {
    const hearth::mpi::communicator ranks;
    const int n = ranks.size(), right = (ranks.rank() + 1) % n, left = (ranks.rank() + n - 1) % n;
    const std::vector<hearth::link> exports{{right, 0, 1}}, imports{{left, 0, 1}};
    const double mine = ranks.rank();
    const float mine_too = 10.0F * static_cast<float>(ranks.rank());
    double theirs = -1;
    float theirs_too = -1;
    auto first = ranks.begin(&mine, exports, &theirs, imports);
    auto second = ranks.begin(&mine_too, exports, &theirs_too, imports);
    ranks.end(second);
    ranks.end(first);
    CHECK(theirs == left);
    CHECK(theirs_too == 10.0F * static_cast<float>(left));
}

TEST_CASE("agreement: every rank throws the error of the lowest rank that found one") {
    const hearth::mpi::communicator ranks;
    CHECK_NOTHROW(hearth::throw_agreed(ranks, std::nullopt));
    std::optional<hearth::bad_value> mine;
    if (ranks.rank() >= ranks.size() / 2) mine.emplace("volume of cell", ranks.rank(), -1.5, "finite and > 0 [m^3]");
    std::string text;
    try {
        hearth::throw_agreed(ranks, mine);
    } catch (const hearth::bad_value& error) {
        text = error.what();
        CHECK(error.index == ranks.size() / 2);
        CHECK(error.value == -1.5);
    }
    CHECK(text == "hearth: volume of cell " + std::to_string(ranks.size() / 2) + " is -1.5, allowed: finite and > 0 [m^3]");
}
