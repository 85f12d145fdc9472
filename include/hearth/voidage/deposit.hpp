// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <hearth/core/cell_locator.hpp>
#include <hearth/core/element.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/voidage/footprints.hpp>
#include <hearth/voidage/visitors.hpp>

/// How the volume of a particle is spread over the cells that it touches.  Each policy keeps the volume exactly; what
/// hangs over a wall goes to the cells inside.
namespace hearth::deposit {

/// All volume to the cell that holds the centre.  Jumps when a centre crosses a face; for tests and comparisons, and
/// for the paper's method (Spijker et al. 2023), where the VFS spreads it afterwards.
struct centre {
    template <class Locator, class Visit>
    sighting for_each_weight(const Locator& locator, const visitor& v, Visit&& visit) const {
        const std::int32_t cell = locator.find(v.position);
        if (cell >= 0) visit(cell, 1.0);
        return {cell >= 0, 0};
    }
};

/// Equal parts to the cells that hold 29 points of the sphere: one in a core of 1/29 of its volume, 14 each in two
/// shells of 14/29, towards the faces and corners of a cube, at the mean radius of their shell.  Each point's part
/// jumps when the point crosses a face.  On several ranks find_cell must give a point on a face to one of them only.
struct divided {
    static constexpr int point_count = 29;

    template <class Locator, class Visit>
    sighting for_each_weight(const Locator& locator, const visitor& v, Visit&& visit) const {
        std::array<std::int32_t, point_count> cells{};
        std::array<int, point_count> hits{};
        std::size_t distinct = 0;
        for_each_point(v, [&](const point& x) {
            const std::int32_t cell = locator.find(x);
            if (cell < 0) return;
            std::size_t at = 0;
            while (at < distinct && cells[at] != cell) ++at;
            if (at == distinct) cells[distinct++] = cell;
            ++hits[at];
        });
        for (std::size_t at = 0; at < distinct; ++at) visit(cells[at], hits[at] * (1.0 / point_count));
        return {locator.find(v.position) >= 0, 0};
    }

    /// Visits the 29 points of a sphere.
    template <class Visit>
    static void for_each_point(const visitor& v, Visit&& visit) {
        visit(v.position);
        const double corner = 1 / std::sqrt(3.0);
        for (const int shell : {0, 1}) {
            // Mean distance from the centre over a shell a < r < b: 3/4 (b^4 - a^4) / (b^3 - a^3).
            const double inner = (1 + 14 * shell) / 29.0, outer = (15 + 14 * shell) / 29.0;
            const double radius =
                v.radius * 0.75 * (std::pow(outer, 4.0 / 3) - std::pow(inner, 4.0 / 3)) / (outer - inner);
            for (const double sign : {-1.0, 1.0}) {
                for (std::size_t a = 0; a < 3; ++a) {
                    point x = v.position;
                    x[a] += sign * radius;
                    visit(x);
                }
                for (const double j : {-1.0, 1.0}) {
                    for (const double k : {-1.0, 1.0}) {
                        const double r = radius * corner;
                        visit(point{v.position[0] + sign * r, v.position[1] + j * r, v.position[2] + k * r});
                    }
                }
            }
        }
    }
};

/// The default: a cell is filled to the degree  clamp(1/2 - (s - max(R, h/2)) / w, 0, 1),  w = 1.25 clamp(2R, 0.3 h,
/// h), s the distance of the cell's centre from the particle's and h the chord of the cell's ellipsoid along it.  The
/// shares are in proportion to that times V / (V + (2R)^3).  The axes of the ellipsoid are the extents of the cell;
/// where their box is larger than the cell, as with polyhedra, it is shrunk to the volume of the cell.
///
/// So cells smaller than the particle get the volume that it fills in them, to first order in h / R.  A particle
/// smaller than its cell is shared while it passes a face, about where it overlaps with both sides, in equal parts when
/// it is on the face, however much larger one of the cells is.  Shares are continuous in the particle's position at
/// every ratio of sizes; the slope is at most 3 / h.  Where no cell would be filled to 1/2 (a small particle near an
/// edge, or cells that their extents do not cover, as polyhedra), s/h is lowered by the same amount for all cells until
/// one is, which is continuous too: the sum of all degrees never vanishes.  (Where even the nearest cell is more
/// than 1.8 of its extents away, the host's extents are wrong: its find_cell decides.)
///
/// Outside the mesh is a particle whose centre is in the box of no cell, if find_cell finds none for it either.
struct ramp {
    /// w where R > h/2, in chords.  1 is nearest to the overlap itself.  A little more also damps the waves of two
    /// cells' length that a discrete kernel afterwards damps too little (its rate there is 4/h^2 instead of pi^2/h^2):
    /// on six random beds the error of the filtered fraction is two thirds of that with 1 at d/h = 1 to 2.
    static constexpr double width = 1.25;
    /// w is no less than this, in widths.
    static constexpr double narrowest = 0.3;

    template <class Locator, class Visit>
    sighting for_each_weight(const Locator& locator, const visitor& v, Visit&& visit) const {
        sighting seen{false, std::numeric_limits<double>::infinity()};
        const auto glance = [&](std::int32_t cell, const point& offset, const point& extent) {
            const place at(offset, extent, locator.graph().volume(cell), v.radius);
            seen.nearest = std::min(seen.nearest, at.depth);
            seen.inside = seen.inside || at.in_box;
            return at;
        };
        const double cube = cube_of(v);
        locator.for_each_near(
            v.position, v.radius, 0.5 + reach, [&](std::int32_t cell, const point& offset, const point& extent) {
                fill(glance(cell, offset, extent), 0, cell, locator.graph().volume(cell), cube, visit);
            });
        if (seen.nearest > reach) locator.for_each_near(v.position, v.radius, 1, glance);
        if (seen.nearest > deepest_in_box) locator.for_each_near(v.position, v.radius, Locator::widest, glance);
        if (!seen.inside) seen.inside = locator.find(v.position) >= 0;
        return seen;
    }

    template <class Locator, class Visit>
    void for_each_far_weight(const Locator& locator, const visitor& v, double nearest, Visit&& visit) const {
        if (nearest > deepest_sought) {
            centre{}.for_each_weight(locator, v, visit);
            return;
        }
        const double cube = cube_of(v);
        locator.for_each_near(v.position, v.radius, 0.5 + reach + nearest,
                              [&](std::int32_t cell, const point& offset, const point& extent) {
                                  const double volume = locator.graph().volume(cell);
                                  fill(place(offset, extent, volume, v.radius), nearest, cell, volume, cube, visit);
                              });
    }

  private:
    /// No cell is filled whose centre is further away than R + (1/2 + reach) of its extents, nor deeper than this:
    /// s < h/2 + w/2 = R + (1/2 + narrowest width / 2) h at most, if R < h/2; else s < R + width h / 2, which is less.
    static constexpr double reach = 0.5 * narrowest * width;
    static constexpr double deepest_in_box = 0.3661;  ///< of a tiny particle in the corner of a box: (sqrt(3) - 1) / 2
    /// A cell this deep is 1.8 extents away; lowered by that, all that get a share are within `widest`.
    static constexpr double deepest_sought = 1.3;
    /// A corner of a box that was shrunk by this is no deeper than `deepest_sought`: s/h is sqrt(3).  A tetrahedron of
    /// six that make a cube takes 6^(1/3); an oblique thin layer would take more, and is taken for thicker.
    static constexpr double most_shrunk = 2;

    static double cube_of(const visitor& v) { return 8 * v.radius * v.radius * v.radius; }

    /// Where a cell's centre is, seen from a particle.
    struct place {
        place(const point& offset, const point& extent, double volume, double radius) {
            const double box = extent[0] * extent[1] * extent[2];
            const double shrink = volume < 0.999 * box ? std::min(std::cbrt(box / volume), most_shrunk) : 1.0;
            double distance2 = 0, chords2 = 0, curvature = 0, largest = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                const double per_extent = shrink / extent[a];
                const double along = offset[a] * per_extent;
                distance2 += offset[a] * offset[a];
                chords2 += along * along;
                curvature += per_extent * per_extent;
                largest = std::max(largest, std::abs(along));
            }
            // R/h.  Where s vanishes the chord must be the same along all directions: a quarter radius blends.
            const double blend2 = radius * radius / 16;
            const double radius_in_chords =
                radius * std::sqrt((chords2 + blend2 * curvature / 3) / (distance2 + blend2));
            depth = std::sqrt(chords2) - std::max(radius_in_chords, 0.5);
            width = ramp::width * std::clamp(2 * radius_in_chords, narrowest, 1.0);
            in_box = largest <= 0.5 * shrink * (1 + 1e-12);  // on a face: in both cells
        }

        double depth;  ///< distance of the cell's centre from the particle's surface, in chords; negative inside
        double width;  ///< of the ramp, in chords
        bool in_box;   ///< the particle's centre is in the cell's box
    };

    template <class Visit>
    static void fill(const place& at, double lowered, std::int32_t cell, double volume, double cube, Visit& visit) {
        const double filled = std::min(0.5 - (at.depth - lowered) / at.width, 1.0);
        if (filled > 0) visit(cell, filled * (volume / (volume + cube)));
    }
};

}  // namespace hearth::deposit

namespace hearth {

/// What a deposit did, over all ranks.
struct deposit_report {
    std::int64_t particles = 0;
    double solid_volume = 0;  ///< of all particles [m^3]
    double maximum = 0;       ///< largest solid fraction [-]; above 1 where particles are larger than cells
};

/// Adds up the solid volume in each owned cell [m^3].
template <class Communicator>
std::vector<double> solid_volumes(const footprints<Communicator>& particles, std::int32_t cell_count) {
    std::vector<double> at_visitors, cells(static_cast<std::size_t>(cell_count), 0.0);
    at_visitors.reserve(particles.visitors().size());
    for (const visitor& v : particles.visitors()) at_visitors.push_back(v.volume());
    particles.scatter(at_visitors, cells.data());
    return cells;
}

/// Count and volume of all particles.
template <class Communicator>
deposit_report count_particles(const visitors<Communicator>& particles) {
    double largest = 0;
    for (std::size_t i = 0; i < particles.owned_count(); ++i) largest = std::max(largest, particles.owned(i).volume());
    largest = particles.communicator().max(largest);
    reproducible_sum volume(largest > 0 ? largest : 1.0, std::int64_t{1} << 36);
    for (std::size_t i = 0; i < particles.owned_count(); ++i) volume.add(particles.owned(i).volume());
    particles.communicator().sum(volume.limbs(), reproducible_sum::limb_count());
    auto count = static_cast<std::int64_t>(particles.owned_count());
    particles.communicator().sum(&count, 1);
    return {count, volume.value(), 0};
}

/// Volume-weighted mean radius of all particles [m]; 0 where there are none.
template <class Communicator>
double mean_radius(const visitors<Communicator>& particles) {
    double largest = 0;
    for (std::size_t i = 0; i < particles.owned_count(); ++i) largest = std::max(largest, particles.owned(i).radius);
    largest = particles.communicator().max(largest);
    if (largest == 0) return 0;
    reproducible_sum weight(1.0, std::int64_t{1} << 36), weighted = weight;
    for (std::size_t i = 0; i < particles.owned_count(); ++i) {
        const double relative = particles.owned(i).radius / largest, cube = relative * relative * relative;
        weight.add(cube);
        weighted.add(cube * relative);
    }
    particles.communicator().sum(weight.limbs(), reproducible_sum::limb_count());
    particles.communicator().sum(weighted.limbs(), reproducible_sum::limb_count());
    return largest * (weighted.value() / weight.value());
}

/// Sets the solid fraction [-] of every owned cell from the particles' volumes, unsmoothed: fractions above 1 are
/// normal for particles larger than a cell (see filtered_fraction.hpp for the void fraction that closures need).
/// Errors: those of footprints; stale_graph.  The field is then as it was.
template <class Mesh, class Communicator, class Cloud, class Field, class Policy = deposit::ramp>
deposit_report deposit_solid_fraction(const cell_locator<Mesh, Communicator>& locator, const Cloud& cloud,
                                      Field& solid_fraction, const Policy& policy = {}) {
    const cell_graph<Communicator>& graph = locator.graph();
    graph.require_current();
    const footprints<Communicator> particles(locator, cloud, policy);
    const std::vector<double> volumes = solid_volumes(particles, graph.cell_count());
    deposit_report report = count_particles(particles.visitors());
    for (std::int32_t c = 0; c < graph.cell_count(); ++c) {
        const double fraction = volumes[static_cast<std::size_t>(c)] / graph.volume(c);
        report.maximum = std::max(report.maximum, fraction);
        auto&& target = element(solid_fraction, c);
        target = static_cast<std::decay_t<decltype(target)>>(fraction);
    }
    report.maximum = graph.communicator().max(report.maximum);
    return report;
}

}  // namespace hearth
