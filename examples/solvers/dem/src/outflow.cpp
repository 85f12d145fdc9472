// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <hearth/dem/feed.hpp>

#include "check.hpp"

namespace hearth::dem {

using detail::check;

namespace {

/// A particle that may leave, on whatever rank: without gaps between the members.
struct candidate {
    double height, mass, temperature;
    std::int64_t id;
    index place;
    std::int32_t rank;
};

/// Those of all ranks that are wanted, the lowest first.
template <class Wanted>
std::vector<candidate> candidates(const bed& b, Wanted&& wanted) {
    std::vector<candidate> mine;
    for (index i = 0; i < b.size(); ++i) {
        if (wanted(i)) mine.push_back({b.spheres()[i].centre.z, b.mass(i), b.temperatures()[i], b.ids()[i], i, b.among().rank()});
    }
    std::vector<candidate> all = b.among().gather(mine);
    std::sort(all.begin(), all.end(), [](const candidate& one, const candidate& other) {
        return one.height != other.height ? one.height < other.height : one.id < other.id;
    });
    return all;
}

std::vector<candidate> below(const bed& b, double height) {
    return candidates(b, [&](index i) { return b.spheres()[i].centre.z < height; });
}

double exit_of(const bed& b, const outflow::settings& s) { return s.height + b.largest_radius(); }

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

/// One of the candidates that is due leaves; false if it is not.
bool outflow::let_go(double mass, double temperature) {
    if (state_.due < mass) return false;
    state_.due -= mass;
    state_.taken += mass;
    state_.mass_temperature += mass * temperature;
    ++state_.particles;
    return true;
}

/// Those that would rest on the floor or are below it leave, the lowest first, as long as they are due.
int outflow::take_lowest(bed& b) {
    b.set_wall_open(settings_.floor, true);
    int count = 0;
    std::vector<index> gone;
    for (const candidate& c : below(b, exit_of(b, settings_))) {
        if (!let_go(c.mass, c.temperature)) break;
        ++count;
        if (c.rank == b.among().rank()) gone.push_back(c.place);
    }
    if (count > 0) b.remove(gone);
    return count;
}

/// The lowest layer moves as a body at flow over mass per height.  Its speed is trimmed by what has passed the exit and
/// is not yet due, so that the two never part by more than about half a layer.
void outflow::drive(bed& b) {
    const double exit = exit_of(b, settings_), top = exit + settings_.layer * 2 * b.largest_radius();
    double layer_mass = 0, passed = 0;
    for (const candidate& c : below(b, top)) (c.height < exit ? passed : layer_mass) += c.mass;
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
    std::vector<char> touches(static_cast<std::size_t>(b.size()), 0);
    for (const bed::touch& t : b.wall_touches())
        if (t.wall == settings_.floor) touches[static_cast<std::size_t>(t.i)] = 1;
    std::vector<candidate> touching = candidates(b, [&](index i) { return touches[static_cast<std::size_t>(i)] != 0; });
    std::sort(touching.begin(), touching.end(), [](const candidate& one, const candidate& other) { return one.id < other.id; });
    int count = 0;
    std::vector<index> gone;
    while (!touching.empty()) {
        const auto pick = touching.begin() + static_cast<std::ptrdiff_t>(state_.random.next() % touching.size());
        if (!let_go(pick->mass, pick->temperature)) break;
        ++count;
        if (pick->rank == b.among().rank()) gone.push_back(pick->place);
        touching.erase(pick);
    }
    if (count > 0) b.remove(gone);
    return count;
}

}  // namespace hearth::dem
