// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <hearth/dem/feed.hpp>

#include "check.hpp"

namespace hearth::dem {

using detail::check;

namespace {

double largest_diameter(const bed& b) {
    double largest = 0;
    for (index i = 0; i < b.size(); ++i) largest = std::fmax(largest, 2 * b.spheres()[i].radius);
    return largest;
}

}  // namespace

outflow::outflow(const settings& s) : settings_(s) {
    set_mass_flow(s.mass_flow);
    check(std::isfinite(s.height), "height of floor", s.height, "finite [m]");
    check(s.layer > 0 && std::isfinite(s.layer), "layer", s.layer, "finite and > 0 [-]");
    state_.random.state = s.seed;
}

void outflow::set_mass_flow(double kg_per_s) {
    check(kg_per_s >= 0 && std::isfinite(kg_per_s), "mass_flow", kg_per_s, "finite and >= 0 [kg/s]");
    settings_.mass_flow = kg_per_s;
}

int outflow::update(bed& b, double seconds) {
    check(seconds >= 0 && std::isfinite(seconds), "seconds", seconds, "finite and >= 0 [s]");
    state_.due += settings_.mass_flow * seconds;
    const int count = settings_.how == rule::driven ? take_lowest(b) : take_touching(b);
    if (settings_.how == rule::driven) drive(b);
    return count;
}

/// Those that would rest on the floor or are below it leave, the lowest first, as long as they are due.
int outflow::take_lowest(bed& b) {
    b.set_wall_open(settings_.floor, true);
    const double exit = settings_.height + 0.5 * largest_diameter(b);
    std::vector<index> below;
    for (index i = 0; i < b.size(); ++i)
        if (b.spheres()[i].centre.z < exit) below.push_back(i);
    std::sort(below.begin(), below.end(), [&](index i, index j) {
        const double zi = b.spheres()[i].centre.z, zj = b.spheres()[j].centre.z;
        return zi != zj ? zi < zj : b.ids()[i] < b.ids()[j];
    });
    std::size_t count = 0;
    for (; count < below.size() && state_.due >= b.mass(below[count]); ++count) {
        const double mass = b.mass(below[count]);
        state_.due -= mass;
        state_.taken += mass;
        state_.mass_temperature += mass * b.temperatures()[below[count]];
    }
    below.resize(count);
    state_.particles += static_cast<std::int64_t>(count);
    if (count > 0) b.remove(below);
    return static_cast<int>(count);
}

/// The lowest layer moves as a body at flow over mass per height.  Its speed is trimmed by what has passed the exit and
/// is not yet due, so that the two never part by more than about half a layer.
void outflow::drive(bed& b) {
    const double diameter = largest_diameter(b), exit = settings_.height + 0.5 * diameter;
    const double top = exit + settings_.layer * diameter;
    double layer_mass = 0, passed = 0;
    for (index i = 0; i < b.size(); ++i) {
        const double z = b.spheres()[i].centre.z;
        if (z >= top) continue;
        if (z < exit) passed += b.mass(i);
        else layer_mass += b.mass(i);
    }
    double speed = 0;
    if (layer_mass > 0) {
        const double per_height = layer_mass / (top - exit);
        speed = settings_.mass_flow / per_height * (1 + (state_.due - passed) / (0.5 * layer_mass));
        speed = std::fmax(0.0, std::fmin(speed, 2 * settings_.mass_flow / per_height));
    }
    for (index i = 0; i < b.size(); ++i) {
        const bool driven = b.spheres()[i].centre.z < top;
        b.set_driven(i, driven);
        if (driven) b.set_velocity(i, {0, 0, -speed}, {});
    }
}

int outflow::take_touching(bed& b) {
    std::vector<index> touching;
    for (const bed::touch& t : b.wall_touches())
        if (t.wall == settings_.floor) touching.push_back(t.i);
    std::sort(touching.begin(), touching.end(), [&](index i, index j) { return b.ids()[i] < b.ids()[j]; });
    std::vector<index> gone;
    while (!touching.empty()) {
        const auto pick = touching.begin() + static_cast<std::ptrdiff_t>(state_.random.next() % touching.size());
        const double mass = b.mass(*pick);
        if (state_.due < mass) break;
        state_.due -= mass;
        state_.taken += mass;
        state_.mass_temperature += mass * b.temperatures()[*pick];
        gone.push_back(*pick);
        touching.erase(pick);
    }
    state_.particles += static_cast<std::int64_t>(gone.size());
    if (!gone.empty()) b.remove(gone);
    return static_cast<int>(gone.size());
}

}  // namespace hearth::dem
