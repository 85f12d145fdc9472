// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/core/thermal_link.hpp>

namespace hearth {

/// A particle and a wall, by the host's patch number.
template <class Link>
struct linked_wall {
    std::int32_t particle;
    std::int32_t patch;
    Link link;
};

/// A particle and surroundings of a given temperature.
struct linked_surroundings {
    std::int32_t particle;
    double temperature;  ///< [K]
    radiative_link<double> link;
};

/// Rows of a radiation term: how much of its view each particle has in the list, walls included and after scaling.
struct view_report {
    double scale = 1.0;                         ///< applied to pairs; the mean one for closed rows [-]
    double row_mean = 0.0;                      ///< over particles that are not open to the surroundings [-]
    double row_least = 0.0, row_largest = 0.0;  ///< of these [-]
    std::int64_t open = 0;                      ///< particles that see the surroundings
    double open_view = 0.0;                     ///< sum of their open shares [-]
};

/// Where the links of one term end in a list; those of the term before end where they begin.
struct link_part {
    std::size_t term;  ///< its place in the scene
    std::size_t pairs, walls, surroundings;
};

/// All exchange of heat that does not pass through the gas, as numbers: made once per packing from what the terms of a
/// scene state, read by explicit rates, implicit steps and step limits alike.
template <class Link>
struct link_list {
    std::vector<linked_pair<Link>> pairs;
    std::vector<linked_wall<Link>> walls;
    std::vector<linked_surroundings> surroundings;
    std::vector<link_part> parts;    ///< term by term
    std::vector<view_report> views;  ///< one per radiation term, in their order

    /// To be called when all links of a term are in.
    void close_part(std::size_t term) { parts.push_back({term, pairs.size(), walls.size(), surroundings.size()}); }

    void clear() {
        pairs.clear();
        walls.clear();
        surroundings.clear();
        parts.clear();
        views.clear();
    }
};

/// What one term exchanged in one evaluation of a list [W].
struct link_ledger {
    std::size_t term = 0;            ///< its place in the scene
    double between = 0.0;            ///< sum over pairs of the magnitude exchanged; what one side lost the other got
    double from_walls = 0.0;         ///< to particles
    double from_surroundings = 0.0;  ///< to particles
};

/// Adds the heat rates of a list to heat[i] [W], by plain rates without Gamma.  wall_temperature(patch) [K].
/// Where pairs reach to ghosts, temperature and heat hold these behind the owned particles; their heat is to be thrown
/// away, because their owner lists the pair too.
/// Returns a ledger for each term of the list.
template <class Link, class Temperature, class WallTemperature>
std::vector<link_ledger> accumulate(const link_list<Link>& links, const Temperature& temperature,
                                    const WallTemperature& wall_temperature, std::vector<double>& heat) {
    std::vector<link_ledger> books;
    link_part from{};
    for (const link_part& to : links.parts) {
        link_ledger ledger;
        ledger.term = to.term;
        for (std::size_t k = from.pairs; k < to.pairs; ++k) {
            const auto& pair = links.pairs[k];
            const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
            const double q = pair.link.heat(temperature[a], temperature[b]);
            heat[a] += q;
            heat[b] -= q;
            ledger.between += q < 0.0 ? -q : q;
        }
        for (std::size_t k = from.walls; k < to.walls; ++k) {
            const auto& wall = links.walls[k];
            const auto i = static_cast<std::size_t>(wall.particle);
            const double q = wall.link.heat(temperature[i], wall_temperature(wall.patch));
            heat[i] += q;
            ledger.from_walls += q;
        }
        for (std::size_t k = from.surroundings; k < to.surroundings; ++k) {
            const auto& open = links.surroundings[k];
            const auto i = static_cast<std::size_t>(open.particle);
            const double q = open.link.heat(temperature[i], open.temperature);
            heat[i] += q;
            ledger.from_surroundings += q;
        }
        books.push_back(ledger);
        from = to;
    }
    return books;
}

}  // namespace hearth
