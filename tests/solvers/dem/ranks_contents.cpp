// SPDX-License-Identifier: MIT
// What belongs to the particles of a bed that ranks share: it goes along, and is saved and read on any number of ranks.
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include <hearth/closure/gunn.hpp>
#include <hearth/dem/wet_bed.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/tssm.hpp>
#include <hearth/transfer/species.hpp>

#include "solvers/dem/shared.hpp"
#include "support/warm_bed.hpp"

using namespace hearth::dem;
using hearth_test::by_id;
using hearth_test::differing;
using hearth_test::plant;
using hearth_test::shared_by_all;

namespace {

constexpr double moisture = 0.02;
const hearth::drying water_term{hearth::closure::gunn{}};
const hearth::constant_specific_heat<> cp{840};
const auto caloric = [](std::size_t) -> const hearth::constant_specific_heat<>& { return cp; };

/// The stirred plant, whose particles are wet and dry in air of 400 K.
struct wet_plant {
    plant made;
    thermal_bed heated;
    wet_bed wet;
    double evaporated = 0;  ///< on this rank [kg]

    explicit wet_plant(const decomposition& spread)
        : made(spread), heated(made.b, {840, 4, 1}), wet(heated, moisture) {}
    void run(int steps) {
        for (int k = 0; k < steps; k += 50) {
            made.run(50);
            wet.follow();
            const auto n = static_cast<std::size_t>(made.b.size());
            const hearth_test::gas_samples gas(n);
            std::vector<hearth::heat_bath<double>> baths(n);
            for (auto& bath : baths) bath.add(hearth::conductive_link<double>{0.05}, 400.0);
            evaporated += wet.dry(water_term, gas, baths, caloric, hearth::tssm(500.0), 0.004).evaporated;
        }
    }
    double over_ranks(double mine) const {
        double sum = 0;
        for (const double part : made.b.among().gather(std::vector<double>{mine})) sum += part;
        return sum;
    }
};

int differing_contents(const wet_plant& mine, const wet_plant& alone) {
    const auto there = by_id(alone.made.b);
    int count = 0;
    for (std::int32_t i = 0; i < mine.made.b.size(); ++i) {
        const auto &one = mine.wet.contents()[static_cast<std::size_t>(i)],
                   &other = alone.wet.contents()[static_cast<std::size_t>(there.at(mine.made.b.ids()[i]))];
        count += one.dry != other.dry || one.water != other.water;
    }
    return count;
}

}  // namespace

TEST_CASE("ranks: values by id go along with their particles, are made once, and end once") {
    plant p(shared_by_all());
    per_particle<std::int64_t> marks;
    std::int64_t made = 0, ended = 0;
    const auto follow = [&] {
        marks.follow(
            p.b, [&](std::int32_t i) { return ++made, p.b.ids()[i]; }, [&](std::int64_t) { ++ended; });
        int wrong = 0;
        for (std::int32_t i = 0; i < p.b.size(); ++i)
            wrong += marks.values()[static_cast<std::size_t>(i)] != p.b.ids()[i];
        CHECK(wrong == 0);
    };
    for (int k = 0; k < 12; ++k) {
        p.run(100);
        if (k % 3 != 1) follow();  // what happened in between counts once, too
    }
    follow();
    CHECK(p.b.among().sum(made) >= p.b.size_over_ranks());
    CHECK(p.b.among().sum(made) - p.b.among().sum(ended) == p.b.size_over_ranks());
    CHECK(p.b.among().sum(ended) > 0);
    CHECK(p.b.among().sum(ended) <= p.sink.now().particles);
    per_particle<std::string> names;
    const auto named = [&] {
        names.follow(
            p.b, [](std::int32_t) { return std::string("new"); }, [](const std::string&) {});
    };
    if (p.b.is_shared())
        CHECK_THROWS_AS(named(), std::invalid_argument);
    else
        named();
}

TEST_CASE("ranks: a wet bed dries and moves with the bits of one rank, and goes on from a state on others") {
    wet_plant mine(shared_by_all()), alone(decomposition{});
    for (int part = 0; part < 3; ++part) {
        mine.run(300);
        alone.run(300);
        CHECK(differing(mine.made.b, alone.made.b) == 0);  // masses that have changed on both sides of a border
        CHECK(differing_contents(mine, alone) == 0);
        const double brought = mine.over_ranks(mine.wet.water_brought());
        CHECK(std::fabs(brought / alone.wet.water_brought() - 1) < 1e-12);
        CHECK(std::fabs(brought - mine.over_ranks(mine.wet.water_carried_out()) - mine.over_ranks(mine.evaporated) -
                        mine.over_ranks(mine.wet.water())) < 1e-12 * brought);
    }
    CHECK(mine.over_ranks(mine.evaporated) > 0.01 * mine.over_ranks(mine.wet.water_brought()));
    CHECK(mine.over_ranks(mine.wet.water_carried_out()) > 0);

    // One rank's state on all ranks: the last gives it.
    wet_plant again(shared_by_all());
    const bool gives = again.made.b.among().rank() == again.made.b.among().size() - 1;
    again.made.b.restore_parts(gives ? std::vector<std::vector<char>>{alone.made.b.state()}
                                     : std::vector<std::vector<char>>{});
    again.made.source.restore(alone.made.source.now());
    again.made.sink.restore(alone.made.sink.now());
    again.wet.restore(gives ? alone.wet.now() : wet_bed::state{});
    again.run(200);
    alone.run(200);
    CHECK(differing(again.made.b, alone.made.b) == 0);
    CHECK(differing_contents(again, alone) == 0);
    CHECK(std::fabs(again.over_ranks(again.wet.water_brought()) / alone.wet.water_brought() - 1) < 1e-12);
    CHECK_THROWS_AS(again.wet.restore({{1, 2}, {}, 0, 0}), hearth::bad_value);
}
