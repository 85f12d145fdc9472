// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "check.hpp"
#include "implementation.hpp"
#include "near_rows.hpp"

namespace hearth::dem {

/// All pairs of centres within `reach`, each in the row of the earlier place.
void bed::implementation::build_near(double reach) const {
    const std::size_t n = particles.total();
    detail::fine_cells cells(particles.spheres.data(), n, reach);
    near_list& list = near.list;
    list.start.assign(1, 0);
    list.second.clear();
    list.current = std::move(cells.order);
    near.centres.resize(n);
    for (std::size_t a = 0; a < n; ++a) {
        const auto i = static_cast<std::size_t>(list.current[a]);
        near.centres[a] = particles.spheres[i].centre;
        particles.near_places[i] = static_cast<index>(a);
    }
    detail::for_each_near_row(cells, near.centres, reach, [&](index, const index* places, std::size_t count) {
        list.second.insert(list.second.end(), places, places + count);
        list.start.push_back(static_cast<std::uint32_t>(list.second.size()));
    });
    near.reach = reach;
    near.revision = revision;
    ++near.rebuilds;
}

const bed::near_list& bed::near_pairs(double factor) const {
    detail::check(factor > 0 && std::isfinite(factor), "factor of near pairs", factor, "finite and > 0 [-]");
    const implementation& self = *self_;
    auto& near = self.near;
    const double wanted = self.near_reach(factor);
    if (self.shared) {
        detail::check(factor <= self.near_factor, "factor of near pairs", factor, "<= near_factor of the decomposition [-]");
        // Ghosts are others in each revision; within one no particle gets farther than half the reach from where it began.
        if (near.revision != self.revision || near.reach < wanted) self.build_near(wanted + 2 * self.reach());
        return near.list;
    }
    // Good as long as no two particles that were farther apart than the list's reach can have come within `wanted`.
    const double spare = 0.5 * (near.reach - wanted);
    bool good = near.reach >= wanted && near.list.start.size() > 1;
    for (index i = 0; i < size() && good; ++i) {
        const index place = self.particles.near_places[static_cast<std::size_t>(i)];
        if (place < 0) {
            good = false;
        } else {
            const vector3 d = spheres()[i].centre - near.centres[static_cast<std::size_t>(place)];
            good = dot(d, d) <= spare * spare;
        }
    }
    if (!good) {
        self.build_near(wanted * (1 + self.settings.skin));
    } else if (near.revision != self.revision) {
        near.list.current.assign(near.list.current.size(), -1);
        for (index i = 0; i < size(); ++i) {
            near.list.current[static_cast<std::size_t>(self.particles.near_places[static_cast<std::size_t>(i)])] = i;
        }
        near.revision = self.revision;
    }
    return near.list;
}

std::int64_t bed::near_rebuilds() const { return self_->near.rebuilds; }

double bed::distance_to_wall(index i, int wall_number, double reach) const {
    const auto& w = self_->walls.at(static_cast<std::size_t>(wall_number));
    const vector3 x = spheres()[i].centre;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < w.body.facets.size() && !w.open; ++f) {
        least = std::fmin(least, norm(x - w.closest(static_cast<index>(f), x)));
    }
    return least <= reach ? least : std::numeric_limits<double>::infinity();
}

int bed::update_flight() {
    constexpr std::uint8_t flies = detail::store::in_flight;
    constexpr int patience = 10;
    std::vector<int> contacts = contact_counts();
    for (const touch& t : wall_touches()) ++contacts[static_cast<std::size_t>(t.i)];  // a floor carries alone
    int changed = 0;
    for (std::size_t i = 0; i < self_->particles.owned; ++i) {
        std::uint8_t& flight = self_->particles.flights[i];
        const bool wants = flight & flies ? contacts[i] >= 2 : contacts[i] == 0;
        if (!wants) {
            flight &= flies;
        } else if ((flight & ~flies) + 1 < patience) {
            ++flight;
        } else {
            flight = static_cast<std::uint8_t>(flight & flies ? 0 : flies);
            ++changed;
        }
    }
    return changed;
}

bool bed::in_flight(index i) const {
    return (self_->particles.flights[static_cast<std::size_t>(i)] & detail::store::in_flight) != 0;
}

std::vector<int> bed::contact_counts() const {
    std::vector<int> counts(static_cast<std::size_t>(size()), 0);
    for_each_contact([&](index i, index j, double, double, const vector3&) {
        ++counts[static_cast<std::size_t>(i)];
        if (j < size()) ++counts[static_cast<std::size_t>(j)];
    });
    for (const touch& t : wall_touches()) ++counts[static_cast<std::size_t>(t.i)];
    return counts;
}

}  // namespace hearth::dem
