// SPDX-License-Identifier: MIT
#include <cmath>
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
void bed::implementation::move() {
    const double step = settings.step, half = 0.5 * step;
    const vector3 gravity = settings.gravity;
    const bool pushed = !particles.outer_forces.empty();
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
    if (Which == kick::last) return;
    travelled += std::sqrt(fastest) * step;
    if (!fits) refuse_speed(highest);
}

template void bed::implementation::move<bed::implementation::kick::first>();
template void bed::implementation::move<bed::implementation::kick::between>();
template void bed::implementation::move<bed::implementation::kick::last>();

void bed::implementation::clear_loads() {
    for (std::size_t i = 0; i < particles.owned; ++i) {
        particles.leads[i] = {};
        particles.loads[i] = {particles.outer_forces.empty() ? vector3{} : particles.outer_forces[i], 0, {}, 0};
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

void bed::implementation::refuse_speed(double highest) const {
    std::size_t i = 0;
    while (norm(particles.motions[i].velocity) <= highest) ++i;
    std::ostringstream text;
    text << "hearth: particle " << particles.ids[i] << " moves at " << norm(particles.motions[i].velocity)
         << " m/s, allowed: " << highest << " m/s, so that it does not pass " << settings.deepest_overlap
         << " of the smallest radius in one step; take a shorter step";
    throw motion_error(text.str(), particles.ids[i]);
}

}  // namespace hearth::dem
