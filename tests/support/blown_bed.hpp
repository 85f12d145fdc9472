// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <hearth/closure/ergun.hpp>
#include <hearth/core/lattice.hpp>
#include <hearth/dem/feed.hpp>
#include <hearth/gas/generate.hpp>
#include <hearth/gas/mesh_traits.hpp>
#include <hearth/gas/solver.hpp>

#include "support/packing.hpp"

/// Fig. 5 of Spijker et al. (2023): air through a bed of 14 mm spheres under a free region.  The diameter of their tube
/// is not told.
namespace hearth::test {

struct blown_gas {
    double density = 1.2, viscosity = 1.8e-5;  // air
    double speed = 0.5;                        ///< superficial [m/s]

    /// Ergun's pressure gradient [Pa/m].
    double ergun(double void_fraction, double diameter) const {
        return closure::pressure_gradient(closure::ergun{}, closure::bed_flow<double>{void_fraction, speed / void_fraction,
                                                                                      density, viscosity, diameter});
    }
};

/// Void fraction over the height: the share of each level that lies outside of all spheres, exact.
struct void_profile {
    double spacing = 0;            ///< [m]
    std::vector<double> fraction;  ///< at the middles of slices of that thickness from z = 0 [-]

    void_profile(const packing& bed, double area, double height, int slices)
        : spacing(height / slices), fraction(static_cast<std::size_t>(slices), 1.0) {
        for (std::size_t i = 0; i < bed.radii.size(); ++i) {
            const double z = bed.positions[i][2], r = bed.radii[i];
            for (int k = std::max(0, static_cast<int>((z - r) / spacing)); k < slices && k * spacing < z + r; ++k) {
                const double away = (k + 0.5) * spacing - z;
                fraction[static_cast<std::size_t>(k)] -= std::max(0.0, 3.14159265358979323846 * (r * r - away * away)) / area;
            }
        }
    }

    /// Under a Gaussian of that standard deviation [m]: the scale on which a closure's void fraction is meant.
    void filter(double width) {
        const std::vector<double> exact = fraction;
        const int reach = static_cast<int>(4 * width / spacing), n = static_cast<int>(exact.size());
        for (int k = 0; k < n; ++k) {
            double sum = 0, weights = 0;
            for (int m = -reach; m <= reach; ++m) {
                const double weight = std::exp(-0.5 * std::pow(m * spacing / width, 2));
                sum += weight * exact[static_cast<std::size_t>(std::clamp(k + m, 0, n - 1))];
                weights += weight;
            }
            fraction[static_cast<std::size_t>(k)] = sum / weights;
        }
    }

    double mean(double from, double to) const {
        double sum = 0;
        int count = 0;
        for (std::size_t k = 0; k < fraction.size(); ++k) {
            const double z = (static_cast<double>(k) + 0.5) * spacing;
            if (z < from || z > to) continue;
            sum += fraction[k];
            ++count;
        }
        return sum / count;
    }

    /// Integral of the closure over the slices that count as bed, as in the gas solver: solid fraction above 0.1 [Pa].
    double pressure_drop(const blown_gas& gas, double diameter) const {
        double sum = 0;
        for (const double e : fraction) sum += 1 - e > 0.1 ? gas.ergun(e, diameter) * spacing : 0;
        return sum;
    }
};

/// A bed of equal spheres without walls at its sides, `side` wide and ten diameters high, with three free diameters below
/// it and above.
struct wide_bed {
    static constexpr double diameter = 0.014, side = 8, height = 16;  // [m], then in diameters

    wide_bed(double solid_fraction, std::uint64_t seed)
        : spheres(make_packing({solid_fraction, {side, side, 10}, 0, {true, true, false}, seed})) {
        for (point& x : spheres.positions) {
            x[2] += 3;
            for (double& coordinate : x) coordinate *= diameter;
        }
        for (double& r : spheres.radii) r *= diameter;
    }
    /// Repeats itself sideways: where the solid fraction is made.
    lattice repeated(double d_dx) const {
        const double dx = diameter / d_dx;
        const auto across = static_cast<std::int32_t>(side * d_dx);
        return {{{across, across, static_cast<std::int32_t>(height * d_dx)}, {dx, dx, dx}, {true, true, false}, {0, 0, 0}}};
    }
    /// Its gas has planes of symmetry at the sides; cells in the same order.
    gas::mesh mesh(double d_dx) const {
        const gas::array<double> across = gas::graded(side * diameter, static_cast<int>(side * d_dx));
        return gas::mesh(gas::box(across, across, gas::graded(height * diameter, static_cast<int>(height * d_dx))));
    }
    void_profile profile() const {
        return {spheres, side * side * diameter * diameter, height * diameter, 64 * static_cast<int>(height)};
    }

    packing spheres;
};

/// Equal spheres that settled in a tube under gravity: 145 mm of them, and 155 mm free.
struct tube_bed {
    static constexpr double diameter = 0.014, height = 0.3;  // [m]

    explicit tube_bed(double tube_to_particle, double level_ = 0.145)
        : radius(0.5 * tube_to_particle * diameter), level(level_) {
        dem::bed_settings settings;
        settings.body.youngs_modulus = 1e7;  // glass, softened: overlaps stay below 0.1 %
        settings.contact.damping = dem::damping_of_restitution(0.6);
        dem::bed settling(settings);
        settling.add_wall({dem::shape::plane({0, 0, 0}, {0, 0, 1})});
        settling.add_wall({dem::shape::cylinder({0, 0, -1}, {0, 0, 2}, radius)});
        dem::feed source({{{0, 0, 1.15 * level}, radius, 0.06}, 5, 2500}, dem::size_distribution({{diameter, 1}}));
        dem::fill_to_level(settling, source, {{0, 0, 0}, radius, height}, level, 400000);
        settling.advance(25000);  // half a second: the last ones fall
        top = dem::surface_level(settling, {{0, 0, 0}, radius, height});
        for (dem::index i = 0; i < settling.size(); ++i) {
            const dem::sphere& s = settling.spheres()[i];
            spheres.positions.push_back({s.centre.x, s.centre.y, s.centre.z});
            spheres.radii.push_back(s.radius);
        }
    }
    gas::mesh mesh(double d_dx) const {
        gas::shaft shape;
        shape.profile = {{0, radius}, {height, radius}};
        shape.axial_size = {{0, diameter / d_dx}, {height, diameter / d_dx}};
        shape.cross_size = diameter / d_dx;
        return gas::mesh(gas::renumbered(gas::make(shape)));
    }
    /// The stretch in which neither the floor nor the surface shows.
    double from() const { return 2.5 * diameter; }
    double to() const { return top - 2.5 * diameter; }
    double void_fraction() const {
        return void_profile(spheres, 3.14159265358979323846 * radius * radius, height, 2000).mean(from(), to());
    }

    double radius, level, top = 0;  // [m]
    packing spheres;
};

struct blown {
    double pressure_drop = 0;  ///< over bed and free region [Pa]
    double gradient = 0;       ///< between two heights, by least squares [Pa/m]
    gas::report report;
};

/// Steady flow of cold air upwards through a bed.  `sides`: slip for a wide bed, walls for a tube.
inline blown blow(const gas::mesh& mesh, const std::vector<double>& solid_fraction, double diameter, const blown_gas& air,
                  const gas::patch_condition& sides, double from = 0, double to = 0, int iterations = 300,
                  const gas::drag_function& drag = gas::make_drag(closure::ergun{})) {
    auto model = std::make_shared<gas::simple_gas>();
    model->constant_density = air.density;
    model->sutherland = 0;
    model->viscosity_reference = air.viscosity;
    gas::solver_settings settings;
    settings.gravity = {0, 0, 0};
    settings.energy = false;
    settings.turbulence = sides.type == gas::patch_condition::kind::wall;
    settings.tolerance = 1e-3;  // the pressure drop then stands still to a tenth of a per cent
    settings.max_iterations = iterations;
    settings.drag = drag;
    gas::solver solver(mesh, model, settings);
    const bool is_tube = settings.turbulence;
    const gas::patch &bottom = mesh.find_patch(is_tube ? "bottom" : "z_min"), &top = mesh.find_patch(is_tube ? "top" : "z_max");
    for (const gas::patch& p : mesh.patches) solver.set(p.name, sides);
    solver.set(bottom.name, gas::mass_flow_inlet(air.density * air.speed * mesh.area_of(bottom), {300}));
    solver.set(top.name, gas::pressure_outlet(1e5));
    for (int c = 0; c < mesh.cells(); ++c) {
        solver.bed.void_fraction[c] = 1 - solid_fraction[static_cast<std::size_t>(c)];
        solver.bed.diameter[c] = diameter;
    }
    solver.initialise(300);
    blown result;
    result.report = solver.steady();
    result.pressure_drop = solver.mean_pressure(bottom.name) - 1e5;
    double volume = 0, z = 0, p = 0, zz = 0, zp = 0;
    for (int c = 0; c < mesh.cells(); ++c) {
        const double height = mesh.centre[c].z, v = mesh.volume[c], pressure = solver.gas.flow.pressure[c];
        if (height < from || height > to) continue;
        volume += v;
        z += v * height;
        p += v * pressure;
        zz += v * height * height;
        zp += v * height * pressure;
    }
    if (to > from) result.gradient = -(zp - z * p / volume) / (zz - z * z / volume);
    return result;
}

}  // namespace hearth::test
