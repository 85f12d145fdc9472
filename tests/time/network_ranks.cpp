// SPDX-License-Identifier: MIT
// The thermal network over ranks that are threads; tests/mpi/thermal_network.cpp does the same over MPI.
#include "support/network_ranks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/time/limits.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/links.hpp>

#include "support/thread_communicator.hpp"

using namespace hearth;
using hearth::test::on_ranks;
using hearth::test::thread_communicator;
using hearth_test::seeded;

TEST_CASE("thermal network: over ranks it is that of one rank, within bounds, and no joule is lost between them") {
    // Threads that wait for each other take their time: more seeds on few ranks.
    for (const int ranks : {1, 2, 3, 8}) {
        CAPTURE(ranks);
        for (std::uint64_t seed = 1; seed <= (ranks < 3 ? 8U : 3U); ++seed) {
            CAPTURE(seed);
            std::vector<std::string> wrong(static_cast<std::size_t>(ranks));
            on_ranks(ranks, [&](const thread_communicator& communicator) {
                wrong[static_cast<std::size_t>(communicator.rank())] =
                    hearth_test::compare_networks(communicator, seed);
            });
            for (const std::string& text : wrong) CHECK(text == "");
        }
    }
}

TEST_CASE("thermal network: what ranks disagree on is refused on each of them, by name, and changes nothing") {
    // Two ranks of two particles each, 0 1 | 2 3, joined in the middle.
    struct input {
        std::vector<std::int64_t> ids;
        std::vector<ghost_particle> ghosts;
        std::vector<thermal_pair> pairs;
        std::vector<double> temperature{500.0, 600.0};
    };
    const auto refused = [](const char* place, const std::function<void(input&, int)>& spoil) {
        CAPTURE(place);
        std::vector<std::string> said(2);
        on_ranks(2, [&](const thread_communicator& communicator) {
            const int r = communicator.rank();
            input in{r == 0 ? std::vector<std::int64_t>{10, 11} : std::vector<std::int64_t>{12, 13},
                     {r == 0 ? ghost_particle{12, 1} : ghost_particle{11, 0}},
                     {{0, 1, {0.1, 1e-11}}, {r == 0 ? 1 : 0, 2, {0.2, 1e-11}}}};
            spoil(in, r);
            const std::vector<double> before = in.temperature;
            try {
                const particle_halo<thread_communicator> halo(communicator, in.ids, in.ghosts);
                const constant_specific_heat<> caloric{900};
                std::vector<particle_step<double>> taken;
                thermal_network().advance(
                    in.pairs, std::vector<heat_bath<double>>(in.temperature.size()),
                    std::vector<double>(in.temperature.size(), 1.0), [&](std::size_t) { return caloric; }, unsplit{},
                    1.0, in.temperature, taken, halo);
            } catch (const bad_value& error) {
                said[static_cast<std::size_t>(r)] = error.place;
                if (in.temperature != before) said[static_cast<std::size_t>(r)] += ", temperatures changed";
            }
        });
        for (const std::string& text : said) CHECK(text == place);
    };
    refused("", [](input&, int) {});
    refused("owner of ghost particle", [](input& in, int r) { in.ghosts[0].id += r; });  // nobody has it there
    refused("owner of ghost particle", [](input& in, int r) {
        in.ghosts[0].owner = 1 - r;
        in.ghosts[0].owner = r;
    });
    refused("owner of ghost particle", [](input& in, int) { in.ghosts[0].owner = 2; });
    refused("owner of ghost particle", [](input& in, int) { in.ghosts[0].owner = -1; });
    refused("id of particle", [](input& in, int) { in.ids[0] = 7; });
    const char* const across = "link over ranks of particle";
    refused(across, [](input& in, int r) {
        if (r == 1) in.pairs.pop_back();
    });  // one side forgot it
    refused(across, [](input& in, int r) {
        if (r == 0) in.pairs[1].link.conductance *= 1.001;
    });
    refused(across, [](input& in, int r) {
        if (r == 0) in.pairs[1].link.radiation = 0.0;
    });
    refused(across, [](input& in, int r) {
        if (r == 1) in.pairs[1].first = 1;
    });
    refused(across, [](input& in, int r) {
        if (r == 1) in.pairs.push_back(in.pairs[1]);
    });
    refused("second particle of pair", [](input& in, int r) { in.pairs[1].second += r; });
    refused("first particle of pair", [](input& in, int r) { in.pairs[1].first = r == 0 ? 2 : 0; });
    refused("temperature of particle", [](input& in, int r) { in.temperature[0] *= r; });
    refused("number of temperatures", [](input& in, int r) { in.temperature.resize(r == 1 ? 1 : 2); });
}

TEST_CASE("links over ranks: explicit rates and the stable step are those of one rank") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        const hearth_test::shared_network whole(seed);
        const auto no_wall = [](int) { return 300.0; };
        const auto list = [](const std::vector<thermal_pair>& pairs) {
            link_list<thermal_link<double>> links;
            links.pairs = pairs;
            links.close_part(0);
            return links;
        };
        std::vector<double> expected(whole.mass.size(), 0.0), capacity = whole.mass;
        (void)accumulate(list(whole.pairs), whole.temperature, no_wall, expected);
        for (double& c : capacity) c *= 1000;
        const double step = stable_step::network(whole.pairs, whole.baths, capacity, whole.temperature);
        double largest = 0;
        for (const double q : expected) largest = std::fmax(largest, std::fabs(q));

        const int ranks = 3;
        seeded random(seed);
        std::vector<int> owners(whole.mass.size());
        for (int& owner : owners) owner = static_cast<int>(random.index(ranks));
        std::vector<double> steps(ranks), wrong(ranks);
        on_ranks(ranks, [&](const thread_communicator& communicator) {
            const auto r = static_cast<std::size_t>(communicator.rank());
            const hearth_test::network_share share(whole, owners, communicator.rank(), seed);
            const particle_halo<thread_communicator> halo(communicator, share.ids, share.ghosts);
            std::vector<double> t = share.temperature, own = share.mass;
            t.resize(t.size() + halo.ghost_count());
            halo.gather(t);
            std::vector<double> heat(t.size(), 0.0);
            (void)accumulate(list(share.pairs), t, no_wall, heat);
            for (double& c : own) c *= 1000;
            steps[r] = stable_step::network(share.pairs, share.baths, own, t);
            for (std::size_t k = 0; k < share.owned.size(); ++k)
                wrong[r] = std::fmax(wrong[r], std::fabs(heat[k] - expected[share.owned[k]]));
        });
        // Sums of at most some tens of terms, in another order.
        CHECK(*std::min_element(steps.begin(), steps.end()) == doctest::Approx(step).epsilon(1e-13));
        for (const double w : wrong) CHECK(w <= 1e-13 * largest);
    }
}

TEST_CASE("particle halo: ghosts in any order get their owners' values") {
    on_ranks(3, [](const thread_communicator& communicator) {
        const int r = communicator.rank();
        // Rank r owns 10 r, 10 r + 1, ..., and holds ghosts of both others, mixed.
        const std::vector<std::int64_t> ids{10 * r, 10 * r + 1, 10 * r + 2};
        const int a = (r + 1) % 3, b = (r + 2) % 3;
        const particle_halo<thread_communicator> halo(communicator, ids,
                                                      {{10 * a + 2, a}, {10 * b, b}, {10 * a, a}, {10 * b + 1, b}});
        std::vector<std::int64_t> field = ids;
        field.resize(7);
        halo.gather(field);
        if (field != halo.ids()) throw std::runtime_error("wrong ghosts");
        if (halo.ghost_count() != 4 || field[3] != 10 * a + 2) throw std::runtime_error("wrong order");
    });
}
