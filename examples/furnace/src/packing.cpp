// SPDX-License-Identifier: MIT
#include "packing.hpp"

#include <algorithm>
#include <cmath>

#include <hearth/dem/random.hpp>

#include "shaft_gas.hpp"

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

/// A diameter of a stone, by the sizes' shares of number.
double draw(const settings& scene, dem::random_source& random) {
    double all = 0;
    for (const size_class& size : scene.particles.sizes) all += size.mass_share / std::pow(size.diameter, 3);
    double left = random.uniform() * all;
    for (const size_class& size : scene.particles.sizes) {
        left -= size.mass_share / std::pow(size.diameter, 3);
        if (left <= 0) return size.diameter;
    }
    return scene.particles.sizes.back().diameter;
}

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

constexpr double loose = 1.06;  // spacing of the start over the largest diameter

}  // namespace

double sauter_diameter(const settings& scene) {
    double inverse = 0;
    for (const size_class& size : scene.particles.sizes) inverse += size.mass_share / size.diameter;
    return 1 / inverse;
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
    const double height = scene.shaft.height, shaft_radius = 0.5 * scene.shaft.diameter;
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
    return remake_bed(scene, std::move(spheres), masses);
}

std::unique_ptr<dem::moving_bed> remake_bed(const settings& scene, std::vector<dem::sphere> spheres, std::vector<double> masses) {
    const double height = scene.shaft.height;
    dem::surroundings around{dem::contact_law::between_particles(softened(scene), contact_of(scene)), {shaft_wall(scene, height)}, {}};
    around.wall_laws.push_back(dem::contact_law::with_wall(softened(scene), softened(scene), contact_of(scene)));
    return std::make_unique<dem::plug_bed>(std::move(spheres), std::move(masses), dem::zone{{0, 0, 0}, 0.5 * scene.shaft.diameter, height},
                                           std::move(around), scene.particles.mass_flow);
}

filling::filling(const settings& scene) : scene_(scene), bed_(bed_settings_of(scene)), top_(scene.shaft.height) {
    dem::wall floor;
    floor.facets = dem::shape::plane({0, 0, 0}, {0, 0, 1});
    floor.body = softened(scene);
    floor.contact = contact_of(scene);
    bed_.add_wall(floor);
    bed_.add_wall(shaft_wall(scene, 4 * top_));
    // A loose cubic lattice, too unstable to remain one, with more than enough to fill what is modelled.
    double largest = 0;
    for (const size_class& size : scene.particles.sizes) largest = std::max(largest, size.diameter);
    largest *= scene.bed.coarse_graining;
    const double spacing = loose * largest, shaft_radius = 0.5 * scene.shaft.diameter;
    dem::random_source random{scene.output.seed};
    const double wanted = 0.60 * pi * shaft_radius * shaft_radius * (top_ + 0.5 * largest);
    std::vector<dem::particle> start;
    const auto across = static_cast<int>(shaft_radius / spacing);
    double filled = 0;
    for (int k = 0; filled < wanted; ++k) {
        for (int j = -across; j <= across; ++j) {
            for (int i = -across; i <= across; ++i) {
                const auto jitter = [&] { return (loose - 1) * largest * random.uniform(-0.25, 0.25); };
                dem::particle p;
                p.radius = 0.5 * scene.bed.coarse_graining * draw(scene, random);
                p.density = scene.particles.density;
                p.temperature = scene.particles.feed_temperature;
                p.position = {i * spacing + jitter(), j * spacing + jitter(), (k + 0.5) * spacing + jitter()};
                if (std::hypot(p.position.x, p.position.y) + p.radius > shaft_radius) continue;
                filled += 4.0 / 3.0 * pi * std::pow(p.radius, 3);
                start.push_back(p);
            }
        }
    }
    bed_.insert(start);
}

void filling::advance(int steps) {
    bed_.advance(steps);
    judge();
    // Softened parcels lie deep in one another under the weight of 10 m, which costs void fraction that true stones keep:
    // under a twentieth of it they spring back.
    if (!at_rest_ || bed_.settings().gravity.z > -9) return;
    bed_.set_gravity({0, 0, -9.81 / 20});
    at_rest_ = false;
}

void filling::judge() {
    // At rest: slower, at the mean of all, than a fall by a five-hundredth of a diameter makes; the column still rings a little.
    double energy = 0, mass = 0;
    for (dem::index i = 0; i < bed_.size(); ++i) {
        energy += 0.5 * bed_.mass(i) * dot(bed_.motions()[i].velocity, bed_.motions()[i].velocity);
        mass += bed_.mass(i);
    }
    const double fall = 0.01 * scene_.bed.coarse_graining * sauter_diameter(scene_) * 9.81;
    at_rest_ = bed_.time() > 0.3 && energy / mass < 0.2 * fall;
}

double filling::level() const {
    double top = 0;
    for (dem::index i = 0; i < bed_.size(); ++i) top = std::max(top, bed_.spheres()[i].centre.z);
    return std::min(top, top_);
}

double filling::share() const {
    const double expected = std::sqrt(2 * 0.4 * top_ / 9.81) + 0.5;  // the top falls by a third of the height, then rests
    return at_rest_ ? 1 : std::min(0.99, bed_.time() / expected);
}

void filling::restore(double gravity, const std::vector<char>& state) {
    bed_.set_gravity({0, 0, gravity});
    bed_.restore(state);
    judge();
}

std::unique_ptr<dem::moving_bed> filling::finished() const {
    std::vector<dem::sphere> spheres;
    std::vector<double> masses;
    for (dem::index i = 0; i < bed_.size(); ++i) {
        const dem::sphere& s = bed_.spheres()[i];
        if (s.centre.z < 0 || s.centre.z >= top_) continue;
        spheres.push_back(s);
        masses.push_back(bed_.mass(i));
    }
    return remake_bed(scene_, std::move(spheres), std::move(masses));
}

}  // namespace hearth::furnace
