// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <sstream>

#include "implementation.hpp"

namespace hearth::dem {
namespace {

lead lead_of(const vector3& dv, const vector3& dw) {
    const auto narrow = [](double a) { return static_cast<float>(a); };
    return {{narrow(dv.x), narrow(dv.y), narrow(dv.z)}, {narrow(dw.x), narrow(dw.y), narrow(dw.z)}};
}

}  // namespace

/// Velocity Verlet.  Between two steps the second half of one kick and the first of the next are given in one pass, as two
/// separate sums, so that a run in parts equals a run in one go bit for bit.
template <bed::implementation::kick Which>
double bed::implementation::move() {
    const double step = settings.step, half = 0.5 * step;
    const vector3 gravity = settings.gravity;
    const bool pushed = particles.pushed;
    const double highest = settings.deepest_overlap * smallest_radius / step;
    double fastest = 0;
    bool fits = true;
    for (std::size_t i = 0; i < particles.owned; ++i) {
        motion& m = particles.motions[i];
        load& l = particles.loads[i];
        const bool free = m.inverse_mass > 0;
        const vector3 dv = half * (m.inverse_mass * l.force + gravity);
        const vector3 dw = (half * m.inverse_inertia) * l.torque;
        if (free) {
            m.velocity += dv;
            m.spin += dw;
        }
        if constexpr (Which != kick::last) {
            if (Which == kick::between && free) {
                m.velocity += dv;
                m.spin += dw;
            }
            particles.spheres[i].centre += step * m.velocity;
            const double squared_speed = dot(m.velocity, m.velocity);
            fits = fits && squared_speed <= highest * highest;
            fastest = squared_speed > fastest ? squared_speed : fastest;
            particles.leads[i] = free ? lead_of(dv, dw) : lead{};
            l = {pushed ? particles.outer_forces[i] : vector3{}, 0, {}, 0};
        }
    }
    if (!fits) failure = too_fast(highest);
    return fits ? std::sqrt(fastest) : std::numeric_limits<double>::infinity();
}

template double bed::implementation::move<bed::implementation::kick::first>();
template double bed::implementation::move<bed::implementation::kick::between>();
template double bed::implementation::move<bed::implementation::kick::last>();

void bed::implementation::step_once(bool first) {
    const double mine = first ? move<kick::first>() : move<kick::between>();
    if (shared) ghosts.begin_motion(particles);
    const double fastest = among->max(failure ? std::numeric_limits<double>::infinity() : mine);
    if (shared) ghosts.end_motion(particles);
    if (std::isinf(fastest)) raise_failure();
    travelled += fastest * settings.step;
    move_walls();
    refresh_lists();
    add_forces(settings.step);
    ++steps;
}

void bed::implementation::clear_loads() {
    for (std::size_t i = 0; i < particles.owned; ++i) {
        particles.leads[i] = {};
        particles.loads[i] = {particles.pushed ? particles.outer_forces[i] : vector3{}, 0, {}, 0};
    }
}

void bed::implementation::move_walls() {
    double fastest = 0;
    for (auto& w : walls) {
        if (!w.moves() || w.body.conveys) continue;
        fastest = std::fmax(fastest, w.speed_in(extent));
        w.advance(settings.step);
    }
    wall_travelled += fastest * settings.step;
    travelled = std::fmax(travelled, wall_travelled);
}

motion_error bed::implementation::too_fast(double highest) const {
    std::size_t i = 0;
    while (dot(particles.motions[i].velocity, particles.motions[i].velocity) <= highest * highest) ++i;
    std::ostringstream text;
    text << "hearth: particle " << particles.ids[i] << " moves at " << norm(particles.motions[i].velocity)
         << " m/s, allowed: " << highest << " m/s, so that it does not pass " << settings.deepest_overlap
         << " of the smallest radius in one step; take a shorter step";
    return motion_error(text.str(), particles.ids[i]);
}

}  // namespace hearth::dem
