// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <hearth/closure/grey_exchange.hpp>
#include <hearth/closure/wall_view.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/transfer/term.hpp>

namespace hearth {

/// What the neighbours of a sphere within a cutoff do in a random packed bed of equal spheres.
/// Own ray tracing of eight gravity-settled packings of 3000 spheres, solid fraction 0.577 to 0.637, the same as behind
/// closure::feng_han::monte_carlo_fit; linear between nodes in both arguments, constant outside.
struct bed_view {
    double seen;     ///< share of the sphere's view that they fill [-]
    double carried;  ///< share of the bed's radiative conductivity that they carry [-]

    /// cutoff: distance of the centres over the diameter [-].
    static bed_view within(double cutoff, double solid_fraction) {
        static constexpr std::array<double, 8> reach{1.001, 1.2, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0};
        static constexpr std::array<double, 4> packing{0.57671, 0.59292, 0.61780, 0.63687};
        static constexpr double seen_by[4][8]{{0.35498, 0.60935, 0.76878, 0.86817, 0.92765, 0.97303, 0.99078, 0.99883},
                                              {0.38834, 0.63279, 0.78977, 0.88586, 0.94048, 0.97918, 0.99343, 0.99928},
                                              {0.42829, 0.67614, 0.81883, 0.90965, 0.95679, 0.98612, 0.99615, 0.99966},
                                              {0.46993, 0.71137, 0.84276, 0.92727, 0.96871, 0.99053, 0.99778, 0.99985}};
        static constexpr double carried_by[4][8]{{0.1916, 0.3499, 0.5045, 0.6457, 0.7569, 0.8777, 0.9479, 0.9970},
                                                 {0.2209, 0.3807, 0.5417, 0.6854, 0.7928, 0.9015, 0.9607, 0.9981},
                                                 {0.2626, 0.4375, 0.5954, 0.7421, 0.8417, 0.9305, 0.9753, 0.9993},
                                                 {0.3065, 0.4882, 0.6427, 0.7878, 0.8806, 0.9506, 0.9848, 0.9997}};
        const auto [r, a] = place(reach, cutoff);
        const auto [p, b] = place(packing, solid_fraction);
        const auto mix = [r = r, a = a, p = p, b = b](const double(&table)[4][8]) {
            const double loose = table[p][r] + a * (table[p][r + 1] - table[p][r]);
            const double dense = table[p + 1][r] + a * (table[p + 1][r + 1] - table[p + 1][r]);
            return loose + b * (dense - loose);
        };
        return {mix(seen_by), mix(carried_by)};
    }

  private:
    struct place_in {
        std::size_t node;
        double part;
    };
    template <std::size_t N>
    static place_in place(const std::array<double, N>& nodes, double x) {
        std::size_t k = 0;
        while (k + 2 < N && x >= nodes[k + 1]) ++k;
        return {k, std::clamp((x - nodes[k]) / (nodes[k + 1] - nodes[k]), 0.0, 1.0)};
    }
};

/// How the rows of a radiation term are closed: what is left of a particle's view beyond the neighbours in the list.
enum class view_rows {
    /// Every pair is scaled by the same factor, so that the bed conducts by radiation what the full list would; rows in
    /// the
    /// bed then sum to 1.03 to 1.10, because near neighbours stand in for far ones.
    conductivity,
    /// Pairs are scaled symmetrically until the row of a particle inside the bed sums to 1; the bed's conductivity is
    /// then
    /// 4 to 11 % too low at a cutoff of 2.5 diameters.
    closed
};

struct radiation_params {
    double solid_fraction = 0.6;   ///< of the bed, for what the cutoff leaves out [-]
    double cutoff = 2.5;           ///< distance of centres over the diameter [-]
    double emissivity = 1.0;       ///< of particles and walls alike [-]
    double surroundings = 293.15;  ///< temperature that open views see [K]
    view_rows rows = view_rows::conductivity;
    /// Share of its view that a particle must miss before it counts as open to the surroundings [-].  Rows of particles
    /// inside a bed scatter by 0.03 to 0.04, and a bed must not leak through this scatter; surface particles miss 0.4.
    double open_from = 0.2;
};

/// Radiation between particles of a bed, to its walls and to open surroundings:  Q = s A F R (T_there^4 - T^4), s
/// Stefan-Boltzmann's constant, F with the shading by all others, R the grey factor of the bed.
///
/// ViewFactor: view_factor(distance over diameter) between particles, e.g. closure::feng_han::monte_carlo_fit.
/// WallView: from a particle to a wall, see closure::wall_view; the paper's 0.5 is closure::wall_view::paper.
/// Paper: Eqs. 4 and 5 between touching bodies, black, F = 0.5 to the wall; touching pairs carry 19 to 31 % of a bed's
/// radiative conductivity only.
///
/// Every exchange area is symmetric, so energy is conserved whatever the rows sum to; the rows decide how accurate it
/// is.
template <class ViewFactor, class WallView = closure::wall_view::closed>
struct radiation : ViewFactor {
    radiation_params params;
    WallView wall;

    using reads = quantities<quantity::radius, quantity::temperature>;
    using writes = quantities<quantity::heat_rate>;
    using gas_reads = quantities<>;
    using gas_writes = quantities<>;
    static constexpr act acts = act::views;

    explicit radiation(ViewFactor between, radiation_params settings = {}, WallView to_wall = WallView())
        : ViewFactor(std::move(between)), params(settings), wall(std::move(to_wall)) {
        check();
    }

    double reach() const { return params.cutoff; }

    /// A F, the same from both sides: the mean diameter sets the distance, pi d_p d_q the area [m^2].
    template <class Particle>
    double pair_area(const Particle& p, const Particle& q, double distance) const {
        const double radius_p = static_cast<double>(p[quantity::radius{}]);
        const double radius_q = static_cast<double>(q[quantity::radius{}]);
        return 4.0 * constants<double>::pi() * radius_p * radius_q *
               this->view_factor(distance / (radius_p + radius_q));
    }

    /// A F to a wall [m^2].
    template <class Particle>
    double wall_area(const Particle& p, double distance) const {
        return surface(p) * wall.view_factor(distance / (2.0 * static_cast<double>(p[quantity::radius{}])));
    }

    /// How much of its view a wall beside it may take from a particle, at most [-]; beyond, it is open.
    static constexpr double behind_wall() { return 0.32; }
    /// To this distance of the centre over the diameter a wall is beside a particle.
    static constexpr double beside_wall() { return 1.2; }

    template <class Particle>
    static double surface(const Particle& p) {
        const double radius = static_cast<double>(p[quantity::radius{}]);
        return 4.0 * constants<double>::pi() * radius * radius;
    }

    /// Coefficient of T^4 over exchange area [W/(m^2 K^4)].
    double emission() const {
        return constants<double>::stefan_boltzmann() * closure::grey_exchange::bed_factor(params.emissivity);
    }

  private:
    /// The constructor throws bad_value for parameters outside their ranges.
    void check() const {
        const auto require = [](bool holds, const char* name, double value, const char* allowed) {
            if (!holds) throw bad_value(name, bad_value::no_index, value, allowed);
        };
        require(params.solid_fraction > 0.0 && params.solid_fraction < 1.0, "solid_fraction", params.solid_fraction,
                "in (0, 1) [-]");
        require(params.cutoff >= 1.0 && params.cutoff <= 4.0, "cutoff", params.cutoff, "in [1, 4] [-]");
        require(params.emissivity > 0.0 && params.emissivity <= 1.0, "emissivity", params.emissivity, "in (0, 1] [-]");
        require(params.surroundings > 0.0 && std::isfinite(params.surroundings), "surroundings", params.surroundings,
                "finite and > 0 [K]");
        require(params.open_from >= 0.0 && params.open_from <= 1.0, "open_from", params.open_from, "in [0, 1] [-]");
    }
};
template <class ViewFactor>
radiation(ViewFactor) -> radiation<ViewFactor>;
template <class ViewFactor>
radiation(ViewFactor, radiation_params) -> radiation<ViewFactor>;
template <class ViewFactor, class WallView>
radiation(ViewFactor, radiation_params, WallView) -> radiation<ViewFactor, WallView>;

}  // namespace hearth
