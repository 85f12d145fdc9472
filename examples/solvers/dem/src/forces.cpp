// SPDX-License-Identifier: MIT
#include "forces.hpp"

#include <cmath>
#include <memory>

#include "contact_batch.hpp"

namespace hearth::dem::detail {
namespace {

template <bool Rolling>
void stage_body(contact_batch<Rolling>& b, int k, const vector3& d, const vector3& v, const vector3& spring) {
    b.dx[k] = d.x;
    b.dy[k] = d.y;
    b.dz[k] = d.z;
    b.vx[k] = v.x;
    b.vy[k] = v.y;
    b.vz[k] = v.z;
    b.sx[k] = spring.x;
    b.sy[k] = spring.y;
    b.sz[k] = spring.z;
}

template <bool Rolling>
void stage_spin_i(contact_batch<Rolling>& b, int k, const vector3& w) {
    b.wix[k] = w.x;
    b.wiy[k] = w.y;
    b.wiz[k] = w.z;
}

/// What accelerations add in half a step, against a wall and to one another.
template <bool Rolling>
void stage_lead(contact_batch<Rolling>& b, int k, const lead& a, double radius) {
    b.ax[k] = double(a.velocity[0]);
    b.ay[k] = double(a.velocity[1]);
    b.az[k] = double(a.velocity[2]);
    b.bx[k] = radius * double(a.spin[0]);
    b.by[k] = radius * double(a.spin[1]);
    b.bz[k] = radius * double(a.spin[2]);
}
template <bool Rolling>
void stage_lead(contact_batch<Rolling>& b, int k, const lead& i, const lead& j, double radius_i, double radius_j) {
    b.ax[k] = double(i.velocity[0]) - double(j.velocity[0]);
    b.ay[k] = double(i.velocity[1]) - double(j.velocity[1]);
    b.az[k] = double(i.velocity[2]) - double(j.velocity[2]);
    b.bx[k] = radius_i * double(i.spin[0]) + radius_j * double(j.spin[0]);
    b.by[k] = radius_i * double(i.spin[1]) + radius_j * double(j.spin[1]);
    b.bz[k] = radius_i * double(i.spin[2]) + radius_j * double(j.spin[2]);
}

template <bool Rolling>
void stage_roll(contact_batch<Rolling>& b, int k, const std::vector<vector3>& rolls, std::size_t at) {
    if constexpr (Rolling) {
        b.rolling.rx[k] = rolls[at].x;
        b.rolling.ry[k] = rolls[at].y;
        b.rolling.rz[k] = rolls[at].z;
    }
}

/// Springs back to the list, force and torque to the first body.  Returns the force.
template <bool Rolling>
vector3 finish_first(contact_batch<Rolling>& b, int k, load& first, vector3& spring, std::vector<vector3>& rolls,
                     std::size_t at) {
    spring = {b.sx[k], b.sy[k], b.sz[k]};
    const vector3 force{b.fx[k], b.fy[k], b.fz[k]};
    first.force += force;
    first.torque -= b.lever_i[k] * vector3{b.qx[k], b.qy[k], b.qz[k]};
    if constexpr (Rolling) {
        const auto& r = b.rolling;
        rolls[at] = {r.rx[k], r.ry[k], r.rz[k]};
        first.torque += vector3{r.tx[k], r.ty[k], r.tz[k]};
    }
    return force;
}

template <bool Rolling, slip_rule Rule>
std::ptrdiff_t pair_forces(const contact_law& law, double step, double deepest, store& particles, pair_list& list) {
    using batch_type = contact_batch<Rolling>;
    constexpr std::size_t chunk = 1024;
    batch_type batch;
    std::uint32_t touching[chunk], apart[chunk];
    const sphere* const spheres = particles.spheres.data();
    const motion* const motions = particles.motions.data();
    load* const loads = particles.loads.data();
    const lead* const leads = particles.leads.data();
    const bed::pair* const pairs = list.pairs.data();
    vector3* const springs = list.springs.data();
    std::ptrdiff_t too_deep = -1;

    for (std::size_t begin = 0; begin < list.pairs.size(); begin += chunk) {
        const std::size_t end = std::min(begin + chunk, list.pairs.size());
        std::size_t touch_count = 0, apart_count = 0;
        for (std::size_t p = begin; p < end; ++p) {  // without a branch: nobody can foretell who touches
            const sphere &a = spheres[pairs[p].i], &b = spheres[pairs[p].j];
            const vector3 d = a.centre - b.centre;
            const double d2 = dot(d, d), sum = a.radius + b.radius;
            const double least = sum - deepest * (a.radius < b.radius ? a.radius : b.radius);
            const bool touches = d2 < sum * sum;
            const index farther = std::max(pairs[p].i, pairs[p].j);
            __builtin_prefetch(motions + farther);
            __builtin_prefetch(loads + farther);
            __builtin_prefetch(leads + farther);
            touching[touch_count] = static_cast<std::uint32_t>(p);
            apart[apart_count] = static_cast<std::uint32_t>(p);
            touch_count += touches;
            apart_count += !touches;
            too_deep = d2 < least * least ? static_cast<std::ptrdiff_t>(p) : too_deep;
        }
        for (std::size_t k = 0; k < apart_count; ++k) springs[apart[k]] = {};
        if constexpr (Rolling) {
            for (std::size_t k = 0; k < apart_count; ++k) list.rolls[apart[k]] = {};
        }
        for (std::size_t first = 0; first < touch_count; first += batch_type::lanes) {
            const int count = static_cast<int>(std::min<std::size_t>(batch_type::lanes, touch_count - first));
            for (int k = 0; k < count; ++k) {
                const std::size_t p = touching[first + static_cast<std::size_t>(k)];
                const index i = pairs[p].i, j = pairs[p].j;
                const motion &mi = motions[i], &mj = motions[j];
                stage_body(batch, k, spheres[i].centre - spheres[j].centre, mi.velocity - mj.velocity, springs[p]);
                batch.radius_i[k] = spheres[i].radius;
                batch.radius_j[k] = spheres[j].radius;
                batch.inverse_mass[k] = std::fabs(mi.inverse_mass) + std::fabs(mj.inverse_mass);
                stage_spin_i(batch, k, mi.spin);
                batch.wjx[k] = mj.spin.x;
                batch.wjy[k] = mj.spin.y;
                batch.wjz[k] = mj.spin.z;
                stage_lead(batch, k, leads[i], leads[j], spheres[i].radius, spheres[j].radius);
                stage_roll(batch, k, list.rolls, p);
            }
            batch.template compute<false, Rule>(law, step);
            for (int k = 0; k < count; ++k) {
                const std::size_t p = touching[first + static_cast<std::size_t>(k)];
                load& second = loads[pairs[p].j];
                second.force -= finish_first(batch, k, loads[pairs[p].i], springs[p], list.rolls, p);
                second.torque -= batch.lever_j[k] * vector3{batch.qx[k], batch.qy[k], batch.qz[k]};
                if constexpr (Rolling) {
                    second.torque -= vector3{batch.rolling.tx[k], batch.rolling.ty[k], batch.rolling.tz[k]};
                }
            }
        }
    }
    return too_deep;
}

template <bool Rolling, slip_rule Rule>
std::ptrdiff_t wall_forces(const contact_law& law, double step, double deepest, store& particles, wall_list& list) {
    contact_batch<Rolling> batch;
    std::vector<wall_list::touch>& touches = list.touches;
    touches.clear();
    list.find_touches(particles.spheres.data(), touches);
    list.reaction = {};
    std::ptrdiff_t too_deep = -1;

    // A contact that rolls on to the next facet of its wall takes its spring along; springs of lost contacts end.
    std::size_t next = 0;
    for (std::size_t begin = 0; begin < list.candidates.size();) {
        const index i = list.candidates[begin].particle;
        std::size_t end = begin;
        while (end < list.candidates.size() && list.candidates[end].particle == i) ++end;
        vector3 orphan, orphan_roll;
        const std::size_t first_touch = next;
        for (std::size_t c = begin; c < end; ++c) {
            if (next < touches.size() && touches[next].candidate == c) {
                ++next;
                continue;
            }
            if (dot(list.springs[c], list.springs[c]) > 0) {
                orphan = list.springs[c];
                if constexpr (Rolling) orphan_roll = list.rolls[c];
            }
            list.springs[c] = {};
            if constexpr (Rolling) list.rolls[c] = {};
        }
        if (dot(orphan, orphan) > 0) {
            for (std::size_t t = first_touch; t < next; ++t) {
                vector3& spring = list.springs[touches[t].candidate];
                if (dot(spring, spring) > 0) continue;
                spring = orphan;
                if constexpr (Rolling) list.rolls[touches[t].candidate] = orphan_roll;
                break;
            }
        }
        begin = end;
    }

    constexpr std::size_t lanes = contact_batch<Rolling>::lanes;
    for (std::size_t first = 0; first < touches.size(); first += lanes) {
        const int count = static_cast<int>(std::min(lanes, touches.size() - first));
        for (int k = 0; k < count; ++k) {
            const wall_list::touch& t = touches[first + static_cast<std::size_t>(k)];
            const index i = list.candidates[t.candidate].particle;
            const sphere& s = particles.spheres[static_cast<std::size_t>(i)];
            const motion& m = particles.motions[static_cast<std::size_t>(i)];
            if (t.squared_distance < (1 - deepest) * (1 - deepest) * s.radius * s.radius) {
                too_deep = static_cast<std::ptrdiff_t>(t.candidate);
            }
            stage_body(batch, k, s.centre - t.foot, m.velocity - list.velocity_at(t.foot), list.springs[t.candidate]);
            batch.radius_i[k] = s.radius;
            batch.inverse_mass[k] = std::fabs(m.inverse_mass);
            stage_spin_i(batch, k, m.spin);
            stage_lead(batch, k, particles.leads[static_cast<std::size_t>(i)], s.radius);
            stage_roll(batch, k, list.rolls, t.candidate);
        }
        batch.template compute<true, Rule>(law, step);
        for (int k = 0; k < count; ++k) {
            const std::size_t c = touches[first + static_cast<std::size_t>(k)].candidate;
            load& pushed = particles.loads[static_cast<std::size_t>(list.candidates[c].particle)];
            list.reaction -= finish_first(batch, k, pushed, list.springs[c], list.rolls, c);
        }
    }
    return too_deep;
}

}  // namespace

std::ptrdiff_t add_pair_forces(const contact_law& law, double step, double deepest, store& particles, pair_list& list) {
    const bool rolls = law.settings.rolling_friction > 0;
    if (law.settings.rule == slip_rule::paper) {
        return rolls ? pair_forces<true, slip_rule::paper>(law, step, deepest, particles, list)
                     : pair_forces<false, slip_rule::paper>(law, step, deepest, particles, list);
    }
    return rolls ? pair_forces<true, slip_rule::shorten>(law, step, deepest, particles, list)
                 : pair_forces<false, slip_rule::shorten>(law, step, deepest, particles, list);
}

std::ptrdiff_t add_wall_forces(const contact_law& law, double step, double deepest, store& particles, wall_list& list) {
    const bool rolls = law.settings.rolling_friction > 0;
    if (law.settings.rule == slip_rule::paper) {
        return rolls ? wall_forces<true, slip_rule::paper>(law, step, deepest, particles, list)
                     : wall_forces<false, slip_rule::paper>(law, step, deepest, particles, list);
    }
    return rolls ? wall_forces<true, slip_rule::shorten>(law, step, deepest, particles, list)
                 : wall_forces<false, slip_rule::shorten>(law, step, deepest, particles, list);
}

}  // namespace hearth::dem::detail
