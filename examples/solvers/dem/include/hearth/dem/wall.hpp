// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include <hearth/dem/contact_law.hpp>
#include <hearth/dem/facet.hpp>

namespace hearth::dem {

/// How a wall moves: its points have velocity + spin x (point - pivot), and the pivot goes along.
struct wall_motion {
    vector3 velocity{};  ///< [m/s]
    vector3 spin{};      ///< [rad/s]
    vector3 pivot{};     ///< [m]
};

/// A wall: facets of one material and one temperature.  Edges and corners that facets share count once: a particle
/// touches a facet only where the closest point does not lie on a closer facet of the same wall.
struct wall {
    std::vector<facet> facets;
    material body{};
    contact_settings contact{};
    int patch = 0;             ///< number that scenes know it by
    double temperature = 300;  ///< [K]
    wall_motion motion{};
    bool conveys = false;      ///< the surface moves, the shape stays: a belt
};

/// Shapes of walls.  Each throws bad_value for a size that is not finite and > 0, or a direction of no length.
/// Combine them by joining their facets.
namespace shape {

std::vector<facet> plane(const vector3& point, const vector3& normal);
/// Without ends, from base to top.
std::vector<facet> cylinder(const vector3& base, const vector3& top, double radius);
/// Frustum without ends; one of the radii may be 0.
std::vector<facet> cone(const vector3& base, const vector3& top, double base_radius, double top_radius);
std::vector<facet> disc(const vector3& centre, const vector3& normal, double radius,
                        const std::vector<perforated_disc::hole>& holes = {});
/// A pipe with a thick wall and flat ends, open inside.
std::vector<facet> tube(const vector3& base, const vector3& top, double inner_radius, double outer_radius);
/// Six sides, closed; particles may be inside or outside.
std::vector<facet> box(const vector3& low, const vector3& high);
/// Triangles of an STL file, text or binary; `scale` converts its unit to metres.  Throws std::runtime_error that names the
/// file and the place in it; triangles of no area are left out and counted in `degenerate`.
std::vector<facet> stl(const std::string& path, double scale = 1.0, std::size_t* degenerate = nullptr);

}  // namespace shape
}  // namespace hearth::dem
