// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <hearth/dem/bed.hpp>
#include <hearth/dem/random.hpp>

/// What goes into a bed and what comes out of it.  Heights are along z.  On several ranks all make these calls together,
/// draw the same random numbers and hold the same states and totals, to the bit those of one rank.
namespace hearth::dem {

/// Sieve analysis: the share of the mass that is finer than a diameter, linear in between.
class size_distribution {
  public:
    struct point {
        double diameter;    ///< [m]
        double mass_below;  ///< [-]
    };
    /// From 0 to 1, both columns rising.  One point with mass_below 1 is a single size.  Throws bad_value.
    explicit size_distribution(std::vector<point> table);

    /// A diameter, with the frequency by number that the masses ask for.
    double draw(random_source& random) const;
    double smallest() const { return table_.front().diameter; }
    double largest() const { return table_.back().diameter; }

  private:
    double diameter_of(double mass_below) const;
    std::vector<point> table_;
};

/// An upright cylinder.
struct zone {
    vector3 base;   ///< middle of its bottom [m]
    double radius;  ///< [m]
    double height;  ///< [m]
};

/// Brings particles into a zone at a mass flow.  What a call could not bring, because less than one particle was due or the
/// zone was full, is carried to the next: the mass is exact over time.
class feed {
  public:
    struct settings {
        zone where;                  ///< particles are wholly inside of it
        double mass_flow = 0;        ///< [kg/s]
        double density = 0;          ///< of the particles [kg/m^3]
        double temperature = 300;    ///< [K]
        vector3 velocity{};          ///< [m/s]
        std::uint64_t seed = 1;
        int attempts = 60;           ///< places tried for a particle before it waits
    };
    /// What goes on from a restart.
    struct state {
        random_source random;
        double due = 0;            ///< mass not yet brought [kg]
        double next_diameter = 0;  ///< of the particle that waits [m]
        double brought = 0;        ///< so far [kg]
        std::int64_t particles = 0;
    };
    struct report {
        int inserted;
        bool full;  ///< the zone had no room for what was due
    };

    feed(const settings& s, size_distribution sizes);
    /// Brings what `seconds` more make due.  Throws motion_error where a wall reaches into the zone; nothing is brought then.
    report update(bed& b, double seconds);
    /// Brings as many as find room now, whatever is due; they count as brought.
    report fill(bed& b);
    const state& now() const { return state_; }
    void restore(const state& s) { state_ = s; }
    void set_mass_flow(double kg_per_s);

  private:
    report insert(bed& b, bool all_due);
    double next_mass() const;

    settings settings_;
    size_distribution sizes_;
    state state_;
};

/// Height of the surface in a zone [m]: the mean, over columns of two large diameters, of the top of the highest particle
/// that rests on two others.  Columns without any count with the zone's base.
double surface_level(const bed& b, const zone& where);

/// Fills a zone up to a level above its base: feeds at the top of it, lets fall, and repeats.  Returns the steps taken; they
/// end early, below the level, after `most_steps`.
std::int64_t fill_to_level(bed& b, feed& source, const zone& where, double level, std::int64_t most_steps);

/// Takes particles out at the bottom at a mass flow, the remainder carried as by a feed.
class outflow {
  public:
    enum class rule {
        driven,  ///< the lowest layer moves down at the speed that the flow asks, and leaves
        paper    ///< particles that touch the floor vanish, picked at random (Spijker et al. 2023)
    };
    struct settings {
        int floor = 0;              ///< number of the wall at the bottom; `driven` opens it
        double height = 0;          ///< of the floor [m]
        double mass_flow = 0;       ///< [kg/s]
        rule how = rule::driven;
        double layer = 1.0;         ///< thickness of the driven layer, over the largest diameter [-]
        std::uint64_t seed = 1;     ///< of the paper's rule
    };
    struct state {
        random_source random;
        double due = 0;        ///< mass not yet taken [kg]
        double taken = 0;      ///< so far [kg]
        double mass_temperature = 0;  ///< sum of mass times temperature of what was taken [kg K]
        std::int64_t particles = 0;
    };

    explicit outflow(const settings& s);
    /// Takes what `seconds` more make due and sets the driven layer going.  Call it often: each few hundred steps.
    int update(bed& b, double seconds);
    const state& now() const { return state_; }
    void restore(const state& s) { state_ = s; }
    void set_mass_flow(double kg_per_s);

  private:
    bool let_go(double mass, double temperature);
    int take_lowest(bed& b);
    int take_touching(bed& b);
    void drive(bed& b);

    settings settings_;
    state state_;
};

}  // namespace hearth::dem
