// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/particle_halo.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/time/advance.hpp>

namespace hearth::detail {

/// Throws bad_value for a pair that is none or whose link is no number.
template <class Link>
void check_pairs(const std::vector<linked_pair<Link>>& pairs, std::size_t owned, std::size_t ghosts) {
    const auto count = static_cast<std::int64_t>(owned), all = static_cast<std::int64_t>(owned + ghosts);
    const auto is_number = [](double x) { return x >= 0.0 && x <= std::numeric_limits<double>::max(); };
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const linked_pair<Link>& pair = pairs[k];
        const thermal_link<double> link = widened(pair.link);
        const bool first = pair.first >= 0 && pair.first < count;
        const bool second = pair.second >= 0 && pair.second < all && pair.second != pair.first;
        if (first && second && is_number(link.conductance) && is_number(link.radiation)) continue;
        const auto index = static_cast<std::int64_t>(k);
        if (!first) throw bad_value("first particle of pair", index, pair.first, "an index of an owned particle");
        if (!second)
            throw bad_value("second particle of pair", index, pair.second,
                            "an index of a particle or ghost other than the first, " + std::to_string(pair.first));
        require_not_negative("conductance of pair", index, link.conductance, "finite and >= 0 [W/K]");
        require_not_negative("radiation of pair", index, link.radiation, "finite and >= 0 [W/K^4]");
    }
}

/// What a rank says of a pair that reaches over to another: both ids, both coefficients.
struct pair_across {
    std::int64_t lower, upper;
    double conductance, radiation;
};

/// Throws bad_value on every rank where a pair of two ranks does not stand in both lists with the same link: heat would
/// appear or vanish between them.
template <class Link, class Communicator>
void check_across(const std::vector<linked_pair<Link>>& pairs, std::size_t owned,
                  const particle_halo<Communicator>& halo) {
    const auto& communicator = halo.communicator();
    std::vector<int> owner(halo.ghost_count());
    for (const link& from : halo.imports())
        for (std::size_t k = from.begin; k < from.end; ++k) owner[halo.order()[k]] = from.rank;
    std::vector<parcel<pair_across>> said(static_cast<std::size_t>(communicator.size()));
    for (int r = 0; r < communicator.size(); ++r) said[static_cast<std::size_t>(r)].rank = r;
    for (const auto& pair : pairs) {
        const auto second = static_cast<std::size_t>(pair.second);
        if (second < owned) continue;
        const std::int64_t a = halo.ids()[static_cast<std::size_t>(pair.first)], b = halo.ids()[second];
        const thermal_link<double> link = widened(pair.link);
        said[static_cast<std::size_t>(owner[second - owned])].values.push_back(
            {std::min(a, b), std::max(a, b), link.conductance, link.radiation});
    }
    // The same pair may stand more than once, with links of several terms.
    for (auto& list : said) {
        std::sort(list.values.begin(), list.values.end(), [](const pair_across& a, const pair_across& b) {
            return std::array{static_cast<double>(a.lower - b.lower), static_cast<double>(a.upper - b.upper),
                              a.conductance - b.conductance,
                              a.radiation - b.radiation} < std::array{0.0, 0.0, 0.0, 0.0};
        });
    }
    const auto heard = communicator.exchange(said);
    std::optional<bad_value> wrong;
    // One side may have rounded otherwise.
    const auto close = [](double a, double b) { return std::fabs(a - b) <= 1e-13 * std::fmax(a, b); };
    const auto same = [&](const pair_across& a, const pair_across& b) {
        return a.lower == b.lower && a.upper == b.upper && close(a.conductance, b.conductance) &&
               close(a.radiation, b.radiation);
    };
    std::size_t next = 0;
    for (const auto& mine : said) {
        const bool answered = next < heard.size() && heard[next].rank == mine.rank;
        const std::vector<pair_across> none, &theirs = answered ? heard[next++].values : none;
        const auto [here, there] =
            std::mismatch(mine.values.begin(), mine.values.end(), theirs.begin(), theirs.end(), same);
        if (!wrong && (here != mine.values.end() || there != theirs.end())) {
            const pair_across& pair = here != mine.values.end() ? *here : *there;
            wrong = bad_value("link over ranks of particle", pair.lower, static_cast<double>(pair.upper),
                              "a pair that both ranks list, with the same link");
        }
    }
    throw_agreed(communicator, wrong);
}

/// What an implicit step of a network asks of its input; nothing is changed before it has looked at all.
template <class Link, class Clock, class Mass, class CaloricOf, class Communicator>
void check_network(const std::vector<linked_pair<Link>>& pairs, const std::vector<heat_bath<double>>& baths,
                   const Mass& mass, const CaloricOf& caloric_of, const Clock& clock, double step,
                   const std::vector<double>& temperature, const particle_halo<Communicator>& halo) {
    if constexpr (Communicator::is_distributed) {
        std::optional<bad_value> wrong;
        try {
            if (temperature.size() + halo.ghost_count() != halo.ids().size())
                throw bad_value("number of temperatures", bad_value::no_index, static_cast<double>(temperature.size()),
                                "as many as the halo has owned particles");
            check_particles(baths, mass, caloric_of, clock, step, temperature);
            check_pairs(pairs, temperature.size(), halo.ghost_count());
        } catch (const bad_value& error) {
            wrong = error;
        }
        throw_agreed(halo.communicator(), wrong);
        check_across(pairs, temperature.size(), halo);
    } else {
        check_particles(baths, mass, caloric_of, clock, step, temperature);
        check_pairs(pairs, temperature.size(), halo.ghost_count());
    }
}

}  // namespace hearth::detail
