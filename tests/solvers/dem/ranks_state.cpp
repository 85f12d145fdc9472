// SPDX-License-Identifier: MIT
// A state of a bed that ranks share is as many parts; any number of ranks can read them.
#include <hearth/dem/bed.hpp>

#include <doctest/doctest.h>

#include "solvers/dem/shared.hpp"

using namespace hearth::dem;
using hearth_test::differing;
using hearth_test::plant;
using hearth_test::shared_by_all;

namespace {

using bytes = std::vector<char>;

/// The parts of all ranks.
std::vector<bytes> gathered(const bed& b, const bytes& mine) {
    const std::vector<std::int64_t> sizes = b.among().gather(std::vector<std::int64_t>{static_cast<std::int64_t>(mine.size())});
    const bytes all = b.among().gather(mine);
    std::vector<bytes> parts;
    auto from = all.begin();
    for (const std::int64_t size : sizes) {
        parts.emplace_back(from, from + size);
        from += size;
    }
    return parts;
}

struct moment {
    bytes mine;
    std::vector<bytes> parts;
    feed::state fed;
    outflow::state left;
};

moment save(const plant& p) {
    const bytes mine = p.b.state();
    return {mine, gathered(p.b, mine), p.source.now(), p.sink.now()};
}

void resume(plant& p, const moment& m, const std::vector<bytes>& parts) {
    p.b.restore_parts(parts);
    p.source.restore(m.fed);
    p.sink.restore(m.left);
}

}  // namespace

TEST_CASE("ranks: N + N steps equal 2 N bit for bit, on these ranks, on one, and from one to these") {
    plant whole(shared_by_all());
    whole.run(900);
    const moment half = save(whole);
    whole.run(600);

    plant again(shared_by_all());
    again.run(100);  // whatever it was before
    resume(again, half, {half.mine});
    CHECK(again.b.state() == half.mine);
    again.run(600);
    CHECK(again.b.state() == whole.b.state());
    CHECK(again.sink.now().taken == whole.sink.now().taken);

    plant alone(decomposition{});
    resume(alone, half, half.parts);
    alone.run(600);
    CHECK(differing(whole.b, alone.b) == 0);

    // From one rank: the last gives what there is, the others nothing.
    plant single(decomposition{});
    resume(single, half, half.parts);
    const moment undivided = save(single);
    plant spread(shared_by_all());
    const bool gives = spread.b.among().rank() == spread.b.among().size() - 1;
    resume(spread, undivided, gives ? std::vector<bytes>{undivided.mine} : std::vector<bytes>{});
    spread.run(600);
    CHECK(differing(spread.b, alone.b) == 0);

    // Or all parts by the first rank.
    plant first(shared_by_all(0));
    resume(first, half, first.b.among().rank() == 0 ? half.parts : std::vector<bytes>{});
    first.run(600);
    CHECK(differing(first.b, alone.b) == 0);
}

TEST_CASE("ranks: parts that are damaged, missing, given twice or of another time are refused on all ranks") {
    plant made(shared_by_all());
    made.run(200);
    const moment earlier = save(made);
    made.run(200);
    const moment later = save(made);
    plant other(shared_by_all());
    other.run(100);
    const auto before = other.b.state();
    const int rank = other.b.among().rank(), ranks = other.b.among().size();
    const auto refused = [&](const std::vector<bytes>& parts) {
        CHECK_THROWS_AS(other.b.restore_parts(parts), state_error);
        CHECK(other.b.state() == before);
    };
    bytes damaged = later.mine;
    if (rank == ranks - 1) damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
    refused({damaged});
    refused({});
    refused(rank == 0 ? std::vector<bytes>{later.mine, later.mine} : std::vector<bytes>{later.mine});
    if (ranks > 1) {
        refused(rank == 0 ? std::vector<bytes>{} : std::vector<bytes>{later.mine});
        refused({rank == 0 ? earlier.mine : later.mine});
    }
}
