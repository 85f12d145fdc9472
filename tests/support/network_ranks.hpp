// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>

#include "support/random.hpp"

namespace hearth_test {

/// Particles that exchange heat, and the share of them that a rank has: its own in an order of its own, then ghosts.
struct shared_network {
    std::vector<hearth::thermal_pair> pairs;
    std::vector<hearth::heat_bath<double>> baths;
    std::vector<double> mass, temperature, factor;
    double low = 1e300, high = 0;

    /// Ids of particles are 7 i + 3.
    static std::int64_t id(std::size_t i) { return 7 * static_cast<std::int64_t>(i) + 3; }

    explicit shared_network(std::uint64_t seed, bool closed = false) {
        seeded random(seed);
        // Parts that lie on all ranks, lone particles among them.
        const auto count = static_cast<std::size_t>(random.log_uniform(40, 400));
        const auto link = [&] {
            return hearth::thermal_link<double>{random.uniform(0, 1) < 0.6 ? random.log_uniform(1e-3, 1) : 0.0,
                                                random.log_uniform(1e-12, 1e-10)};
        };
        for (std::size_t i = 1; i < count; ++i) {
            for (int k = 0; k < 5; ++k) {
                const std::size_t j = i - 1 - random.index(std::min<std::size_t>(i, 12));
                if (i % 40 < 3 || i / 40 != j / 40) continue;
                pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), link()});
            }
        }
        baths.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            mass.push_back(random.log_uniform(1e-3, 1e-1));
            temperature.push_back(random.uniform(280, 2500));
            factor.push_back(random.uniform(0, 1) < 0.2 ? 1.0 : 678.0);
            low = std::min(low, temperature[i]);
            high = std::max(high, temperature[i]);
            if (closed || random.uniform(0, 1) < 0.7) continue;
            const double t = random.uniform(280, 2500);
            baths[i].add(link(), t);
            low = std::min(low, t);
            high = std::max(high, t);
        }
    }
};

struct network_share {
    std::vector<std::size_t> owned;  ///< places in the whole
    std::vector<std::int64_t> ids;
    std::vector<hearth::ghost_particle> ghosts;
    std::vector<hearth::thermal_pair> pairs;
    std::vector<hearth::heat_bath<double>> baths;
    std::vector<double> mass, temperature, factor;

    network_share(const shared_network& whole, const std::vector<int>& owners, int rank, std::uint64_t seed) {
        seeded random(seed);
        for (std::size_t i = 0; i < owners.size(); ++i)
            if (owners[i] == rank) owned.push_back(i);
        for (std::size_t i = owned.size(); i > 1; --i) std::swap(owned[i - 1], owned[random.index(i)]);
        std::vector<std::int32_t> place(owners.size(), -1);
        for (const std::size_t i : owned) {
            place[i] = static_cast<std::int32_t>(ids.size());
            ids.push_back(shared_network::id(i));
            baths.push_back(whole.baths[i]);
            mass.push_back(whole.mass[i]);
            temperature.push_back(whole.temperature[i]);
            factor.push_back(whole.factor[i]);
        }
        for (const auto& pair : whole.pairs) {
            auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
            if (owners[a] != rank) std::swap(a, b);
            if (owners[a] != rank) continue;
            if (place[b] < 0) {
                place[b] = static_cast<std::int32_t>(ids.size() + ghosts.size());
                ghosts.push_back({shared_network::id(b), owners[b]});
            }
            pairs.push_back({place[a], place[b], pair.link});
        }
    }
};

/// Steps of a network over ranks against the same on one; returns what was wrong on this rank, or nothing.
template <class Communicator>
std::string compare_networks(const Communicator& communicator, std::uint64_t seed) {
    using namespace hearth;
    const constant_specific_heat<> plain{1000};
    const polynomial_specific_heat<2> bent{{950.0, 0.28}, -1.3e7};
    std::string wrong;
    const auto compare = [&](const auto& caloric, bool closed) {
        const auto caloric_of = [&](std::size_t) -> const auto& { return caloric; };
        const shared_network whole(seed, closed);
        const double step = seeded(seed + 100).log_uniform(1e-4, 1e4);
        std::vector<double> expected = whole.temperature;
        std::vector<particle_step<double>> taken;
        thermal_network().advance(whole.pairs, whole.baths, whole.mass, caloric_of,
                                  tssm_per_particle(678.0, whole.factor), step, expected, taken);

        seeded random(seed + 200);
        std::vector<int> owners;
        const auto ranks = static_cast<std::size_t>(communicator.size());
        // Runs of random length: some ranks may have none.
        for (int owner = 0; owners.size() < expected.size();) {
            owner = static_cast<int>(random.index(ranks));
            for (std::size_t k = 1 + random.index(15); k > 0; --k) owners.push_back(owner);
        }
        owners.resize(expected.size());
        const network_share share(whole, owners, communicator.rank(), seed + 300);
        const particle_halo<Communicator> halo(communicator, share.ids, share.ghosts);
        std::vector<double> t = share.temperature;
        thermal_network solver;
        const auto report = solver.advance(share.pairs, share.baths, share.mass, caloric_of,
                                           tssm_per_particle(678.0, share.factor), step, t, taken, halo);
        if (!report.converged) wrong += "not converged; ";
        // The first pass is solved roughly, on each number of ranks otherwise; the second keeps a tenth of a hundredth.
        const double range = whole.high - whole.low;
        double balance = 0, turnover = 0;
        for (std::size_t k = 0; k < t.size(); ++k) {
            const double difference = std::fabs(t[k] - expected[share.owned[k]]);
            if (!(difference <= 1e-3 * range)) wrong += "off by " + std::to_string(difference) + " K; ";
            if (!(t[k] >= whole.low - 1e-9 * range && t[k] <= whole.high + 1e-9 * range)) wrong += "out of bounds; ";
            const double heat = taken[k].heat / share.factor[k];
            balance += heat - (taken[k].conducted + taken[k].radiated) / share.factor[k];
            // Temperatures are doubles: see tests/time/thermal_network.cpp.
            turnover += std::fabs(heat) + 1e-2 * share.mass[k] * caloric.enthalpy(share.temperature[k]);
        }
        balance = detail::sum_over_ranks(communicator, balance);
        turnover = detail::sum_over_ranks(communicator, turnover);
        if (!(std::fabs(balance) <= 1e-12 * turnover)) wrong += "lost " + std::to_string(balance / turnover) + "; ";

        // Solved to the end, it is the same.
        thermal_network::params settings;
        settings.passes = 1;
        settings.tolerance = 1e-13;
        expected = whole.temperature;
        t = share.temperature;
        thermal_network one(settings), many(settings);
        one.advance(whole.pairs, whole.baths, whole.mass, caloric_of, tssm_per_particle(678.0, whole.factor), step,
                    expected, taken);
        many.advance(share.pairs, share.baths, share.mass, caloric_of, tssm_per_particle(678.0, share.factor), step, t,
                     taken, halo);
        for (std::size_t k = 0; k < t.size(); ++k)
            if (!(std::fabs(t[k] - expected[share.owned[k]]) <= 1e-9 * range))
                wrong += "one pass is off by " + std::to_string(t[k] - expected[share.owned[k]]) + " K; ";
    };
    compare(plain, seed % 2 == 0);
    compare(bent, seed % 2 == 1);
    return wrong;
}

}  // namespace hearth_test
