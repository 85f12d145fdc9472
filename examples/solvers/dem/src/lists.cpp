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

detail::history bed::implementation::remember(bool to_go) const {
    detail::history past(rolling);
    past.start(particles.owned);
    const auto owned = static_cast<index>(particles.owned);
    const auto each = [&](auto&& use) {
        for (std::size_t p = 0; p < pairs.pairs.size(); ++p) {
            const vector3& s = pairs.springs[p];
            const vector3* const roll = at_if_any(pairs.rolls, p);
            if (dot(s, s) > 0 || (roll && dot(*roll, *roll) > 0)) {
                const auto [i, j] = pairs.pairs[p];
                if (i < owned) use(i, particles.ids[static_cast<std::size_t>(j)], s, roll);
                if (j < owned && to_go) use(j, particles.ids[static_cast<std::size_t>(i)], s, roll);
            }
        }
        for (const auto& w : walls) {
            for (std::size_t c = 0; c < w.candidates.size(); ++c) {
                const vector3& s = w.springs[c];
                const vector3* const roll = at_if_any(w.rolls, c);
                if (dot(s, s) > 0 || (roll && dot(*roll, *roll) > 0)) {
                    use(w.candidates[c].particle, w.first_id - w.candidates[c].facet, s, roll);
                }
            }
        }
    };
    each([&](index i, std::int64_t, const vector3&, const vector3*) { past.reserve(i); });
    past.begin_filling();
    each([&](index i, std::int64_t partner, const vector3& spring, const vector3* roll) {
        past.put(i, {partner, spring}, roll);
    });
    past.end_filling();
    return past;
}

std::vector<index> bed::implementation::everyone() const {
    std::vector<index> all(particles.owned);
    std::iota(all.begin(), all.end(), 0);
    return all;
}

void bed::implementation::rebuild(detail::history past, std::vector<index> kept) {
    build_lists(std::move(past), std::move(kept));
    particles.built.resize(particles.owned);
    for (std::size_t i = 0; i < particles.owned; ++i) particles.built[i] = particles.spheres[i].centre;
    travelled = wall_travelled = 0;
    listed = true;
    ++rebuilds;
}

void bed::implementation::build_lists(detail::history past, std::vector<index> kept) {
    particles.drop_ghosts();
    if (shared) {
        particles.pushed = among->any(particles.pushed);
        if (particles.pushed) particles.outer_forces.resize(particles.owned);
        slabs.balance(particles, kept);
        slabs.migrate(particles, past, kept);
        ghosts.survey(particles, kept);
    }
    const auto at = [&](std::size_t k) -> const sphere& { return particles.spheres[static_cast<std::size_t>(kept[k])]; };
    constexpr double far = std::numeric_limits<double>::max();
    largest_radius = 0;
    smallest_radius = far;
    extent = {{far, far, far}, {-far, -far, -far}};
    for (std::size_t k = 0; k < kept.size(); ++k) {
        largest_radius = std::fmax(largest_radius, at(k).radius);
        smallest_radius = std::fmin(smallest_radius, at(k).radius);
        for (int a = 0; a < 3; ++a) {
            extent.low[a] = std::fmin(extent.low[a], at(k).centre[a]);
            extent.high[a] = std::fmax(extent.high[a], at(k).centre[a]);
        }
    }
    everybody = among->sum(static_cast<std::int64_t>(kept.size()));
    largest_radius = among->max(largest_radius);
    smallest_radius = everybody > 0 ? among->min(smallest_radius) : 0;
    for (int a = 0; a < 3; ++a) {
        extent.low[a] = everybody > 0 ? among->min(extent.low[a]) : 0;
        extent.high[a] = everybody > 0 ? among->max(extent.high[a]) : 0;
    }
    const double widest = 2 * largest_radius + reach();
    detail::sorted_cells cells{detail::cell_grid(kept.size(), extent, [&](std::size_t k) -> const vector3& { return at(k).centre; },
                                                 widest > 0 ? widest : 1.0, *among), {}, {}, {}};
    if (shared) cells.grid.narrow(slabs.axis(), ghosts.low() - widest, ghosts.high() + widest);

    std::vector<index> order;
    cells.grid.sort(kept.size(), [&](std::size_t k) -> const vector3& { return at(k).centre; }, order, cells.owned_start);
    cells.grid.sort_within_cells([&](index k) { return particles.ids[static_cast<std::size_t>(kept[static_cast<std::size_t>(k)])]; },
                                 order, cells.owned_start);
    for (index& o : order) o = kept[static_cast<std::size_t>(o)];
    append_missing(order, particles.owned);
    particles.reorder(order, kept.size());
    if (shared) add_ghosts(cells);
    build_pairs(pairs, particles, cells, reach(), past, order, rolling);
    for (auto& w : walls) {
        w.build(particles, cells.grid, cells.owned_start, largest_radius, reach(), past, order, rolling);
    }
    if (shared) ghosts.want(particles, pairs);
    ++revision;
}

/// Brings the ghosts and sorts those that owned particles may touch in among them.
void bed::implementation::add_ghosts(detail::sorted_cells& cells) {
    const double near = near_factor > 0 ? near_reach(near_factor) + reach() : 0.0;  // both may move by half the reach
    const std::vector<index> touching = ghosts.make(particles, largest_radius, reach(), near);
    if (touching.empty()) return;
    const auto id = [&](index i) { return particles.ids[static_cast<std::size_t>(i)]; };
    std::vector<index> order, start;
    cells.grid.sort(touching.size(),
                    [&](std::size_t k) -> const vector3& { return particles.spheres[static_cast<std::size_t>(touching[k])].centre; },
                    order, start);
    cells.start.push_back(0);
    index own = 0;
    std::size_t other = 0;
    for (std::size_t c = 0; c + 1 < start.size(); ++c) {
        for (; own < cells.owned_start[c + 1]; ++own) cells.members.push_back(own);
        for (; other < static_cast<std::size_t>(start[c + 1]); ++other)
            cells.members.push_back(touching[static_cast<std::size_t>(order[other])]);
        cells.start.push_back(static_cast<index>(cells.members.size()));
    }
    cells.grid.sort_within_cells(id, cells.members, cells.start);
}

/// Called after each move, with `travelled` a bound from the fastest particle; exact distances are taken only when the
/// bound is used up.
void bed::implementation::refresh_lists() {
    const double limit = 0.5 * reach();
    if (listed && travelled <= limit) return;
    if (listed) {
        double farthest = 0;
        for (std::size_t i = 0; i < particles.owned; ++i) {
            const vector3 d = particles.spheres[i].centre - particles.built[i];
            farthest = std::fmax(farthest, dot(d, d));
        }
        travelled = std::fmax(std::sqrt(among->max(farthest)), wall_travelled);
    }
    if (!listed || travelled > 0.9 * limit) rebuild(remember(shared), everyone());
}

void bed::implementation::add_forces(double step) {
    using namespace detail;
    const double deepest = settings.deepest_overlap;
    if (const auto p = add_pair_forces(law, step, deepest, particles, pairs); p >= 0) failure = too_deep(p);
    for (auto& w : walls) {
        if (const auto c = add_wall_forces(w.law, step, deepest, particles, w); c >= 0) failure = too_deep(w, c);
    }
    if (!shared && failure) raise_failure();  // ranks tell one another in the next step
}

void bed::implementation::raise_failure() {
    std::optional<motion_error> found;
    found.swap(failure);
    if (!among->any(found.has_value())) return;
    constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
    const std::vector<std::int64_t> ids = among->gather(std::vector<std::int64_t>{found ? found->id : none});
    const auto first = std::min_element(ids.begin(), ids.end());
    std::string text;
    if (first - ids.begin() == among->rank()) text = found->what();
    const std::vector<char> told = among->gather(std::vector<char>(text.begin(), text.end()));
    throw motion_error({told.begin(), told.end()}, *first);
}

void bed::implementation::find_deep(std::int64_t first_id) {
    const auto is_new = [&](index i) { return particles.ids[static_cast<std::size_t>(i)] >= first_id; };
    for (std::size_t p = 0; p < pairs.pairs.size(); ++p) {
        const auto [i, j] = pairs.pairs[p];
        if (!is_new(i) && !is_new(j)) continue;
        const sphere &a = particles.spheres[static_cast<std::size_t>(i)], &b = particles.spheres[static_cast<std::size_t>(j)];
        const double overlap = a.radius + b.radius - norm(a.centre - b.centre);
        if (overlap > settings.deepest_overlap * std::fmin(a.radius, b.radius)) failure = too_deep(static_cast<std::ptrdiff_t>(p));
    }
    std::vector<detail::wall_list::touch> touches;
    for (const auto& w : walls) {
        touches.clear();
        w.find_touches(particles.spheres.data(), touches);
        for (const auto& t : touches) {
            const index i = w.candidates[t.candidate].particle;
            const double radius = particles.spheres[static_cast<std::size_t>(i)].radius;
            if (is_new(i) && std::sqrt(t.squared_distance) < (1 - settings.deepest_overlap) * radius)
                failure = too_deep(w, static_cast<std::ptrdiff_t>(t.candidate));
        }
    }
}

motion_error bed::implementation::too_deep(std::ptrdiff_t pair) const {
    const auto [i, j] = pairs.pairs[static_cast<std::size_t>(pair)];
    const sphere &a = particles.spheres[static_cast<std::size_t>(i)], &b = particles.spheres[static_cast<std::size_t>(j)];
    const std::int64_t id = particles.ids[static_cast<std::size_t>(i)];
    std::ostringstream text;
    text << "hearth: particles " << id << " and " << particles.ids[static_cast<std::size_t>(j)] << " overlap by "
         << a.radius + b.radius - norm(a.centre - b.centre) << " m, allowed: " << settings.deepest_overlap
         << " of the smaller radius, " << std::fmin(a.radius, b.radius) << " m";
    return motion_error(text.str(), id);
}

motion_error bed::implementation::too_deep(const detail::wall_list& list, std::ptrdiff_t candidate) const {
    const auto i = static_cast<std::size_t>(list.candidates[static_cast<std::size_t>(candidate)].particle);
    std::ostringstream text;
    text << "hearth: particle " << particles.ids[i] << " at (" << particles.spheres[i].centre.x << ", "
         << particles.spheres[i].centre.y << ", " << particles.spheres[i].centre.z << ") m is deeper in the wall of patch "
         << list.body.patch << " than " << settings.deepest_overlap << " of its radius, " << particles.spheres[i].radius
         << " m";
    return motion_error(text.str(), particles.ids[i]);
}

}  // namespace hearth::dem
