// SPDX-License-Identifier: MIT
#include <hearth/dem/feed.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>

#include "check.hpp"

namespace hearth::dem {
namespace {

using detail::check;

double cubed(double a) { return a * a * a; }

/// Spheres of a zone in cells as wide as the largest of them, to tell where there is room.
class occupied_space {
  public:
    occupied_space(const bed& b, const zone& where, double largest_new) : where_(where) {
        width_ = std::fmax(largest_new, 2 * b.largest_radius());
        n_[0] = n_[1] = static_cast<int>(2 * where.radius / width_) + 3;  // one more on each side
        n_[2] = static_cast<int>(where.height / width_) + 3;
        cells_.resize(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]));
        std::vector<sphere> there;
        for (index i = 0; i < b.size(); ++i)
            if (inside(cell(b.spheres()[i].centre))) there.push_back(b.spheres()[i]);
        for (const sphere& s : b.among().gather(there)) add(s);
    }

    void add(const sphere& s) {
        const auto c = cell(s.centre);
        if (inside(c)) cells_[number(c)].push_back(s);
    }

    bool has_room(const sphere& s) const {
        const auto c = cell(s.centre);
        for (int z = c[2] - 1; z <= c[2] + 1; ++z)
            for (int y = c[1] - 1; y <= c[1] + 1; ++y)
                for (int x = c[0] - 1; x <= c[0] + 1; ++x)
                    for (const sphere& other : cells_[number({x, y, z})]) {
                        const vector3 d = s.centre - other.centre;
                        if (dot(d, d) < (s.radius + other.radius) * (s.radius + other.radius)) return false;
                    }
        return true;
    }

  private:
    std::array<int, 3> cell(const vector3& x) const {
        const vector3 corner = where_.base - vector3{where_.radius + width_, where_.radius + width_, width_};
        std::array<int, 3> c;
        for (int a = 0; a < 3; ++a) {
            const double along = std::floor((x[a] - corner[a]) / width_);
            c[static_cast<std::size_t>(a)] = static_cast<int>(std::fmin(std::fmax(along, -1.0), 1e9));
        }
        return c;
    }
    bool inside(const std::array<int, 3>& c) const {
        for (std::size_t a = 0; a < 3; ++a)
            if (c[a] < 0 || c[a] >= n_[a]) return false;
        return true;
    }
    std::size_t number(const std::array<int, 3>& c) const {
        return static_cast<std::size_t>((c[2] * n_[1] + c[1]) * n_[0] + c[0]);
    }

    zone where_;
    double width_;
    std::array<int, 3> n_{};
    std::vector<std::vector<sphere>> cells_;
};

void check_flow(double kg_per_s) {
    check(kg_per_s >= 0 && std::isfinite(kg_per_s), "mass_flow", kg_per_s, "finite and >= 0 [kg/s]");
}

}  // namespace

size_distribution::size_distribution(std::vector<point> table) : table_(std::move(table)) {
    check(!table_.empty(), "number of sizes", 0, "> 0");
    for (std::size_t k = 0; k < table_.size(); ++k) {
        const auto at = static_cast<std::int64_t>(k);
        check(table_[k].diameter > 0 && std::isfinite(table_[k].diameter) &&
                  (k == 0 || table_[k].diameter > table_[k - 1].diameter),
              "diameter of size", table_[k].diameter, "finite, > 0 and rising [m]", at);
        check(table_[k].mass_below >= (k == 0 ? 0 : table_[k - 1].mass_below) && table_[k].mass_below <= 1,
              "mass_below of size", table_[k].mass_below, "rising from 0 to 1 [-]", at);
    }
    check(table_.size() == 1 || table_.front().mass_below == 0, "first mass_below", table_.front().mass_below, "0 [-]");
    check(table_.back().mass_below == 1, "last mass_below", table_.back().mass_below, "1 [-]");
}

double size_distribution::diameter_of(double mass_below) const {
    std::size_t k = 1;
    while (k + 1 < table_.size() && table_[k].mass_below < mass_below) ++k;
    if (table_.size() == 1) return table_[0].diameter;
    const point &low = table_[k - 1], &high = table_[k];
    const double share = high.mass_below - low.mass_below;
    return low.diameter + (share > 0 ? (mass_below - low.mass_below) / share : 0.0) * (high.diameter - low.diameter);
}

double size_distribution::draw(random_source& random) const {
    // By mass, and then kept as often as a kilogram of that size holds particles.
    for (;;) {
        const double d = diameter_of(random.uniform());
        if (random.uniform() <= cubed(smallest() / d)) return d;
    }
}

feed::feed(const settings& s, size_distribution sizes) : settings_(s), sizes_(std::move(sizes)) {
    check_flow(s.mass_flow);
    check(s.density > 0 && std::isfinite(s.density), "density", s.density, "finite and > 0 [kg/m^3]");
    check(s.temperature > 0 && std::isfinite(s.temperature), "temperature of feed", s.temperature, "finite and > 0 [K]");
    check(2 * s.where.radius >= sizes_.largest(), "radius of zone", s.where.radius, "room for the largest particle [m]");
    check(s.where.height >= sizes_.largest(), "height of zone", s.where.height, "room for the largest particle [m]");
    check(s.attempts > 0, "attempts", s.attempts, "> 0");
    state_.random.state = s.seed;
    state_.next_diameter = sizes_.draw(state_.random);
}

void feed::set_mass_flow(double kg_per_s) {
    check_flow(kg_per_s);
    settings_.mass_flow = kg_per_s;
}

double feed::next_mass() const {
    return settings_.density * constants<double>::pi() / 6 * cubed(state_.next_diameter);
}

feed::report feed::update(bed& b, double seconds) {
    check(seconds >= 0 && std::isfinite(seconds), "seconds", seconds, "finite and >= 0 [s]");
    state_.due += settings_.mass_flow * seconds;
    return insert(b, false);
}

feed::report feed::fill(bed& b) { return insert(b, true); }

feed::report feed::insert(bed& b, bool regardless) {
    if (!regardless && state_.due < next_mass()) return {0, false};
    const state before = state_;
    std::vector<particle> added;
    occupied_space space(b, settings_.where, sizes_.largest());
    bool full = false;
    while (!full && (regardless || state_.due >= next_mass())) {
        full = true;
        const double r = 0.5 * state_.next_diameter;
        for (int attempt = 0; attempt < settings_.attempts && full; ++attempt) {
            const double out = (settings_.where.radius - r) * std::sqrt(state_.random.uniform());
            const double angle = 2 * constants<double>::pi() * state_.random.uniform();
            const double up = state_.random.uniform(r, settings_.where.height - r);
            const sphere s{settings_.where.base + vector3{out * std::cos(angle), out * std::sin(angle), up}, r};
            if (!space.has_room(s)) continue;
            full = false;
            space.add(s);
            particle p;
            p.position = s.centre;
            p.radius = r;
            p.velocity = settings_.velocity;
            p.density = settings_.density;
            p.temperature = settings_.temperature;
            added.push_back(p);
            if (!regardless) state_.due -= next_mass();
            state_.brought += next_mass();
            state_.next_diameter = sizes_.draw(state_.random);
        }
    }
    try {
        b.insert(added);
    } catch (...) {  // e.g. a wall within the zone: nothing was brought
        state_ = before;
        throw;
    }
    state_.particles += static_cast<std::int64_t>(added.size());
    return {static_cast<int>(added.size()), full};
}

double surface_level(const bed& b, const zone& where) {
    const double largest = 2 * b.largest_radius();
    if (largest == 0) return where.base.z;
    const std::vector<int> counts = b.contact_counts();
    const int n = std::max(1, static_cast<int>(where.radius / largest));  // columns across
    const double width = 2 * where.radius / n;
    const auto columns_of_square = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    std::vector<double> top(columns_of_square, where.base.z);
    for (index i = 0; i < b.size(); ++i) {
        const sphere& s = b.spheres()[i];
        const vector3 d = s.centre - where.base;
        if (counts[static_cast<std::size_t>(i)] < 2 || std::hypot(d.x, d.y) > where.radius) continue;
        const auto x = std::min(static_cast<int>((d.x + where.radius) / width), n - 1);
        const auto y = std::min(static_cast<int>((d.y + where.radius) / width), n - 1);
        double& highest = top[static_cast<std::size_t>(y * n + x)];
        highest = std::fmax(highest, s.centre.z + s.radius);
    }
    const std::vector<double> of_ranks = b.among().gather(top);
    for (std::size_t k = 0; k < of_ranks.size(); ++k) {
        double& highest = top[k % columns_of_square];
        highest = std::fmax(highest, of_ranks[k]);
    }
    double sum = 0;
    int columns = 0;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const double dx = (x + 0.5) * width - where.radius, dy = (y + 0.5) * width - where.radius;
            if (std::hypot(dx, dy) > where.radius) continue;
            sum += top[static_cast<std::size_t>(y * n + x)];
            ++columns;
        }
    }
    return sum / columns;
}

std::int64_t fill_to_level(bed& b, feed& source, const zone& where, double level, std::int64_t most_steps) {
    check(level > 0 && std::isfinite(level), "level", level, "finite and > 0 [m]");
    const std::int64_t begin = b.steps();
    while (surface_level(b, where) < where.base.z + level && b.steps() - begin < most_steps) {
        source.fill(b);
        b.advance(static_cast<int>(std::min<std::int64_t>(1000, most_steps - (b.steps() - begin))));
    }
    return b.steps() - begin;
}

}  // namespace hearth::dem
