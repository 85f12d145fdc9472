// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "forces.hpp"
#include "implementation.hpp"

namespace hearth::dem {
namespace {

const vector3* at_if_any(const std::vector<vector3>& values, std::size_t i) { return values.empty() ? nullptr : &values[i]; }

/// Completes what is left of a permutation of 0 ... n - 1.
void append_missing(std::vector<index>& order, std::size_t n) {
    if (order.size() == n) return;
    std::vector<bool> there(n, false);
    for (const index o : order) there[static_cast<std::size_t>(o)] = true;
    for (std::size_t i = 0; i < n; ++i)
        if (!there[i]) order.push_back(static_cast<index>(i));
}

}  // namespace

detail::history bed::implementation::remember() const {
    detail::history past(rolling);
    past.start(particles.owned);
    const auto each = [&](auto&& use) {
        for (std::size_t p = 0; p < pairs.pairs.size(); ++p) {
            const vector3& s = pairs.springs[p];
            const vector3* const roll = at_if_any(pairs.rolls, p);
            if (dot(s, s) > 0 || (roll && dot(*roll, *roll) > 0)) {
                const auto i = static_cast<std::size_t>(pairs.pairs[p].i), j = static_cast<std::size_t>(pairs.pairs[p].j);
                const double sign = particles.ids[i] < particles.ids[j] ? 1 : -1;
                use(pairs.pairs[p].i, particles.ids[j], sign, s, roll);
            }
        }
        for (const auto& w : walls) {
            for (std::size_t c = 0; c < w.candidates.size(); ++c) {
                const vector3& s = w.springs[c];
                const vector3* const roll = at_if_any(w.rolls, c);
                if (dot(s, s) > 0 || (roll && dot(*roll, *roll) > 0)) {
                    use(w.candidates[c].particle, w.first_id - w.candidates[c].facet, 1.0, s, roll);
                }
            }
        }
    };
    each([&](index i, std::int64_t, double, const vector3&, const vector3*) { past.reserve(i); });
    past.begin_filling();
    each([&](index i, std::int64_t partner, double sign, const vector3& spring, const vector3* roll) {
        const vector3 turned = roll ? sign * *roll : vector3{};
        past.put(i, {partner, sign * spring}, &turned);
    });
    past.end_filling();
    return past;
}

void bed::implementation::rebuild() {
    std::vector<index> everybody(particles.owned);
    std::iota(everybody.begin(), everybody.end(), 0);
    rebuild(everybody);
}

void bed::implementation::rebuild(const std::vector<index>& kept) {
    const detail::history past = remember();
    largest_radius = 0;
    smallest_radius = kept.empty() ? 0.0 : std::numeric_limits<double>::max();
    built.resize(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
        built[k] = particles.spheres[static_cast<std::size_t>(kept[k])];
        largest_radius = std::fmax(largest_radius, built[k].radius);
        smallest_radius = std::fmin(smallest_radius, built[k].radius);
    }
    const double widest = 2 * largest_radius + reach();
    detail::sorted_cells cells{detail::cell_grid(built.data(), built.size(), widest > 0 ? widest : 1.0), {}, {}};
    std::vector<index> order;
    cells.grid.sort(built.data(), built.size(), order, cells.owned_start);
    for (index& o : order) o = kept[static_cast<std::size_t>(o)];
    append_missing(order, particles.owned);
    particles.reorder(order, kept.size());
    built = particles.spheres;
    build_pairs(pairs, particles, cells, reach(), past, order, rolling);
    for (auto& w : walls) {
        w.build(particles, cells.grid, cells.owned_start, largest_radius, reach(), past, order, rolling);
    }
    extent = {{0, 0, 0}, {0, 0, 0}};
    for (std::size_t i = 0; i < particles.owned; ++i) {
        const vector3& x = particles.spheres[i].centre;
        if (i == 0) extent = {x, x};
        for (int a = 0; a < 3; ++a) {
            extent.low[a] = std::fmin(extent.low[a], x[a]);
            extent.high[a] = std::fmax(extent.high[a], x[a]);
        }
    }
    travelled = wall_travelled = 0;
    listed = true;
    ++revision;
    ++rebuilds;
}

/// Called after each move, with `travelled` a bound from the fastest particle; exact distances are taken only when the
/// bound is used up.
void bed::implementation::refresh_lists() {
    const double limit = 0.5 * reach();
    if (listed && travelled <= limit) return;
    if (listed) {
        double farthest = 0;
        for (std::size_t i = 0; i < particles.owned; ++i) {
            const vector3 d = particles.spheres[i].centre - built[i].centre;
            farthest = std::fmax(farthest, dot(d, d));
        }
        travelled = std::fmax(std::sqrt(farthest), wall_travelled);
    }
    if (!listed || travelled > 0.9 * limit) rebuild();
}

void bed::implementation::add_forces(double step) {
    using namespace detail;
    const double deepest = settings.deepest_overlap;
    if (const auto p = add_pair_forces(law, step, deepest, particles, pairs); p >= 0) refuse_pair(p);
    for (auto& w : walls) {
        if (const auto c = add_wall_forces(w.law, step, deepest, particles, w); c >= 0) refuse_touch(w, c);
    }
}

void bed::implementation::refuse_deep(std::int64_t first_id) const {
    const auto is_new = [&](index i) { return particles.ids[static_cast<std::size_t>(i)] >= first_id; };
    for (std::size_t p = 0; p < pairs.pairs.size(); ++p) {
        const auto [i, j] = pairs.pairs[p];
        if (!is_new(i) && !is_new(j)) continue;
        const sphere &a = particles.spheres[static_cast<std::size_t>(i)], &b = particles.spheres[static_cast<std::size_t>(j)];
        const double overlap = a.radius + b.radius - norm(a.centre - b.centre);
        if (overlap > settings.deepest_overlap * std::fmin(a.radius, b.radius)) refuse_pair(static_cast<std::ptrdiff_t>(p));
    }
    std::vector<detail::wall_list::touch> touches;
    for (const auto& w : walls) {
        touches.clear();
        w.find_touches(particles.spheres.data(), touches);
        for (const auto& t : touches) {
            const index i = w.candidates[t.candidate].particle;
            const double radius = particles.spheres[static_cast<std::size_t>(i)].radius;
            if (is_new(i) && std::sqrt(t.squared_distance) < (1 - settings.deepest_overlap) * radius)
                refuse_touch(w, static_cast<std::ptrdiff_t>(t.candidate));
        }
    }
}

void bed::implementation::refuse_pair(std::ptrdiff_t pair) const {
    const auto [i, j] = pairs.pairs[static_cast<std::size_t>(pair)];
    const sphere &a = particles.spheres[static_cast<std::size_t>(i)], &b = particles.spheres[static_cast<std::size_t>(j)];
    const std::int64_t id = particles.ids[static_cast<std::size_t>(i)];
    std::ostringstream text;
    text << "hearth: particles " << id << " and " << particles.ids[static_cast<std::size_t>(j)] << " overlap by "
         << a.radius + b.radius - norm(a.centre - b.centre) << " m, allowed: " << settings.deepest_overlap
         << " of the smaller radius, " << std::fmin(a.radius, b.radius) << " m";
    throw motion_error(text.str(), id);
}

void bed::implementation::refuse_touch(const detail::wall_list& list, std::ptrdiff_t candidate) const {
    const auto i = static_cast<std::size_t>(list.candidates[static_cast<std::size_t>(candidate)].particle);
    std::ostringstream text;
    text << "hearth: particle " << particles.ids[i] << " at (" << particles.spheres[i].centre.x << ", "
         << particles.spheres[i].centre.y << ", " << particles.spheres[i].centre.z << ") m is deeper in the wall of patch "
         << list.body.patch << " than " << settings.deepest_overlap << " of its radius, " << particles.spheres[i].radius
         << " m";
    throw motion_error(text.str(), particles.ids[i]);
}

}  // namespace hearth::dem
