// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <hearth/dem/bed.hpp>

#include "archive.hpp"
#include "ghosts.hpp"
#include "pair_list.hpp"
#include "slabs.hpp"
#include "store.hpp"
#include "wall_list.hpp"

namespace hearth::dem {

struct bed::implementation {
    implementation(const bed_settings& settings, const decomposition& spread);

    bed_settings settings;
    std::shared_ptr<ranks> among;
    bool shared;  ///< by more than one rank
    double near_factor;
    detail::slabs slabs;
    detail::ghosts ghosts;
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
    std::int64_t everybody = 0;  ///< particles of all ranks then

    std::optional<motion_error> failure;  ///< found on this rank, not yet known to the others

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
    double near_reach(double factor) const { return factor * 2 * largest_radius; }

    double reach() const { return settings.skin * 2 * smallest_radius; }
    /// Springs, those of two particles in the row of the lower id; `to_go`: in both rows, for either may go elsewhere.
    detail::history remember(bool to_go) const;
    std::vector<index> everyone() const;
    /// Keeps these owned particles, brings those that now belong to this rank, and sorts them all into cells; their springs,
    /// the rows of `past`, stay with them.
    void rebuild(detail::history past, std::vector<index> kept);
    void build_lists(detail::history past, std::vector<index> kept);
    void add_ghosts(detail::sorted_cells& cells);
    void refresh_lists();
    void clear_loads();
    /// Springs move on by `step`; 0 finds the forces of a state that has not moved.
    void add_forces(double step);
    /// Remembers as a failure where a particle with this id or a later one is too deep in another or in a wall.
    void find_deep(std::int64_t first_id);
    /// Throws on every rank what any of them has found.
    void raise_failure();
    enum class kick { first, between, last };
    /// Returns the highest speed of this rank, infinite where one is too high.
    template <kick Which>
    double move();
    motion_error too_fast(double highest) const;
    void step_once(bool first);
    void move_walls();
    template <class Archive, class Implementation>
    static void each_part(Archive& archive, Implementation& self);
    void each_setting(const std::function<void(double)>& see) const;
    void check_settings(detail::reader& archive) const;
    motion_error too_deep(std::ptrdiff_t pair) const;
    motion_error too_deep(const detail::wall_list& list, std::ptrdiff_t candidate) const;
};

}  // namespace hearth::dem
