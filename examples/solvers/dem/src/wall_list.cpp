// SPDX-License-Identifier: MIT
#include "wall_list.hpp"

#include <algorithm>
#include <limits>

namespace hearth::dem::detail {
namespace {

/// Box in space around a box of the body.
box3 in_space(const box3& box, const pose& place) {
    if (!place.moved) return box;
    const vector3 middle = 0.5 * box.low + 0.5 * box.high, half = 0.5 * box.high - 0.5 * box.low;
    const vector3 centre = place.to_space(middle);
    box3 out;
    for (int a = 0; a < 3; ++a) {
        const vector3& row = place.rows[static_cast<std::size_t>(a)];
        const double wide = std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
        out.low[a] = centre[a] - wide;
        out.high[a] = centre[a] + wide;
    }
    return out;
}

}  // namespace

void wall_list::advance(double step) {
    if (!moves() || body.conveys) return;
    place.moved = true;
    wall_motion& m = body.motion;
    const double rate = norm(m.spin);
    vector3 arm = place.shift - m.pivot;
    if (rate > 0) {
        const vector3 axis = (1 / rate) * m.spin;
        const double c = std::cos(rate * step), s = std::sin(rate * step);
        const auto turned = [&](const vector3& v) {
            return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
        };
        arm = turned(arm);
        // Columns of the matrix are the body's axes; made orthogonal again each time, so that the shape never drifts.
        auto& r = place.rows;
        const vector3 x = unit(turned({r[0].x, r[1].x, r[2].x}));
        vector3 y = turned({r[0].y, r[1].y, r[2].y});
        y = unit(y - dot(x, y) * x);
        const vector3 z = cross(x, y);
        r = {vector3{x.x, y.x, z.x}, vector3{x.y, y.y, z.y}, vector3{x.z, y.z, z.z}};
    }
    m.pivot += step * m.velocity;
    place.shift = m.pivot + arm;
}

double wall_list::speed_in(const box3& box) const {
    if (!moves() || body.conveys) return 0;
    double far = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const vector3 p{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                        corner & 4 ? box.high.z : box.low.z};
        far = std::fmax(far, norm(p - body.motion.pivot));
    }
    return norm(body.motion.velocity) + norm(body.motion.spin) * far;
}

void wall_list::build(const store& particles, const cell_grid& grid, const std::vector<index>& start,
                      double largest_radius, double reach, const history& past, const std::vector<index>& old_place,
                      bool rolling) {
    candidates.clear();
    springs.clear();
    rolls.clear();
    reaction = {};
    if (open) return;
    const double wide = largest_radius + reach;
    for (std::size_t f = 0; f < body.facets.size(); ++f) {
        const box3 box = in_space(bounds_of(body.facets[f]), place);
        for (index z = grid.along(2, box.low.z - wide); z <= grid.along(2, box.high.z + wide); ++z) {
            for (index y = grid.along(1, box.low.y - wide); y <= grid.along(1, box.high.y + wide); ++y) {
                const index x0 = grid.along(0, box.low.x - wide), x1 = grid.along(0, box.high.x + wide);
                const index begin = start[static_cast<std::size_t>(grid.number(x0, y, z))];
                const index end = start[static_cast<std::size_t>(grid.number(x1, y, z)) + 1];
                for (index i = begin; i < end; ++i) {
                    const sphere& s = particles.spheres[static_cast<std::size_t>(i)];
                    const vector3 d = s.centre - closest(static_cast<index>(f), s.centre);
                    const double limit = s.radius + reach;
                    if (dot(d, d) < limit * limit) candidates.push_back({i, static_cast<index>(f)});
                }
            }
        }
    }
    if (body.facets.size() > 1) {
        std::sort(candidates.begin(), candidates.end(), [](const candidate& a, const candidate& b) {
            return a.particle != b.particle ? a.particle < b.particle : a.facet < b.facet;
        });
    }
    springs.resize(candidates.size());
    if (rolling) rolls.resize(candidates.size());
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const index old = old_place[static_cast<std::size_t>(candidates[k].particle)];
        past.find(old, first_id - candidates[k].facet, springs[k], rolling ? &rolls[k] : nullptr);
    }
}

void wall_list::find_touches(const sphere* spheres, std::vector<touch>& touches) const {
    std::size_t group = touches.size();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const sphere& s = spheres[candidates[k].particle];
        const vector3 foot = closest(candidates[k].facet, s.centre);
        const vector3 d = s.centre - foot;
        const double d2 = dot(d, d);
        if (d2 < s.radius * s.radius) touches.push_back({k, foot, d2});
        const bool last = k + 1 == candidates.size() || candidates[k + 1].particle != candidates[k].particle;
        if (!last) continue;
        if (touches.size() > group + 1) drop_shared(s, touches, group);
        group = touches.size();
    }
}

/// Of contacts of one particle, keeps those whose foot does not lie on a facet that is closer: elsewhere the foot is no
/// closest point of the wall.
void wall_list::drop_shared(const sphere& s, std::vector<touch>& touches, std::size_t first) const {
    const auto begin = touches.begin() + static_cast<std::ptrdiff_t>(first);
    std::stable_sort(begin, touches.end(),
                     [](const touch& a, const touch& b) { return a.squared_distance < b.squared_distance; });
    const double near = 1e-6 * s.radius;  // a foot on a shared edge is the same point but for rounding
    for (auto t = touches.end(); t-- != begin;) {
        const bool shared = std::any_of(begin, t, [&](const touch& closer) {
            const vector3 gap = t->foot - closest(candidates[closer.candidate].facet, t->foot);
            return dot(gap, gap) < near * near;
        });
        if (shared) touches.erase(t);
    }
    std::sort(begin, touches.end(), [](const touch& a, const touch& b) { return a.candidate < b.candidate; });
}

}  // namespace hearth::dem::detail
