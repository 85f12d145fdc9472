// SPDX-License-Identifier: MIT
#include "packing.hpp"

#include <algorithm>
#include <cmath>

#include "random_packing.hpp"

namespace hearth::furnace {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Face-centred cubic with nearest neighbours at `spacing`, centres up to the wall (but within the polygon that a coarse mesh
/// makes of it), so that the solid is as dense there as inside.  The lattice is turned out of the axis, by angles whose tangents are not simple fractions: upright it would leave
/// straight channels in which gas passes the parcels by, and parcels would leave by layers.
std::vector<dem::vector3> lattice(double radius, double height, double spacing) {
    const double edge = spacing * std::sqrt(2.0);  // of the cube with a point on each corner and face
    const double inside = 0.985 * radius, a = 0.37, b = 0.61;
    const dem::vector3 axes[3] = {{std::cos(b), std::sin(a) * std::sin(b), std::cos(a) * std::sin(b)},
                                  {0, std::cos(a), -std::sin(a)},
                                  {-std::sin(b), std::sin(a) * std::cos(b), std::cos(a) * std::cos(b)}};
    const dem::vector3 corners[4] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    const dem::vector3 middle{0, 0, 0.5 * height};
    const auto reach = static_cast<int>(std::hypot(radius, 0.5 * height) / edge) + 2;
    std::vector<dem::vector3> points;
    for (int k = -reach; k <= reach; ++k) {
        for (int j = -reach; j <= reach; ++j) {
            // Of the line along the first axis only the stretch beside the shaft's axis can be inside.
            const dem::vector3 start = middle + (j * edge) * axes[1] + (k * edge) * axes[2];
            const double across = axes[0].x * axes[0].x + axes[0].y * axes[0].y;
            const double nearest = -(axes[0].x * start.x + axes[0].y * start.y) / across / edge;
            const auto half = static_cast<int>(radius / std::sqrt(across) / edge) + 2;
            const auto centre = static_cast<int>(std::lround(nearest));
            for (int i = centre - half; i <= centre + half; ++i) {
                for (const dem::vector3& c : corners) {
                    const dem::vector3 x = start + ((i + c.x) * edge) * axes[0] + (c.y * edge) * axes[1] + (c.z * edge) * axes[2];
                    if (x.x * x.x + x.y * x.y <= inside * inside && x.z >= 0 && x.z < height) points.push_back(x);
                }
            }
        }
    }
    return points;
}

}  // namespace

dem::bed_settings bed_settings_of(const settings& scene) {
    dem::bed_settings s;
    s.body = softened(scene);
    s.contact = contact_of(scene);
    double smallest = scene.particles.sizes.front().diameter;
    for (const size_class& size : scene.particles.sizes) smallest = std::min(smallest, size.diameter);
    s.step = 0.2 * dem::rayleigh_time(0.5 * smallest * scene.bed.coarse_graining, scene.particles.density, s.body);
    s.deepest_overlap = 0.6;  // falls from the loose start are hard on softened parcels
    return s;
}

double sauter_diameter(const settings& scene) {
    double inverse = 0;
    for (const size_class& size : scene.particles.sizes) inverse += size.mass_share / size.diameter;
    return 1 / inverse;
}

dem::size_distribution sizes_of(const settings& scene) {
    std::vector<size_class> sizes = scene.particles.sizes;
    std::sort(sizes.begin(), sizes.end(), [](const size_class& a, const size_class& b) { return a.diameter < b.diameter; });
    std::vector<dem::size_distribution::point> table;
    double below = 0;
    for (const size_class& size : sizes) {
        const double diameter = scene.bed.coarse_graining * size.diameter;
        if (!(size.mass_share > 0)) continue;
        table.push_back({diameter, below});
        below = std::min(1.0, below + size.mass_share);
        table.push_back({diameter * (1 + 1e-9), below});  // the table is linear between its points: a class is a steep piece
    }
    table.back().mass_below = 1;
    return dem::size_distribution(table);
}

dem::material softened(const settings& scene) { return {scene.bed.softened_modulus, scene.bed.poisson_ratio}; }

dem::contact_settings contact_of(const settings& scene) {
    dem::contact_settings c;
    c.damping = dem::damping_of_restitution(scene.bed.restitution);
    c.friction = scene.bed.friction;
    return c;
}

dem::wall shaft_wall(const settings& scene, double top) {
    dem::wall w;
    w.facets = dem::shape::cylinder({0, 0, -1}, {0, 0, top}, 0.5 * scene.shaft.diameter);
    w.body = softened(scene);
    w.contact = contact_of(scene);
    return w;
}

std::unique_ptr<dem::moving_bed> lattice_bed(const settings& scene) {
    const double height = height_of_stones(scene), shaft_radius = 0.5 * scene.shaft.diameter;
    double radius = 0.5 * scene.bed.coarse_graining * sauter_diameter(scene);
    const double wanted = (1 - scene.bed.void_fraction) * pi * shaft_radius * shaft_radius * height / (4.0 / 3.0 * pi * std::pow(radius, 3));
    // Parcels near the wall come and go with the lattice's spacing, so look for the spacing that holds as many as wanted.
    double low = radius, high = 4 * radius;
    for (int pass = 0; pass < 60; ++pass) {
        const double middle = 0.5 * (low + high);
        (static_cast<double>(lattice(shaft_radius, height, middle).size()) > wanted ? low : high) = middle;
    }
    const std::vector<dem::vector3> points = lattice(shaft_radius, height, high);
    // The lattice's numbers come in leaps; the parcels are made a little larger to hold all of the solid.
    radius *= std::cbrt(wanted / static_cast<double>(points.size()));
    std::vector<dem::sphere> spheres;
    for (const dem::vector3& x : points) spheres.push_back({x, radius});
    const std::vector<double> masses(spheres.size(), 4.0 / 3.0 * pi * std::pow(radius, 3) * scene.particles.density);
    return bed_of(scene, std::move(spheres), masses);
}

std::unique_ptr<dem::moving_bed> dense_bed(const settings& scene) {
    const dem::size_distribution sizes = sizes_of(scene);
    const double all = height_of_stones(scene), piece = std::max(2 * scene.shaft.diameter, 8 * sizes.largest());
    const double pieces = std::max(1.0, std::floor(all / piece)), height = all / pieces;
    const std::vector<dem::sphere> one = random_packing({0.5 * scene.shaft.diameter, height, scene.bed.void_fraction}, sizes, scene.output.seed);
    std::vector<dem::sphere> spheres;
    std::vector<double> masses;
    spheres.reserve(one.size() * static_cast<std::size_t>(pieces));
    masses.reserve(spheres.capacity());
    for (double p = 0; p < pieces; ++p) {
        for (const dem::sphere& s : one) {
            spheres.push_back({{s.centre.x, s.centre.y, std::min(s.centre.z + p * height, all)}, s.radius});
            masses.push_back(4.0 / 3.0 * pi * std::pow(s.radius, 3) * scene.particles.density);
        }
    }
    return bed_of(scene, std::move(spheres), std::move(masses));
}

double height_of_stones(const settings& scene) { return scene.shaft.height + scene.shaft.hopper_fill; }

dem::surroundings surroundings_of(const settings& scene) {
    dem::surroundings around{dem::contact_law::between_particles(softened(scene), contact_of(scene)), {shaft_wall(scene, scene.shaft.height)}, {}};
    around.wall_laws.push_back(dem::contact_law::with_wall(softened(scene), softened(scene), contact_of(scene)));
    return around;
}

std::unique_ptr<dem::moving_bed> bed_of(const settings& scene, std::vector<dem::sphere> spheres, std::vector<double> masses) {
    if (scene.bed.motion == bed_motion::frozen) {
        return std::make_unique<dem::frozen_bed>(std::move(spheres), std::move(masses), surroundings_of(scene));
    }
    const dem::zone shaft{{0, 0, 0}, 0.5 * scene.shaft.diameter, height_of_stones(scene)};
    return std::make_unique<dem::plug_bed>(std::move(spheres), std::move(masses), shaft, surroundings_of(scene), scene.particles.mass_flow);
}

}  // namespace hearth::furnace
