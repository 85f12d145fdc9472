// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hearth/core/contact_traits.hpp>
#include <hearth/core/particle_traits.hpp>

#include "support/packing.hpp"

namespace hearth_test {

/// Particles of a bed in plain arrays with all that a scene may ask, and who is near whom.
struct warm_bed {
    std::vector<hearth::point> position, velocity;
    std::vector<double> radius, temperature, conductivity, moisture;
    std::vector<double> heat_rate, mass_rate;
    std::vector<std::array<double, 3>> force;

    struct pair {
        int first, second;
        double distance;
    };
    struct wall {
        int particle, patch;
        double distance;
    };
    std::vector<pair> near;   ///< to the largest cutoff that a test wants
    std::vector<wall> walls;  ///< the same, to walls
    std::vector<double> wall_temperatures;
    double stiffness = 1e6;  ///< contact force over overlap [N/m]

    explicit warm_bed(std::size_t count)
        : position(count),
          velocity(count),
          radius(count, 0.005),
          temperature(count, 300.0),
          conductivity(count, 2.0),
          moisture(count, 0.0),
          heat_rate(count, 0.0),
          mass_rate(count, 0.0),
          force(count) {}

    /// From a packing whose unit is the mean diameter: particles of `diameter` [m], neighbours to `cutoff` diameters.
    /// Sides that are not periodic are walls, patch 2 a + (0 low, 1 high) on axis a, except open ones.
    warm_bed(const hearth::test::packing& packed, double diameter, double cutoff, int open_patch = -1)
        : warm_bed(packed.radii.size()) {
        for (std::size_t i = 0; i < radius.size(); ++i) {
            radius[i] = packed.radii[i] * diameter;
            for (std::size_t a = 0; a < 3; ++a) position[i][a] = packed.positions[i][a] * diameter;
        }
        const int count = static_cast<int>(radius.size());
        for (int i = 0; i < count; ++i)
            for (int j = i + 1; j < count; ++j) {
                double square = 0;
                for (std::size_t a = 0; a < 3; ++a) {
                    double d = position[at(j)][a] - position[at(i)][a];
                    const double size = packed.size[a] * diameter;
                    if (packed.periodic[a]) d -= size * std::round(d / size);
                    square += d * d;
                }
                const double reach = cutoff * (radius[at(i)] + radius[at(j)]);
                if (square < reach * reach) near.push_back({i, j, std::sqrt(square)});
            }
        wall_temperatures.assign(6, 300.0);
        for (int i = 0; i < count; ++i)
            for (int patch = 0; patch < 6; ++patch) {
                const auto a = static_cast<std::size_t>(patch / 2);
                if (packed.periodic[a] || patch == open_patch) continue;
                const double x = position[at(i)][a], size = packed.size[a] * diameter;
                const double distance = patch % 2 == 0 ? x : size - x;
                if (distance < cutoff * 2 * radius[at(i)]) walls.push_back({i, patch, distance});
            }
    }

    void clear_rates() {
        heat_rate.assign(radius.size(), 0.0);
        mass_rate.assign(radius.size(), 0.0);
        force.assign(radius.size(), {});
    }

    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
};

/// The gas as each particle of a bed sees it, and what it receives there.
struct gas_samples {
    std::vector<double> void_fraction, density, viscosity, conductivity, specific_heat, temperature, pressure, vapour,
        diffusivity;
    std::vector<std::array<double, 3>> velocity, pressure_gradient;
    std::vector<double> heat_rate, vapour_rate, vapour_enthalpy_rate;
    std::vector<std::array<double, 3>> force;

    /// Air near 400 K that rises at 0.5 m/s through a bed of void fraction 0.4.
    explicit gas_samples(std::size_t count)
        : void_fraction(count, 0.4),
          density(count, 0.8825),
          viscosity(count, 2.29e-5),
          conductivity(count, 0.0331),
          specific_heat(count, 1014),
          temperature(count, 400),
          pressure(count, 101325),
          vapour(count, 0.005),
          diffusivity(count, 4.5e-5),
          velocity(count, {0.0, 0.0, 1.25}),
          pressure_gradient(count, {0.0, 0.0, -400.0}),
          heat_rate(count, 0.0),
          vapour_rate(count, 0.0),
          vapour_enthalpy_rate(count, 0.0),
          force(count) {}
};

}  // namespace hearth_test

template <>
struct hearth::particle_traits<hearth_test::warm_bed> {
    using index = int;
    using scalar = double;
    using bed = hearth_test::warm_bed;
    static std::size_t at(index i) { return static_cast<std::size_t>(i); }

    static index particle_count(const bed& b) { return static_cast<index>(b.radius.size()); }
    static const point& get(quantity::position, const bed& b, index i) { return b.position[at(i)]; }
    static const point& get(quantity::velocity, const bed& b, index i) { return b.velocity[at(i)]; }
    static double get(quantity::radius, const bed& b, index i) { return b.radius[at(i)]; }
    static double get(quantity::temperature, const bed& b, index i) { return b.temperature[at(i)]; }
    static double get(quantity::conductivity, const bed& b, index i) { return b.conductivity[at(i)]; }
    static double get(quantity::moisture, const bed& b, index i) { return b.moisture[at(i)]; }
    static void add(quantity::heat_rate, bed& b, index i, double q) { b.heat_rate[at(i)] += q; }
    static void add(quantity::mass_rate, bed& b, index i, double q) { b.mass_rate[at(i)] += q; }
    static void add(quantity::force, bed& b, index i, const std::array<double, 3>& f) {
        for (std::size_t a = 0; a < 3; ++a) b.force[at(i)][a] += f[a];
    }
};

template <>
struct hearth::particle_traits<hearth_test::gas_samples> {
    using index = int;
    using scalar = double;
    using gas = hearth_test::gas_samples;
    static std::size_t at(index i) { return static_cast<std::size_t>(i); }

    static index particle_count(const gas& g) { return static_cast<index>(g.density.size()); }
    static double get(quantity::void_fraction, const gas& g, index i) { return g.void_fraction[at(i)]; }
    static double get(quantity::gas_density, const gas& g, index i) { return g.density[at(i)]; }
    static double get(quantity::gas_viscosity, const gas& g, index i) { return g.viscosity[at(i)]; }
    static double get(quantity::gas_conductivity, const gas& g, index i) { return g.conductivity[at(i)]; }
    static double get(quantity::gas_specific_heat, const gas& g, index i) { return g.specific_heat[at(i)]; }
    static double get(quantity::gas_temperature, const gas& g, index i) { return g.temperature[at(i)]; }
    static double get(quantity::gas_pressure, const gas& g, index i) { return g.pressure[at(i)]; }
    static double get(quantity::vapour_fraction, const gas& g, index i) { return g.vapour[at(i)]; }
    static double get(quantity::vapour_diffusivity, const gas& g, index i) { return g.diffusivity[at(i)]; }
    static const std::array<double, 3>& get(quantity::gas_velocity, const gas& g, index i) { return g.velocity[at(i)]; }
    static const std::array<double, 3>& get(quantity::pressure_gradient, const gas& g, index i) {
        return g.pressure_gradient[at(i)];
    }
    static void add(quantity::gas_heat_rate, gas& g, index i, double q) { g.heat_rate[at(i)] += q; }
    static void add(quantity::vapour_rate, gas& g, index i, double q) { g.vapour_rate[at(i)] += q; }
    static void add(quantity::vapour_enthalpy_rate, gas& g, index i, double q) { g.vapour_enthalpy_rate[at(i)] += q; }
    static void add(quantity::gas_force, gas& g, index i, const std::array<double, 3>& f) {
        for (std::size_t a = 0; a < 3; ++a) g.force[at(i)][a] += f[a];
    }
};

template <>
struct hearth::contact_traits<hearth_test::warm_bed> {
    using bed = hearth_test::warm_bed;

    template <class Visit>
    static void for_each_contact(const bed& b, Visit&& visit) {
        for (const auto& p : b.near) {
            const double overlap = b.radius[bed::at(p.first)] + b.radius[bed::at(p.second)] - p.distance;
            if (overlap > 0) visit(p.first, p.second, contact{b.stiffness * overlap, overlap, {}});
        }
    }
    template <class Visit>
    static void for_each_wall_contact(const bed& b, Visit&& visit) {
        for (const auto& w : b.walls) {
            // A packing ends with gaps of a thousandth of the diameter.
            const double overlap = 1.004 * b.radius[bed::at(w.particle)] - w.distance;
            if (overlap > 0) visit(w.particle, w.patch, contact{b.stiffness * overlap, overlap, {}});
        }
    }
    template <class Visit>
    static void for_each_near(const bed& b, double radius_factor, Visit&& visit) {
        for (const auto& p : b.near)
            if (p.distance < radius_factor * (b.radius[bed::at(p.first)] + b.radius[bed::at(p.second)]))
                visit(p.first, p.second, p.distance);
    }
    template <class Visit>
    static void for_each_near_wall(const bed& b, double radius_factor, Visit&& visit) {
        for (const auto& w : b.walls)
            if (w.distance < radius_factor * 2 * b.radius[bed::at(w.particle)]) visit(w.particle, w.patch, w.distance);
    }
    static double wall_temperature(const bed& b, int patch) { return b.wall_temperatures[bed::at(patch)]; }
};
