// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <hearth/dem/bed.hpp>

#include "pair_list.hpp"
#include "store.hpp"
#include "wall_list.hpp"

namespace hearth::dem {

struct bed::implementation {
    bed_settings settings;
    contact_law law;
    bool rolling = false;
    mutable detail::store particles;  ///< mutable for near_places alone
    detail::pair_list pairs;
    std::vector<detail::wall_list> walls;

    std::int64_t next_id = 0;
    std::int64_t steps = 0;
    std::uint64_t revision = 0;
    std::int64_t rebuilds = 0;

    bool listed = false;         ///< the lists are those of the particles and walls that there are
    bool loaded = false;         ///< loads hold the forces of the present state
    double travelled = 0;        ///< no particle or wall has moved farther since the lists were built [m]
    double wall_travelled = 0;   ///< the same of walls alone
    double largest_radius = 0, smallest_radius = 0;
    box3 extent{};               ///< of the centres then
    std::vector<sphere> built;   ///< where the particles were then

    /// The near list and what it was made for; made when asked for, so it is no part of the state.
    struct near_state {
        near_list list;
        double reach = 0;                  ///< largest distance of centres that it surely holds [m]
        std::vector<vector3> centres;      ///< of the places when it was made
        std::uint64_t revision = 0;        ///< of `current`
        std::int64_t rebuilds = 0;
    };
    mutable near_state near;
    void build_near(double reach) const;

    double reach() const { return settings.skin * 2 * smallest_radius; }
    detail::history remember() const;
    void rebuild();
    /// Keeps the particles in `order` and sorts them into cells; their springs stay with them.
    void rebuild(const std::vector<index>& order);
    void refresh_lists();
    void clear_loads();
    /// Springs move on by `step`; 0 finds the forces of a state that has not moved.
    void add_forces(double step);
    /// Throws where a particle with this id or a later one is too deep in another or in a wall.
    void refuse_deep(std::int64_t first_id) const;
    [[noreturn]] void refuse_speed(double highest) const;
    enum class kick { first, between, last };
    template <kick Which>
    void move();
    void move_walls();
    template <class Archive, class Implementation>
    static void each_part(Archive& archive, Implementation& self);
    void each_setting(const std::function<void(double)>& see) const;
    [[noreturn]] void refuse_pair(std::ptrdiff_t pair) const;
    [[noreturn]] void refuse_touch(const detail::wall_list& list, std::ptrdiff_t candidate) const;
};

}  // namespace hearth::dem
