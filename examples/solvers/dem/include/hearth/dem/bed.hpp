// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <hearth/dem/contact_law.hpp>
#include <hearth/dem/particles.hpp>
#include <hearth/dem/ranks.hpp>
#include <hearth/dem/wall.hpp>

namespace hearth::dem {

/// A particle that is deeper in another, or in a wall, than the settings allow; or one that went too fast for its step.
/// Names the particle (and its partner) by id.
struct motion_error : std::runtime_error {
    motion_error(const std::string& what, std::int64_t id_) : std::runtime_error(what), id(id_) {}
    std::int64_t id;
};

/// A state that cannot be restored: damaged, cut off, or made with other settings.
struct state_error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct bed_settings {
    double step = 2e-5;                  ///< [s]; see bed::advised_step()
    vector3 gravity{0, 0, -9.81};        ///< [m/s^2]
    material body{};                     ///< of all particles
    contact_settings contact{};          ///< between particles
    double skin = 0.1;                   ///< of the contact list, over the smallest diameter [-], > 0
    double deepest_overlap = 0.3;        ///< over the smaller radius [-]; more is refused as an error, never exploded
};

/// Spheres that move under gravity, contacts and forces from outside, in a space with walls.
///
/// Particles are kept in the order of their place, so their indices change whenever the lists are rebuilt (`revision()`
/// tells); their ids do not.  Velocity Verlet; between calls positions and velocities belong to the same time.
///
/// A bed may be spread over ranks.  Then each owns particles 0 <= i < size(), which ones changes with the revision, and
/// behind them stand ghosts: copies of others' particles that it may touch.  Walls and their changes are the same on all
/// ranks.  Calls marked "together" are made by all ranks at the same place, and throw on all or none.
class bed {
  public:
    explicit bed(const bed_settings& settings, const decomposition& spread = {});
    ~bed();
    bed(bed&&) noexcept;
    bed& operator=(bed&&) noexcept;

    /// Adds a wall and returns its number.  Throws bad_value.
    int add_wall(wall w);
    /// Changes how a wall moves from now on.
    void set_motion(int wall_number, const wall_motion& motion);
    /// An open wall touches nobody.
    void set_wall_open(int wall_number, bool open);
    bool wall_open(int wall_number) const;
    /// Temperature of all walls of a patch.
    void set_patch_temperature(int patch, double kelvin);
    double patch_temperature(int patch) const;
    const wall& wall_at(int wall_number) const;
    int wall_count() const;
    /// Force of the particles on a wall [N] in the last step.  Together.
    vector3 force_on_wall(int wall_number) const;

    /// Adds particles and returns the id of the first; the others follow.  Refuses, with the bed as it was, values that
    /// are not finite, and particles deeper in others or in walls than `deepest_overlap`.  Throws bad_value, motion_error.
    /// Together, with the same particles: each goes to the rank that owns its place.
    std::int64_t insert(const std::vector<particle>& particles);
    /// Removes the particles of these indices.  Together, each rank its own.
    void remove(const std::vector<index>& indices);

    /// Moves on by `steps` steps.  Throws motion_error; the bed then holds the step that failed: restore a state before it.
    /// Together.
    void advance(int steps);
    double time() const;
    std::int64_t steps() const;
    const bed_settings& settings() const;
    void set_gravity(const vector3& gravity);

    /// The ranks that share the bed.
    ranks& among() const;
    bool is_shared() const;  ///< by more than one rank
    std::int64_t size_over_ranks() const;
    double largest_radius() const;  ///< of the particles of all ranks [m]; 0 without any

    /// Particles that this rank owns, by index; arrays go on with the ghosts.
    index size() const;
    index ghost_count() const;
    /// Rank that owns the ghost with the index i >= size().
    int ghost_owner(index i) const;
    /// Positions, motions, masses and temperatures of all ghosts become those of their owners.  To be called after advance()
    /// and after temperatures have changed, before neighbours or temperatures of ghosts are read, and after set_mass() before
    /// the next advance().  Together.
    void update_ghosts();
    const sphere* spheres() const;
    const motion* motions() const;
    const load* loads() const;
    const std::int64_t* ids() const;
    double mass(index i) const;
    /// State that goes with the particles wherever they are sorted to.
    double* temperatures();
    const double* temperatures() const;

    void set_velocity(index i, const vector3& velocity, const vector3& spin);
    /// Of a particle that dries or takes something up; its radius stays, and its velocity.  Throws bad_value.
    void set_mass(index i, double kg);
    /// A driven particle keeps its velocity whatever pushes it.
    void set_driven(index i, bool driven);
    /// Force from outside, e.g. of the gas [N]; kept until it is set again.
    void set_outer_force(index i, const vector3& force);

    /// Grows whenever indices change.
    std::uint64_t revision() const;
    /// How often the lists were rebuilt.
    std::int64_t rebuilds() const;
    /// Rebuilds the lists at the next step whatever has moved.
    void expire_lists();

    /// All that the next step depends on, with a checksum: a run that is saved and restored equals one that went on, bit for
    /// bit.  In the byte order of this machine.  On several ranks a part: of the particles that this rank owns.  Together.
    std::vector<char> state() const;
    /// Into a bed of the same settings and walls; particles that it has are replaced.  Throws state_error, with the bed as
    /// it was, for a state that is damaged or was made otherwise.  Together.
    void restore(const std::vector<char>& state);
    /// From all parts of a state, on any number of ranks: each rank gives some of them or none, in any order, and all
    /// together give each part once.
    void restore_parts(const std::vector<std::vector<char>>& parts);

    /// Bytes that the bed holds, without the near list.
    std::size_t memory() const;

    /// Contacts as of the last step.  visit(i, j, elastic normal force [N], overlap [m], point [m]): every touching pair once;
    /// j may be a ghost, and then the other rank visits the pair too.  On several ranks update_ghosts() first.
    template <class Visit>
    void for_each_contact(Visit&& visit) const;
    /// visit(i, wall number, elastic normal force [N], overlap [m], point [m])
    template <class Visit>
    void for_each_wall_contact(Visit&& visit) const;

    /// Number of contacts of every owned particle, walls included.
    std::vector<int> contact_counts() const;

    struct pair {
        index i, j;
    };
    struct touch {
        index i;
        int wall;
        double overlap;
        vector3 foot;
    };
    /// Pairs that may touch, and contacts with walls as they are now.
    const std::vector<pair>& candidate_pairs() const;
    std::vector<touch> wall_touches() const;
    const contact_law& law() const;
    const contact_law& wall_law(int wall_number) const;

    /// visit(i, j, distance of centres [m]): every pair with a distance below factor * (R_i + R_j), once; j may be a ghost, as
    /// with contacts.  The list behind it has a skin of its own and is made only when it is asked for.  On several ranks the
    /// factor is at most that of the decomposition: throws bad_value otherwise.
    template <class Visit>
    void for_each_near(double factor, Visit&& visit) const;
    /// visit(i, wall number, distance of the centre to the wall [m]), distance below factor * 2 R_i.
    template <class Visit>
    void for_each_near_wall(double factor, Visit&& visit) const;

    /// Neighbours of places; a place is the particle current[place], or -1 where that has left.
    struct near_list {
        std::vector<std::uint32_t> start;
        std::vector<index> second, current;
    };
    const near_list& near_pairs(double factor) const;
    std::int64_t near_rebuilds() const;
    /// From the centre of a particle to a wall; no farther than `reach`, else infinite [m].
    double distance_to_wall(index i, int wall_number, double reach) const;

    /// Which particles are in flight, with hysteresis: one settles after ten updates in a row on two others or a wall,
    /// and takes off after ten without any contact.  Fed particles are in flight.  Returns how many changed.
    int update_flight();
    bool in_flight(index i) const;

    /// Step that resolves the shortest contact of an impact at `speed` by `steps_per_contact` steps [s].
    double advised_step(double speed, double steps_per_contact = 20) const;

  private:
    struct implementation;
    /// Contacts of some pairs, side by side.
    struct contact_block {
        static constexpr std::size_t pairs = 256;
        std::size_t count;
        index i[pairs], j[pairs];  ///< the first is owned
        double force[pairs], overlap[pairs], x[pairs], y[pairs], z[pairs];
    };
    /// Those among so many candidate pairs from the given one on.
    void find_contacts(std::size_t first_pair, contact_block& found) const;
    /// The near list as it is now, and what it says of one place.
    struct near_row {
        const near_list* list;
        std::vector<sphere> placed;  ///< in the order of places, nowhere where a particle has left
        std::vector<index> others;
        std::vector<double> distances;
        std::size_t count;
    };
    near_row near_rows(double factor) const;
    static void find_near(std::size_t place, double factor, near_row& row);

    std::unique_ptr<implementation> self_;
};

template <class Visit>
void bed::for_each_contact(Visit&& visit) const {
    contact_block found;
    const std::size_t end = candidate_pairs().size();
    for (std::size_t first = 0; first < end; first += contact_block::pairs) {
        find_contacts(first, found);
        for (std::size_t k = 0; k < found.count; ++k)
            visit(found.i[k], found.j[k], found.force[k], found.overlap[k], vector3{found.x[k], found.y[k], found.z[k]});
    }
}

template <class Visit>
void bed::for_each_near(double factor, Visit&& visit) const {
    near_row row = near_rows(factor);
    const std::vector<index>& current = row.list->current;
    const index owned = size();
    for (std::size_t place = 0; place < current.size(); ++place) {
        const index i = current[place];
        if (i < 0) continue;
        find_near(place, factor, row);
        for (std::size_t k = 0; k < row.count; ++k) {
            const index j = current[static_cast<std::size_t>(row.others[k])];
            if (i < owned) visit(i, j, row.distances[k]);
            else if (j < owned) visit(j, i, row.distances[k]);
        }
    }
}

template <class Visit>
void bed::for_each_near_wall(double factor, Visit&& visit) const {
    for (int w = 0; w < wall_count(); ++w) {
        for (index i = 0; i < size(); ++i) {
            const double reach = factor * 2 * spheres()[i].radius, distance = distance_to_wall(i, w, reach);
            if (distance < reach) visit(i, w, distance);
        }
    }
}

template <class Visit>
void bed::for_each_wall_contact(Visit&& visit) const {
    for (const touch& t : wall_touches()) {
        const double force = wall_law(t.wall).normal_stiffness * std::sqrt(spheres()[t.i].radius * t.overlap) * t.overlap;
        visit(t.i, t.wall, force, t.overlap, t.foot);
    }
}

}  // namespace hearth::dem
