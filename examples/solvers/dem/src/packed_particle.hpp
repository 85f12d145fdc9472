// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "archive.hpp"
#include "history.hpp"
#include "store.hpp"

namespace hearth::dem::detail {

/// A particle on its way to another rank or into a state, without gaps between the members; its springs follow it.
struct packed_particle {
    vector3 centre, built, velocity, spin, force, torque, outer_force;
    double radius, inverse_mass, inverse_inertia, temperature;
    lead ahead;
    std::int64_t id;
    std::uint32_t flight, springs;
};
static_assert(sizeof(packed_particle) == 30 * 8);

/// Puts one particle of the store and its row of the history behind what the archive holds.
inline void pack_one(const store& all, index particle, const history& past, writer& archive) {
    const auto i = static_cast<std::size_t>(particle);
    const sphere& s = all.spheres[i];
    const motion& m = all.motions[i];
    const load& l = all.loads[i];
    const auto springs = static_cast<std::uint32_t>(past.end(particle) - past.begin(particle));
    archive(packed_particle{s.centre, i < all.built.size() ? all.built[i] : s.centre, m.velocity, m.spin, l.force, l.torque,
                            all.pushed ? all.outer_forces[i] : vector3{}, s.radius, m.inverse_mass, m.inverse_inertia,
                            all.temperatures[i], all.leads[i], all.ids[i], all.flights[i], springs});
    for (std::size_t e = past.begin(particle); e < past.end(particle); ++e) {
        archive(past.at(e));
        if (past.rolling()) archive(past.roll_at(e));
    }
}

/// Puts particles, their number first.
inline void pack(const store& all, const std::vector<index>& particles, const history& past, writer& archive) {
    archive(static_cast<std::uint64_t>(particles.size()));
    for (const index i : particles) pack_one(all, i, past, archive);
}

/// Takes what pack() put: behind the owned ones of a store without ghosts, and rows behind the history's.
inline void unpack(reader& archive, store& all, history& past) {
    std::uint64_t count = 0;
    archive(count);
    std::size_t i = all.owned;
    all.owned += static_cast<std::size_t>(count);
    all.resize(all.owned);
    std::vector<history::entry> entries;
    std::vector<vector3> rolls;
    for (; i < all.owned; ++i) {
        packed_particle p;
        archive(p);
        all.spheres[i] = {p.centre, p.radius};
        all.motions[i] = {p.velocity, p.inverse_mass, p.spin, p.inverse_inertia};
        all.loads[i] = {p.force, 0, p.torque, 0};
        all.leads[i] = p.ahead;
        all.ids[i] = p.id;
        all.temperatures[i] = p.temperature;
        all.flights[i] = static_cast<std::uint8_t>(p.flight);
        if (all.pushed) all.outer_forces[i] = p.outer_force;
        if (all.built_goes_along) all.built[i] = p.built;
        entries.clear();
        rolls.clear();
        for (std::uint32_t k = 0; k < p.springs; ++k) {
            archive(entries.emplace_back());
            if (past.rolling()) archive(rolls.emplace_back());
        }
        past.append(entries, rolls);
    }
}

}  // namespace hearth::dem::detail
