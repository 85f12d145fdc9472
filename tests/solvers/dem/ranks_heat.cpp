// SPDX-License-Identifier: MIT
// Heat between particles of several ranks: contacts and neighbours to 2.5 diameters through the library.
#include <hearth/dem/thermal_bed.hpp>

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>

#include "solvers/dem/shared.hpp"

using namespace hearth::dem;
using hearth_test::by_id;
using hearth_test::feed_into;
using hearth_test::shared_by_all;
using hearth_test::soft_settings;
using hearth_test::tube_on_floor;
using hearth_test::wall_of;

namespace {

constexpr double d = 0.018;

/// A bed that has fallen for a while and goes on; hot where its ids say so.
struct warm_bed {
    bed b;
    double exchanged = 0;  ///< largest heat rate seen [W]

    explicit warm_bed(const decomposition& spread) : b(soft_settings(0.3, 0.5), spread) {
        b.add_wall(wall_of(b.settings(), shape::plane({0, 0, 0}, {0, 0, 1})));
        b.add_wall(wall_of(b.settings(), shape::cylinder({0, 0, -1}, {0, 0, 1}, 4 * d)));
        feed source = feed_into({{0, 0, 0}, 4 * d, 7 * d}, 3580, 0.8 * d, d);
        source.fill(b);
        b.advance(1500);
    }
    void heat_up(double cold, double hot) {
        for (std::int32_t i = 0; i < b.size(); ++i) b.temperatures()[i] = b.ids()[i] % 7 < 3 ? hot : cold;
    }
    /// Explicit steps of conduction between particles and of radiation to 2.5 diameters, while the bed moves on.
    void run(int steps, double seconds) {
        const hearth::scene exchange{hearth::conduction{hearth::closure::zhang::constriction{}},
                                     hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}}};
        for (int k = 0; k < steps; ++k) {
            b.advance(20);
            b.update_ghosts();
            thermal_bed warm(b, {800, 4, 0.9});
            auto links = exchange.links(warm, warm);
            links.walls.clear();  // closed
            links.surroundings.clear();
            for (auto& part : links.parts) part.walls = part.surroundings = 0;
            std::vector<double> heat(static_cast<std::size_t>(b.size() + b.ghost_count()), 0.0);
            hearth::accumulate(links, b.temperatures(), [](int) { return 300.0; }, heat);
            for (std::int32_t i = 0; i < b.size(); ++i) {
                b.temperatures()[i] += seconds * heat[static_cast<std::size_t>(i)] / (800 * b.mass(i));
                exchanged = std::fmax(exchanged, std::fabs(heat[static_cast<std::size_t>(i)]));
            }
        }
    }
    /// One implicit step of the same exchange through the network of all ranks.
    void step_implicitly(double seconds) {
        b.update_ghosts();
        thermal_bed warm(b, {800, 4, 0.9});
        const hearth::scene exchange{hearth::conduction{hearth::closure::zhang::constriction{}},
                                     hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}}};
        const auto links = exchange.links(warm, warm);
        std::vector<double> mass, kelvin;
        for (std::int32_t i = 0; i < b.size(); ++i) {
            mass.push_back(b.mass(i));
            kelvin.push_back(b.temperatures()[i]);
        }
        const hearth::constant_specific_heat<double> caloric{800};
        const auto caloric_of = [&](std::size_t) -> const auto& { return caloric; };
        const std::vector<hearth::heat_bath<double>> baths(mass.size());
        std::vector<hearth::particle_step<double>> taken;
        hearth::thermal_network::params settings;
        // The first pass is rough, and the solver's path is another on other ranks: on until none of that is left.
        settings.passes = 12;
        hearth::thermal_network network(settings);
        if (b.is_shared()) {
            const hearth::particle_halo<hearth::mpi::communicator> halo(
                hearth::mpi::communicator(), std::vector<std::int64_t>(b.ids(), b.ids() + b.size()), ghosts_of(b));
            network.advance(links.pairs, baths, mass, caloric_of, hearth::unsplit{}, seconds, kelvin, taken, halo);
        } else {
            network.advance(links.pairs, baths, mass, caloric_of, hearth::unsplit{}, seconds, kelvin, taken);
        }
        std::copy(kelvin.begin(), kelvin.end(), b.temperatures());
    }
    double energy() const {
        double sum = 0, all = 0;
        for (std::int32_t i = 0; i < b.size(); ++i) sum += 800 * b.mass(i) * b.temperatures()[i];
        for (const double part : b.among().gather(std::vector<double>{sum})) all += part;
        return all;
    }
};

}  // namespace

TEST_CASE("ranks: neighbours to 2.5 diameters are those of one rank, each pair on every rank that owns one of it") {
    warm_bed mine(shared_by_all(2, 2.5)), alone(decomposition{});
    for (int part = 0; part < 3; ++part) {
        mine.b.advance(150);
        alone.b.advance(150);
        mine.b.update_ghosts();
        const auto count = [](const bed& b, double factor) {
            std::map<std::int64_t, int> neighbours;
            b.for_each_near(factor, [&](std::int32_t i, std::int32_t j, double) {
                ++neighbours[b.ids()[i]];
                ++neighbours[b.ids()[j]];
            });
            return neighbours;
        };
        for (const double factor : {1.3, 2.5}) {
            auto there = count(alone.b, factor), here = count(mine.b, factor);
            int wrong = 0;
            for (std::int32_t i = 0; i < mine.b.size(); ++i) wrong += here[mine.b.ids()[i]] != there[mine.b.ids()[i]];
            CHECK(wrong == 0);
        }
        const auto contacts = mine.b.contact_counts(), wanted = alone.b.contact_counts();
        const auto place = by_id(alone.b);
        int wrong = 0;
        for (std::int32_t i = 0; i < mine.b.size(); ++i)
            wrong += contacts[static_cast<std::size_t>(i)] != wanted[static_cast<std::size_t>(place.at(mine.b.ids()[i]))];
        CHECK(wrong == 0);
    }
}

TEST_CASE("ranks: heat goes over their borders as within, with the energy of a closed bed; isothermal stays so") {
    warm_bed mine(shared_by_all(2, 2.5)), alone(decomposition{});
    for (warm_bed* w : {&mine, &alone}) w->heat_up(700, 1500);
    const double before = mine.energy();
    for (int part = 0; part < 3; ++part) {
        mine.run(10, 0.5);
        alone.run(10, 0.5);
        const auto there = by_id(alone.b);
        double apart = 0;
        for (std::int32_t i = 0; i < mine.b.size(); ++i)
            apart = std::fmax(apart, std::fabs(mine.b.temperatures()[i] / alone.b.temperatures()[there.at(mine.b.ids()[i])] - 1));
        // Thirty steps, each the sum of some 70 links in another order.
        CHECK(mine.b.among().max(apart) < 30 * 70 * 2.3e-16);
        CHECK(std::fabs(mine.energy() / before - 1) < 1e-12);
    }
    CHECK(mine.b.among().max(mine.exchanged) > 1);  // W: there was something to exchange

    mine.heat_up(1100, 1100);
    mine.run(5, 0.5);
    for (std::int32_t i = 0; i < mine.b.size(); ++i) CHECK(mine.b.temperatures()[i] == 1100);
}

TEST_CASE("ranks: one implicit step of any length through the network of all ranks") {
    warm_bed mine(shared_by_all(2, 2.5)), alone(decomposition{});
    for (const double seconds : {1.0, 1e3, 1e6}) {
        CAPTURE(seconds);
        for (warm_bed* w : {&mine, &alone}) w->heat_up(700, 1500);
        const double before = mine.energy();
        mine.step_implicitly(seconds);
        alone.step_implicitly(seconds);
        const auto there = by_id(alone.b);
        double apart = 0;
        for (std::int32_t i = 0; i < mine.b.size(); ++i)
            apart = std::fmax(apart, std::fabs(mine.b.temperatures()[i] - alone.b.temperatures()[there.at(mine.b.ids()[i])]));
        // Two solutions, each within 4e-10 of the range of 800 K in each of the last passes.
        CHECK(mine.b.among().max(apart) < 4 * 4e-10 * 800);
        CHECK(std::fabs(mine.energy() / before - 1) < 1e-12);
    }
}
