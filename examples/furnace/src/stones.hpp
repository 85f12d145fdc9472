// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/dem/moving_bed.hpp>
#include <hearth/furnace/spinel.hpp>

#include "shares.hpp"
#include "wall_rings.hpp"

namespace hearth::furnace {

/// What belongs to the stones of a parcel beside its place, carried along when the bed moves.
struct stone_fields {
    std::vector<double> temperature;   ///< [K]
    std::vector<double> hottest;       ///< so far [K]
    std::vector<double> hot_seconds;   ///< above 2130 K, by the process's clock [s]
    std::vector<double> watched;       ///< 1 where the last two hold since the feed or since above the burners, else 0
    std::vector<double> conductance;   ///< to the gas, of all stones of the parcel, in the last coupling [W/K]
    std::vector<double> convected;     ///< what the parcel got from the gas in the last coupling [W]
    std::vector<double> radiated;      ///< from its neighbours by radiation [W]
    std::vector<double> conducted;     ///< from its neighbours by conduction [W]
    std::vector<double> from_wall;     ///< from the wall by radiation [W]

    template <class Part>
    void each(Part&& part) {
        part("temperature", temperature);
        part("hottest", hottest);
        part("hot_seconds", hot_seconds);
        part("watched", watched);
        part("conductance", conductance);
        part("convected", convected);
        part("radiated", radiated);
        part("conducted", conducted);
        part("from_wall", from_wall);
    }
    void start(std::size_t count, double feed_temperature) {
        temperature.assign(count, feed_temperature);
        hottest.assign(count, feed_temperature);
        for (auto* field : {&hot_seconds, &watched, &conductance, &convected, &radiated, &conducted, &from_wall}) field->assign(count, 0.0);
    }
    void carry(const dem::passage& passed, double feed_temperature) {
        passed.carry(temperature, feed_temperature);
        passed.carry(hottest, feed_temperature);
        passed.carry(hot_seconds, 0.0);
        passed.carry(watched, 1.0);
        for (auto* field : {&conductance, &convected, &radiated, &conducted, &from_wall}) passed.carry(*field, 0.0);
    }
};

/// The bed as parcels, all of it: what sees its neighbours.
struct parcels {
    const dem::moving_bed& bed;
    const stone_fields& fields;
    double top;  ///< of the mesh; those that are about to leave, or heaped above it, count with its last cells [m]
};

/// The parcels of this rank, known to the others by their indices: what fills the cells.
struct own_parcels {
    const dem::moving_bed& bed;
    const std::vector<std::int32_t>& mine;
    double top;  ///< as above [m]
};

/// The parcels of this rank as stones, one for each parcel: what the closures were fitted for.
struct stones {
    const dem::moving_bed& bed;
    const stone_fields& fields;
    const std::vector<std::int32_t>& mine;
    double coarse_graining;      ///< diameter of a parcel over that of its stones [-]
    double acceleration_factor;  ///< the velocities that hearth asks for are those of the accelerated motion
};

/// Who is near whom, by parcels; and the wall in rings, each with its own temperature.  A rank visits what concerns its own
/// parcels and rings, so where two ranks meet, both do.
struct bed_neighbours {
    const dem::moving_bed& bed;
    const wall_rings& rings;
    const shares& share;
};

}  // namespace hearth::furnace

template <>
struct hearth::particle_traits<hearth::furnace::parcels> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = furnace::parcels;
    static index particle_count(const cloud& c) { return c.bed.size(); }
    static std::array<double, 3> get(quantity::position, const cloud& c, index i) {
        const auto& x = c.bed.spheres()[static_cast<std::size_t>(i)].centre;
        return {x.x, x.y, std::clamp(x.z, 1e-6 * c.top, (1 - 1e-6) * c.top)};
    }
    static scalar get(quantity::radius, const cloud& c, index i) { return c.bed.spheres()[static_cast<std::size_t>(i)].radius; }
    static scalar get(quantity::temperature, const cloud& c, index i) { return c.fields.temperature[static_cast<std::size_t>(i)]; }
    static scalar get(quantity::conductivity, const cloud& c, index i) {
        return furnace::spinel::conductivity(c.fields.temperature[static_cast<std::size_t>(i)]);
    }
};

template <>
struct hearth::particle_traits<hearth::furnace::own_parcels> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = furnace::own_parcels;
    static const dem::sphere& at(const cloud& c, index i) {
        return c.bed.spheres()[static_cast<std::size_t>(c.mine[static_cast<std::size_t>(i)])];
    }
    static index particle_count(const cloud& c) { return static_cast<index>(c.mine.size()); }
    static std::int64_t global_index(const cloud& c, index i) { return c.mine[static_cast<std::size_t>(i)]; }
    static std::array<double, 3> get(quantity::position, const cloud& c, index i) {
        const auto& x = at(c, i).centre;
        return {x.x, x.y, std::clamp(x.z, 1e-6 * c.top, (1 - 1e-6) * c.top)};
    }
    static scalar get(quantity::radius, const cloud& c, index i) { return at(c, i).radius; }
};

template <>
struct hearth::particle_traits<hearth::furnace::stones> {
    using index = std::int32_t;
    using scalar = double;
    using cloud = furnace::stones;
    static index of(const cloud& c, index i) { return c.mine[static_cast<std::size_t>(i)]; }
    static index particle_count(const cloud& c) { return static_cast<index>(c.mine.size()); }
    static scalar get(quantity::radius, const cloud& c, index i) {
        return c.bed.spheres()[static_cast<std::size_t>(of(c, i))].radius / c.coarse_graining;
    }
    static std::array<double, 3> get(quantity::velocity, const cloud& c, index i) {
        const auto v = c.bed.velocity(of(c, i));
        return {v.x * c.acceleration_factor, v.y * c.acceleration_factor, v.z * c.acceleration_factor};
    }
    static scalar get(quantity::temperature, const cloud& c, index i) { return c.fields.temperature[static_cast<std::size_t>(of(c, i))]; }
    static scalar get(quantity::conductivity, const cloud& c, index i) {
        return furnace::spinel::conductivity(c.fields.temperature[static_cast<std::size_t>(of(c, i))]);
    }
};

template <>
struct hearth::contact_traits<hearth::furnace::bed_neighbours> {
    using host = furnace::bed_neighbours;

    static bool concerns(const host& h, std::int32_t i, std::int32_t j) {
        return (h.share.is_mine(i) || h.share.is_mine(j)) && h.share.is_anybodys(i) && h.share.is_anybodys(j);
    }
    template <class Visit>
    static void for_each_contact(const host& h, Visit&& visit) {
        contact_traits<dem::moving_bed>::for_each_contact(h.bed, [&](std::int32_t i, std::int32_t j, const contact& touch) {
            if (concerns(h, i, j)) visit(i, j, touch);
        });
    }
    template <class Visit>
    static void for_each_near(const host& h, double radius_factor, Visit&& visit) {
        h.bed.for_each_near(radius_factor, [&](std::int32_t i, std::int32_t j, double distance) {
            if (concerns(h, i, j)) visit(i, j, distance);
        });
    }
    template <class Visit>
    static void for_each_near_wall(const host& h, double radius_factor, Visit&& visit) {
        h.bed.for_each_near_wall(radius_factor, [&](std::int32_t i, int, double distance) {
            if (!h.share.is_anybodys(i)) return;
            const int ring = h.rings.ring(h.bed.spheres()[static_cast<std::size_t>(i)].centre.z);
            if (h.share.is_mine(i) || h.share.is_my_ring(static_cast<std::size_t>(ring))) visit(i, ring, distance);
        });
    }
    static double wall_temperature(const host& h, int ring) { return h.rings.temperature()[static_cast<std::size_t>(ring)]; }
};
