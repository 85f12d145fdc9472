// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/dem/feed.hpp>
#include <hearth/dem/passage.hpp>

/// Beds that are moved by a rule instead of by forces, for as long as asked, on the clock of the process.
namespace hearth::dem {

/// What the spheres of a bed are made of for one another, and the walls around them.
struct surroundings {
    contact_law law;
    std::vector<wall> walls;
    std::vector<contact_law> wall_laws;

    /// Those of a bed, without its open walls.  Throws bad_value for a wall that moves and is no belt.
    static surroundings of(const bed& b);
};

/// A bed that is fed on top and taken from below at a mass flow.  A particle is a mass and an id; it sits where a
/// sphere is.
///
/// Mass is exact: what has left and what is due make up mass flow times time, and what has come in, less what has left,
/// is what the bed holds more.  Contacts have the elastic force of the motion's (softened) law at the overlap.
///
/// A bed may be spread over ranks, as a DEM bed may: each owns the particles 0 <= i < size() of a slab, as many as the
/// others, and behind them stand ghosts, as far as the decomposition's near_factor asks, contacts at least.  Where
/// everybody is, every rank knows, and moves in the same way: the bed has the bits of one rank.  All ranks make the
/// same calls with the same values, and make the bed of the same; "together" are those that speak to other ranks.
class moving_bed {
  public:
    /// Everybody that belongs to a bed or to a rank's part of it.
    struct population {
        std::vector<sphere> spheres;
        std::vector<double> masses;     ///< [kg]
        std::vector<std::int64_t> ids;  ///< empty: 0, 1, ...
    };
    struct ledger {
        double due = 0;          ///< mass that should have left and has not [kg]; below 0: left early
        double in = 0, out = 0;  ///< since the start [kg]
        std::int64_t next_id = 0;
        std::uint64_t place = 0;  ///< in the motion that is repeated
    };

    virtual ~moving_bed() = default;
    /// Moves on by so many seconds of the process.  Throws bad_value with the bed as it was.  Together.
    passage advance(double seconds);
    /// Mean velocity, on the clock of the process, where a particle is now [m/s].
    virtual vector3 velocity(index i) const = 0;

    double mass_flow() const { return mass_flow_; }
    /// From now on [kg/s].  Throws bad_value.
    void set_mass_flow(double kg_per_s);

    /// Of this rank; the arrays go on with the ghosts.
    index size() const { return owned_; }
    index ghost_count() const { return static_cast<index>(ghost_owners_.size()); }
    /// Rank that owns the ghost with the index i >= size().
    int ghost_owner(index i) const { return ghost_owners_[static_cast<std::size_t>(i - owned_)]; }
    const std::vector<sphere>& spheres() const { return here().spheres; }
    const std::vector<double>& masses() const { return here().masses; }
    const std::vector<std::int64_t>& ids() const { return here().ids; }
    ranks& among() const { return *spread_.among; }
    bool is_shared() const { return spread_.among->size() > 1; }  ///< by more than one rank
    /// Of all ranks, in an order that is the same on each.
    const population& everybody() const { return all_; }
    const ledger& now() const { return ledger_; }
    double total_mass() const;  ///< of all ranks [kg]
    /// Grows with each move.
    std::uint64_t revision() const { return revision_; }

    const surroundings& around() const { return around_; }
    /// Of all walls of a patch.  Throws bad_value where there is none.
    void set_patch_temperature(int patch, double kelvin);
    double patch_temperature(int patch) const;

    /// From now on only pairs are found of which one centre at least lies between these heights, and perhaps some
    /// others: for a host that cuts a bed, of which each rank knows all, into slabs of its own [m].
    void look_between(double low, double high);
    /// Pairs of centres closer than factor * (R_i + R_j), each once; found anew after a move, or for a larger factor.
    /// j may be a ghost, and then the other rank visits the pair too; the factor is at most 1 or the decomposition's:
    /// throws bad_value.
    template <class Visit>
    void for_each_near(double factor, Visit&& visit) const {
        for (const bed::pair& p : pairs_within(factor)) {
            const sphere &a = at(p.i), &b = at(p.j);
            const double distance = norm(a.centre - b.centre);
            if (distance < factor * (a.radius + b.radius)) visit(p.i, p.j, distance);
        }
    }
    /// visit(i, j, elastic normal force [N], overlap [m], point [m])
    template <class Visit>
    void for_each_contact(Visit&& visit) const {
        for_each_near(1.0, [&](index i, index j, double distance) {
            const double ri = at(i).radius, rj = at(j).radius, overlap = ri + rj - distance;
            const double force = around_.law.normal_stiffness * std::sqrt(ri * rj / (ri + rj) * overlap) * overlap;
            const vector3 d = at(i).centre - at(j).centre;
            visit(i, j, force, overlap, at(i).centre - ((ri - overlap * rj / (ri + rj)) / distance) * d);
        });
    }
    std::vector<bed::touch> wall_touches() const;
    /// visit(i, wall number, distance of the centre to the wall [m]), distance below factor * 2 R_i.
    template <class Visit>
    void for_each_near_wall(double factor, Visit&& visit) const {
        for (std::size_t w = 0; w < around_.walls.size(); ++w) {
            for (index i = 0; i < size(); ++i) {
                const double distance = distance_to_wall(i, w);
                if (distance < factor * 2 * at(i).radius) visit(i, static_cast<int>(w), distance);
            }
        }
    }

    /// All that the next move depends on but what the bed was made of, with a checksum; in the byte order of this
    /// machine. The same on every rank, and good for any number of ranks.
    std::vector<char> state() const;
    /// Into a bed made of the same.  Throws state_error with the bed as it was.
    void restore(const std::vector<char>& state);

  protected:
    moving_bed(population all, surroundings around, double mass_flow, const decomposition& spread);
    moving_bed(const moving_bed&) = default;
    moving_bed& operator=(const moving_bed&) = default;

    /// Moves everybody and fills `done` for everybody; its origin is that of no move, and due is already raised.
    virtual void move(double seconds, passage& done) = 0;
    /// Tells what a bed was made of from what another one was.
    virtual std::uint64_t fingerprint() const = 0;

    population all_;
    ledger ledger_;
    double mass_flow_ = 0;

  private:
    const population& here() const { return is_shared() ? mine_ : all_; }
    const sphere& at(index i) const { return here().spheres[static_cast<std::size_t>(i)]; }
    void divide();
    passage part_of(const passage& whole);
    const std::vector<bed::pair>& pairs_within(double factor) const;
    std::vector<bed::pair> looked_at(double factor) const;
    double distance_to_wall(index i, std::size_t wall_number) const;

    surroundings around_;
    decomposition spread_;
    std::uint64_t revision_ = 1;
    index owned_ = 0;
    std::vector<int> ghost_owners_;
    population mine_;            ///< on several ranks: owned, then ghosts
    std::vector<int> owners_;    ///< on several ranks: of everybody
    std::vector<index> places_;  ///< on their owners
    struct near_state {
        std::vector<bed::pair> pairs;
        double factor = 0;
        std::uint64_t revision = 0;
    };
    mutable near_state near_;
    double look_low_ = -std::numeric_limits<double>::infinity(), look_high_ = -look_low_;
};

/// A bed that does not move.
class frozen_bed final : public moving_bed {
  public:
    frozen_bed(std::vector<sphere> spheres, std::vector<double> masses, surroundings around,
               const decomposition& spread = {})
        : moving_bed({std::move(spheres), std::move(masses), {}}, std::move(around), 0.0, spread) {}
    /// The spheres of a bed as they are, with their ids.  Together: those of all ranks, the lowest id first.
    explicit frozen_bed(const bed& b, const decomposition& spread = {});
    vector3 velocity(index) const override { return {}; }

  private:
    void move(double, passage&) override {}
    std::uint64_t fingerprint() const override { return 1; }
};

/// A bed that sinks as a body through a zone: what falls below its base comes back on top, as feed.  The packing ought
/// to be one that continues there; else top and bottom overlap where they meet.
class plug_bed final : public moving_bed {
  public:
    /// Centres lie in the zone.  Throws bad_value.
    plug_bed(std::vector<sphere> spheres, std::vector<double> masses, const zone& shaft, surroundings around,
             double mass_flow, const decomposition& spread = {});
    vector3 velocity(index) const override { return {0, 0, -mass_flow_ / mass_per_height_}; }

  private:
    void move(double seconds, passage& done) override;
    std::uint64_t fingerprint() const override;

    zone shaft_;
    double mass_per_height_ = 0;
};

}  // namespace hearth::dem

template <>
struct hearth::contact_traits<hearth::dem::moving_bed> {
    using contacts = dem::moving_bed;

    template <class Visit>
    static void for_each_contact(const contacts& c, Visit&& visit) {
        c.for_each_contact([&](std::int32_t i, std::int32_t j, double force, double overlap, const dem::vector3& x) {
            visit(i, j, contact{force, overlap, {x.x, x.y, x.z}});
        });
    }
    template <class Visit>
    static void for_each_wall_contact(const contacts& c, Visit&& visit) {
        for (const dem::bed::touch& t : c.wall_touches()) {
            const auto w = static_cast<std::size_t>(t.wall);
            const double radius = c.spheres()[static_cast<std::size_t>(t.i)].radius;
            const double force = c.around().wall_laws[w].normal_stiffness * std::sqrt(radius * t.overlap) * t.overlap;
            visit(t.i, c.around().walls[w].patch, contact{force, t.overlap, {t.foot.x, t.foot.y, t.foot.z}});
        }
    }
    template <class Visit>
    static void for_each_near(const contacts& c, double factor, Visit&& visit) {
        c.for_each_near(factor, visit);
    }
    template <class Visit>
    static void for_each_near_wall(const contacts& c, double factor, Visit&& visit) {
        c.for_each_near_wall(factor, [&](std::int32_t i, int w, double distance) {
            visit(i, c.around().walls[static_cast<std::size_t>(w)].patch, distance);
        });
    }
    static double wall_temperature(const contacts& c, int patch) { return c.patch_temperature(patch); }
};
template <>
struct hearth::contact_traits<hearth::dem::frozen_bed> : contact_traits<hearth::dem::moving_bed> {};
template <>
struct hearth::contact_traits<hearth::dem::plug_bed> : contact_traits<hearth::dem::moving_bed> {};
