// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <hearth/closure/hertz.hpp>
#include <hearth/core/contact_traits.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/mesh_traits.hpp>
#include <hearth/core/strided_cloud.hpp>

namespace hearth {

/// A plane wall: the points x with normal . x = offset; the unit normal points to the particles.
struct plane_wall {
    point normal;        ///< [-]
    double offset;       ///< [m]
    double temperature;  ///< [K]
};

/// Contacts of spheres that move by Hertz's law, from the host's neighbour list: overlaps follow from positions and
/// radii, elastic forces from the modulus of the motion (closure::hertz).
///
/// Pairs: pairs(visit) calls visit(i, j) for each pair of the list once; j >= atoms.count for ghosts, whose data follow
/// those of owned particles in the arrays.
template <class Pairs>
struct sphere_contacts {
    strided_cloud<double> atoms;
    Pairs pairs;
    double list_reach;         ///< the list holds all pairs whose gap is below this [m]
    double effective_modulus;  ///< E* of the motion [Pa]
    std::vector<plane_wall> walls;
};
template <class Pairs>
sphere_contacts(strided_cloud<double>, Pairs, double, double, std::vector<plane_wall>) -> sphere_contacts<Pairs>;

template <class Pairs>
struct contact_traits<sphere_contacts<Pairs>> {
    using host = sphere_contacts<Pairs>;

    /// Errors: bad_value for two spheres in one place.
    template <class Visit>
    static void for_each_contact(const host& h, Visit&& visit) {
        h.pairs([&](auto i, auto j) {
            const double *x = h.atoms.position.row(i), *y = h.atoms.position.row(j);
            const double first = h.atoms.radius[i], second = h.atoms.radius[j], apart = distance(x, y);
            const double overlap = first + second - apart, at = (first - 0.5 * overlap) / apart;
            if (!(overlap > 0)) return;
            if (apart == 0) throw bad_value("distance from another particle, of particle", i, apart, "> 0 [m]");
            const point middle{x[0] + at * (y[0] - x[0]), x[1] + at * (y[1] - x[1]), x[2] + at * (y[2] - x[2])};
            visit(i, j, contact{force(h, overlap, closure::hertz::effective_radius(first, second)), overlap, middle});
        });
    }

    /// Errors: bad_value where the host's list does not reach so far.
    template <class Visit>
    static void for_each_near(const host& h, double radius_factor, Visit&& visit) {
        h.pairs([&](auto i, auto j) {
            const double touching = h.atoms.radius[i] + h.atoms.radius[j];
            if (radius_factor * touching > touching + h.list_reach) {
                throw bad_value("reach of the neighbour list", bad_value::no_index, h.list_reach,
                                "large enough for the cutoff of each term (make the host's skin larger) [m]");
            }
            const double apart = distance(h.atoms.position.row(i), h.atoms.position.row(j));
            if (apart < radius_factor * touching) visit(i, j, apart);
        });
    }

    template <class Visit>
    static void for_each_near_wall(const host& h, double radius_factor, Visit&& visit) {
        for (int w = 0; w < static_cast<int>(h.walls.size()); ++w) {
            const plane_wall& wall = h.walls[static_cast<std::size_t>(w)];
            for (std::int64_t i = 0; i < h.atoms.count; ++i) {
                const double* x = h.atoms.position.row(i);
                const double away = wall.normal[0] * x[0] + wall.normal[1] * x[1] + wall.normal[2] * x[2] - wall.offset;
                if (away < radius_factor * 2 * h.atoms.radius[i]) visit(i, w, away);
            }
        }
    }

    template <class Visit>
    static void for_each_wall_contact(const host& h, Visit&& visit) {
        for_each_near_wall(h, 0.5, [&](std::int64_t i, int w, double away) {
            const double *x = h.atoms.position.row(i), overlap = h.atoms.radius[i] - away;
            const point& n = h.walls[static_cast<std::size_t>(w)].normal;
            visit(i, w, contact{force(h, overlap, h.atoms.radius[i]), overlap,
                                point{x[0] - away * n[0], x[1] - away * n[1], x[2] - away * n[2]}});
        });
    }

    static double wall_temperature(const host& h, int w) { return h.walls[static_cast<std::size_t>(w)].temperature; }

  private:
    static double distance(const double* x, const double* y) { return std::hypot(y[0] - x[0], y[1] - x[1], y[2] - x[2]); }
    static double force(const host& h, double overlap, double effective_radius) {
        return closure::hertz::normal_force(overlap, effective_radius, h.effective_modulus);
    }
};

}  // namespace hearth
