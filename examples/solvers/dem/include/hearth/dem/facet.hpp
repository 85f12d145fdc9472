// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include <hearth/dem/vector3.hpp>

/// Pieces of wall.  Each tells the point of it that is closest to a given one; a particle touches it from either side.
namespace hearth::dem {

struct box3 {
    vector3 low, high;
};

/// An infinite plane.
struct plane {
    vector3 point;
    vector3 normal;  ///< of length 1

    vector3 closest(const vector3& x) const { return x - dot(x - point, normal) * normal; }
    box3 bounds() const {
        constexpr double far = std::numeric_limits<double>::max();
        box3 b{{-far, -far, -far}, {far, far, far}};
        for (int a = 0; a < 3; ++a)
            if (std::fabs(normal[a]) == 1.0) b.low[a] = b.high[a] = point[a];
        return b;
    }
};

/// What a straight line from (height_0, radius_0) to (height_1, radius_1) sweeps as it turns around an axis: a cylinder, a
/// cone, a disc or a ring.
struct swept {
    vector3 origin;
    vector3 axis;  ///< of length 1
    double height_0, radius_0, height_1, radius_1;

    vector3 closest(const vector3& x) const {
        const vector3 d = x - origin;
        const double h = dot(d, axis);
        vector3 radial = d - h * axis;
        const double r = norm(radial);
        radial = r > 0 ? (1 / r) * radial : across();
        const double dh = height_1 - height_0, dr = radius_1 - radius_0;
        const double t = std::fmin(
            1.0, std::fmax(0.0, ((h - height_0) * dh + (r - radius_0) * dr) / (dh * dh + dr * dr)));
        return origin + (height_0 + t * dh) * axis + (radius_0 + t * dr) * radial;
    }
    box3 bounds() const {
        box3 b;
        for (int a = 0; a < 3; ++a) {
            const double wide = std::sqrt(std::fmax(0.0, 1 - axis[a] * axis[a]));
            const double h0 = height_0 * axis[a], h1 = height_1 * axis[a], r0 = radius_0 * wide, r1 = radius_1 * wide;
            b.low[a] = origin[a] + std::fmin(h0 - r0, h1 - r1);
            b.high[a] = origin[a] + std::fmax(h0 + r0, h1 + r1);
        }
        return b;
    }
    /// Any direction across the axis.
    vector3 across() const {
        return unit(cross(axis, std::fabs(axis.x) < 0.5 ? vector3{1, 0, 0} : vector3{0, 1, 0}));
    }
};

/// A flat disc with round holes that do not overlap one another or the rim.
struct perforated_disc {
    struct hole {
        vector3 centre;  ///< in the disc's plane
        double radius;
    };
    vector3 centre;
    vector3 normal;  ///< of length 1
    double radius;
    std::vector<hole> holes;

    vector3 closest(const vector3& x) const {
        const vector3 foot = x - dot(x - centre, normal) * normal;
        const vector3 out = foot - centre;
        if (const double r = norm(out); r > radius) return centre + (radius / r) * out;
        for (const hole& h : holes) {
            const vector3 d = foot - h.centre;
            const double r = norm(d);
            if (r >= h.radius) continue;
            if (r > 0) return h.centre + (h.radius / r) * d;
            return h.centre + h.radius * swept{centre, normal, 0, 0, 0, 1}.across();
        }
        return foot;
    }
    box3 bounds() const { return swept{centre, normal, 0, 0, 0, radius}.bounds(); }
};

struct triangle {
    vector3 a, b, c;

    vector3 closest(const vector3& x) const;
    box3 bounds() const {
        box3 box;
        for (int k = 0; k < 3; ++k) {
            box.low[k] = std::fmin(a[k], std::fmin(b[k], c[k]));
            box.high[k] = std::fmax(a[k], std::fmax(b[k], c[k]));
        }
        return box;
    }
};

using facet = std::variant<plane, swept, perforated_disc, triangle>;

inline vector3 closest_point(const facet& f, const vector3& x) {
    return std::visit([&](const auto& shape) { return shape.closest(x); }, f);
}
inline box3 bounds_of(const facet& f) {
    return std::visit([](const auto& shape) { return shape.bounds(); }, f);
}

}  // namespace hearth::dem
