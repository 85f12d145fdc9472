// SPDX-License-Identifier: MIT
#include <cmath>

#include <hearth/core/error.hpp>

#include <hearth/dem/wall.hpp>

namespace hearth::dem {

/// Closest point by the region of the triangle's plane that the foot lies in: corner, edge or face.
/// Ericson, Real-Time Collision Detection (2005), section 5.1.5.
vector3 triangle::closest(const vector3& x) const {
    const vector3 ab = b - a, ac = c - a, ax = x - a;
    const double d1 = dot(ab, ax), d2 = dot(ac, ax);
    if (d1 <= 0 && d2 <= 0) return a;
    const vector3 bx = x - b;
    const double d3 = dot(ab, bx), d4 = dot(ac, bx);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
    const vector3 cx = x - c;
    const double d5 = dot(ab, cx), d6 = dot(ac, cx);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
    const double scale = 1 / (va + vb + vc);
    return a + (vb * scale) * ab + (vc * scale) * ac;
}

namespace shape {
namespace {

double positive(const char* name, double value, bool zero_too = false) {
    if (!(std::isfinite(value) && (value > 0 || (zero_too && value == 0))))
        throw bad_value(name, bad_value::no_index, value, zero_too ? "finite and >= 0 [m]" : "finite and > 0 [m]");
    return value;
}

vector3 direction(const char* name, const vector3& d) {
    if (!(is_finite(d) && norm(d) > 0)) throw bad_value(name, bad_value::no_index, norm(d), "finite, of a length > 0");
    return unit(d);
}

std::vector<facet> frustum(const vector3& base, const vector3& top, double base_radius, double top_radius) {
    const vector3 axis = direction("axis of wall", top - base);
    return {swept{base, axis, 0, base_radius, norm(top - base), top_radius}};
}

}  // namespace

std::vector<facet> plane(const vector3& point, const vector3& normal) {
    return {dem::plane{point, direction("normal of wall", normal)}};
}

std::vector<facet> cylinder(const vector3& base, const vector3& top, double radius) {
    positive("radius of cylinder", radius);
    return frustum(base, top, radius, radius);
}

std::vector<facet> cone(const vector3& base, const vector3& top, double base_radius, double top_radius) {
    positive("radius of cone", base_radius, true);
    positive("radius of cone", top_radius, true);
    positive("larger radius of cone", std::fmax(base_radius, top_radius));
    return frustum(base, top, base_radius, top_radius);
}

std::vector<facet> disc(const vector3& centre, const vector3& normal, double radius,
                        const std::vector<perforated_disc::hole>& holes) {
    const vector3 n = direction("normal of disc", normal);
    positive("radius of disc", radius);
    for (std::size_t h = 0; h < holes.size(); ++h) {
        positive("radius of hole", holes[h].radius);
        const vector3 out = holes[h].centre - centre;
        if (std::fabs(dot(out, n)) > 1e-9 * radius || norm(out) + holes[h].radius > radius)
            throw bad_value("distance from the disc's centre of hole", static_cast<std::int64_t>(h), norm(out),
                            "in the disc's plane and inside of its rim [m]");
        for (std::size_t g = 0; g < h; ++g) {
            const double apart = norm(holes[g].centre - holes[h].centre);
            if (apart < holes[g].radius + holes[h].radius)
                throw bad_value("distance to another hole of hole", static_cast<std::int64_t>(h), apart,
                                "at least the sum of the radii [m]");
        }
    }
    return {perforated_disc{centre, n, radius, holes}};
}

std::vector<facet> tube(const vector3& base, const vector3& top, double inner_radius, double outer_radius) {
    positive("inner radius of tube", inner_radius);
    positive("thickness of tube", outer_radius - inner_radius);
    const vector3 axis = direction("axis of tube", top - base);
    const double length = norm(top - base);
    return {swept{base, axis, 0, inner_radius, length, inner_radius},
            swept{base, axis, length, inner_radius, length, outer_radius},
            swept{base, axis, length, outer_radius, 0, outer_radius},
            swept{base, axis, 0, outer_radius, 0, inner_radius}};
}

std::vector<facet> box(const vector3& low, const vector3& high) {
    for (int a = 0; a < 3; ++a) positive("length of box", high[a] - low[a]);
    const auto corner = [&](int k) {
        return vector3{k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z};
    };
    static constexpr int sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    std::vector<facet> facets;
    for (const auto& s : sides) {
        facets.push_back(triangle{corner(s[0]), corner(s[1]), corner(s[2])});
        facets.push_back(triangle{corner(s[0]), corner(s[2]), corner(s[3])});
    }
    return facets;
}

}  // namespace shape
}  // namespace hearth::dem
