// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <hearth/dem/wall.hpp>

#include "cell_grid.hpp"
#include "history.hpp"
#include "store.hpp"

namespace hearth::dem::detail {

/// Where a wall is: its points b in the body are turned . b + shift in space.
struct pose {
    std::array<vector3, 3> rows{vector3{1, 0, 0}, vector3{0, 1, 0}, vector3{0, 0, 1}};
    vector3 shift{};
    bool moved = false;

    vector3 to_space(const vector3& b) const { return vector3{dot(rows[0], b), dot(rows[1], b), dot(rows[2], b)} + shift; }
    vector3 to_body(const vector3& x) const {
        const vector3 d = x - shift;
        return d.x * rows[0] + d.y * rows[1] + d.z * rows[2];
    }
};

/// One wall, and the particles that may touch its facets before the lists are rebuilt.
struct wall_list {
    struct candidate {
        index particle, facet;
    };

    struct touch {
        std::size_t candidate;
        vector3 foot;
        double squared_distance;
    };

    wall body;
    contact_law law;
    pose place;
    bool open = false;
    std::int64_t first_id;  ///< facet k has the id first_id - k in histories
    std::vector<candidate> candidates;
    std::vector<vector3> springs;
    std::vector<vector3> rolls;
    std::vector<touch> touches;  ///< of the last step
    vector3 reaction{};  ///< force of the particles on the wall in the last step [N]

    /// Closest point of a facet to a point in space.
    vector3 closest(index facet_number, const vector3& x) const {
        const facet& f = body.facets[static_cast<std::size_t>(facet_number)];
        return place.moved ? place.to_space(closest_point(f, place.to_body(x))) : closest_point(f, x);
    }
    /// Velocity of the wall's surface at a point in space [m/s].
    vector3 velocity_at(const vector3& x) const {
        return body.motion.velocity + cross(body.motion.spin, x - body.motion.pivot);
    }
    bool moves() const { return dot(body.motion.velocity, body.motion.velocity) + dot(body.motion.spin, body.motion.spin) > 0; }
    /// Carries the wall along with its motion.
    void advance(double step);
    /// Fastest a point of the wall within the box moves [m/s].
    double speed_in(const box3& box) const;

    /// Fills the list with owned particles whose gap to a facet is below `reach`.
    void build(const store& particles, const cell_grid& grid, const std::vector<index>& start, double largest_radius,
               double reach, const history& past, const std::vector<index>& old_place, bool rolling);

    /// Appends the contacts as they are, in the order of the candidates.
    void find_touches(const sphere* spheres, std::vector<touch>& touches) const;

  private:
    void drop_shared(const sphere& s, std::vector<touch>& touches, std::size_t first) const;
};

}  // namespace hearth::dem::detail
