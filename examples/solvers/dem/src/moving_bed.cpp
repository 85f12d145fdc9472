// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <hearth/core/error.hpp>
#include <hearth/dem/moving_bed.hpp>

#include "archive.hpp"
#include "check.hpp"
#include "gathered.hpp"
#include "near_rows.hpp"
#include "wall_list.hpp"

namespace hearth::dem {

using detail::check;

namespace {

constexpr std::uint64_t magic = 0x3130'676e'6976'6f6du;  // what it is, and its version

double largest_radius(const std::vector<sphere>& spheres) {
    double largest = 0;
    for (const sphere& s : spheres) largest = std::fmax(largest, s.radius);
    return largest;
}

moving_bed::population population_of(const bed& b) {
    moving_bed::population all;
    const auto add = [&](const vector3& centre, double radius, double mass, std::int64_t id) {
        all.spheres.push_back({centre, radius});
        all.masses.push_back(mass);
        all.ids.push_back(id);
    };
    if (b.is_shared()) {
        for (const detail::placed& p : detail::gathered(b, [](index) { return true; }))
            add(p.centre, p.radius, p.mass, p.id);
    } else {
        for (index i = 0; i < b.size(); ++i) add(b.spheres()[i].centre, b.spheres()[i].radius, b.mass(i), b.ids()[i]);
    }
    return all;
}

/// Refuses what differs from rank to rank.
void require_same(const ranks& among, const char* what, const detail::writer& bytes) {
    const auto sum = static_cast<std::int64_t>(detail::checksum(bytes.out.data(), bytes.out.size()) >> 1);
    check(among.max(sum) == -among.max(-sum), what, static_cast<double>(among.rank()),
          "the same as of every other rank");
}

}  // namespace

surroundings surroundings::of(const bed& b) {
    surroundings around{b.law(), {}, {}};
    for (int w = 0; w < b.wall_count(); ++w) {
        if (b.wall_open(w)) continue;
        const wall& body = b.wall_at(w);
        const double speed = norm(body.motion.velocity) + norm(body.motion.spin);
        check(body.conveys || speed == 0, "motion of wall", speed, "none, or that of a belt", w);
        around.walls.push_back(body);
        around.wall_laws.push_back(b.wall_law(w));
    }
    return around;
}

moving_bed::moving_bed(population all, surroundings around, double mass_flow, const decomposition& spread)
    : all_(std::move(all)), around_(std::move(around)), spread_(spread) {
    const auto n = all_.spheres.size();
    check(all_.masses.size() == n, "number of masses", static_cast<double>(all_.masses.size()), "that of spheres");
    for (std::size_t i = 0; i < n; ++i) {
        const auto at = static_cast<std::int64_t>(i);
        const sphere& s = all_.spheres[i];
        check(is_finite(s.centre), "position of particle", norm(s.centre), "finite [m]", at);
        check(s.radius > 0 && std::isfinite(s.radius), "radius of particle", s.radius, "finite and > 0 [m]", at);
        check(all_.masses[i] > 0 && std::isfinite(all_.masses[i]), "mass of particle", all_.masses[i],
              "finite and > 0 [kg]", at);
    }
    check(spread.axis >= 0 && spread.axis < 3, "axis of decomposition", spread.axis, "0, 1 or 2");
    check(spread.near_factor >= 0 && std::isfinite(spread.near_factor), "near_factor", spread.near_factor,
          "finite and >= 0 [-]");
    if (all_.ids.empty()) {
        all_.ids.resize(n);
        std::iota(all_.ids.begin(), all_.ids.end(), 0);
    }
    if (n > 0) ledger_.next_id = *std::max_element(all_.ids.begin(), all_.ids.end()) + 1;
    set_mass_flow(mass_flow);
    if (is_shared()) {
        detail::writer made_of;
        for (const sphere& s : all_.spheres) made_of(s.centre), made_of(s.radius);
        made_of(all_.masses);
        made_of(all_.ids);
        require_same(among(), "what the bed is made of on rank", made_of);
    }
    divide();
}

void moving_bed::set_mass_flow(double kg_per_s) {
    check(kg_per_s >= 0 && std::isfinite(kg_per_s), "mass_flow", kg_per_s, "finite and >= 0 [kg/s]");
    mass_flow_ = kg_per_s;
}

passage moving_bed::advance(double seconds) {
    check(!among().any(!(seconds >= 0 && std::isfinite(seconds))), "seconds", seconds, "finite and >= 0 [s]");
    const double due = ledger_.due + mass_flow_ * seconds;
    check(among().max(due) == among().min(due), "mass that is due", due, "the same on every rank [kg]");
    passage done;
    done.origin.resize(all_.spheres.size());
    std::iota(done.origin.begin(), done.origin.end(), 0);
    ledger_.due = due;
    move(seconds, done);
    ledger_.in += done.mass_in;
    ledger_.out += done.mass_out;
    ++revision_;
    if (is_shared()) return part_of(done);
    divide();
    return done;
}

double moving_bed::total_mass() const { return std::accumulate(all_.masses.begin(), all_.masses.end(), 0.0); }

void moving_bed::set_patch_temperature(int patch, double kelvin) {
    check(kelvin > 0 && std::isfinite(kelvin), "temperature of patch", kelvin, "finite and > 0 [K]", patch);
    patch_temperature(patch);  // there must be one
    for (wall& w : around_.walls)
        if (w.patch == patch) w.temperature = kelvin;
}

double moving_bed::patch_temperature(int patch) const {
    for (const wall& w : around_.walls)
        if (w.patch == patch) return w.temperature;
    throw bad_value("patch", bad_value::no_index, patch, "that of a wall");
}

void moving_bed::look_between(double low, double high) {
    check(low <= high, "low end of what is looked at", low, "at most the high one [m]");
    if (low == look_low_ && high == look_high_) return;
    look_low_ = low;
    look_high_ = high;
    near_.revision = 0;  // what was found is of another part
}

/// Pairs of those within reach of what is looked at.
std::vector<bed::pair> moving_bed::looked_at(double factor) const {
    const double reach = 2 * factor * largest_radius(spheres());
    std::vector<index> numbers;
    std::vector<sphere> near;
    for (std::size_t i = 0; i < spheres().size(); ++i) {
        const sphere& s = spheres()[i];
        if (!(s.centre.z >= look_low_ - reach && s.centre.z <= look_high_ + reach)) continue;
        numbers.push_back(static_cast<index>(i));
        near.push_back(s);
    }
    std::vector<bed::pair> pairs = detail::near_pairs(near, factor);
    for (bed::pair& p : pairs) p = {numbers[static_cast<std::size_t>(p.i)], numbers[static_cast<std::size_t>(p.j)]};
    return pairs;
}

const std::vector<bed::pair>& moving_bed::pairs_within(double factor) const {
    check(factor > 0 && std::isfinite(factor), "factor of near pairs", factor, "finite and > 0 [-]");
    if (is_shared())
        check(factor <= std::fmax(1.0, spread_.near_factor), "factor of near pairs", factor,
              "<= near_factor of the decomposition [-]");
    if (near_.revision == revision_ && near_.factor >= factor) return near_.pairs;
    near_.pairs = std::isinf(look_low_) && std::isinf(look_high_) ? detail::near_pairs(spheres(), factor) : looked_at(factor);
    if (ghost_count() > 0) {
        auto& pairs = near_.pairs;
        pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                                   [&](const bed::pair& p) { return p.i >= owned_ && p.j >= owned_; }),
                    pairs.end());
        for (bed::pair& p : pairs)
            if (p.i >= owned_) std::swap(p.i, p.j);
    }
    near_.factor = factor;
    near_.revision = revision_;
    return near_.pairs;
}

std::vector<bed::touch> moving_bed::wall_touches() const {
    std::vector<bed::touch> all;
    if (owned_ == 0) return all;
    const auto count = static_cast<std::size_t>(owned_);
    const double largest = largest_radius(all_.spheres);
    const detail::cell_grid grid(spheres().data(), count, 2 * largest);
    std::vector<index> order, start;
    grid.sort(spheres().data(), count, order, start);
    detail::store sorted;
    for (const index o : order) sorted.spheres.push_back(at(o));
    sorted.owned = sorted.spheres.size();
    for (std::size_t w = 0; w < around_.walls.size(); ++w) {
        detail::wall_list list{};
        list.body = around_.walls[w];
        list.build(sorted, grid, start, largest, 0.0, detail::history(false), order, false);
        std::vector<detail::wall_list::touch> found;
        list.find_touches(sorted.spheres.data(), found);
        for (const auto& t : found) {
            const index place = list.candidates[t.candidate].particle, i = order[static_cast<std::size_t>(place)];
            all.push_back({i, static_cast<int>(w), at(i).radius - std::sqrt(t.squared_distance), t.foot});
        }
    }
    return all;
}

double moving_bed::distance_to_wall(index i, std::size_t wall_number) const {
    double least = std::numeric_limits<double>::infinity();
    for (const facet& f : around_.walls[wall_number].facets) {
        least = std::fmin(least, norm(at(i).centre - closest_point(f, at(i).centre)));
    }
    return least;
}

std::vector<char> moving_bed::state() const {
    detail::writer archive;
    archive(magic);
    archive(fingerprint());
    archive(all_.spheres);
    archive(all_.masses);
    archive(all_.ids);
    archive(ledger_);
    archive(mass_flow_);
    archive(detail::checksum(archive.out.data(), archive.out.size()));
    return std::move(archive.out);
}

void moving_bed::restore(const std::vector<char>& state) {
    detail::reader archive = detail::opened(state, magic, "a moving bed");
    std::uint64_t made_of = 0;
    archive(made_of);
    if (made_of != fingerprint()) throw state_error("hearth: the state is that of a moving bed made of something else");
    population all;
    ledger book;
    double flow = 0;
    archive(all.spheres);
    archive(all.masses);
    archive(all.ids);
    archive(book);
    archive(flow);
    if (!archive.at_end()) throw state_error("hearth: the state of a moving bed is longer than it should be");
    all_ = std::move(all);
    ledger_ = book;
    mass_flow_ = flow;
    ++revision_;
    divide();
}

frozen_bed::frozen_bed(const bed& b, const decomposition& spread)
    : moving_bed(population_of(b), surroundings::of(b), 0.0, spread) {}

plug_bed::plug_bed(std::vector<sphere> spheres, std::vector<double> masses, const zone& shaft, surroundings around,
                   double mass_flow, const decomposition& spread)
    : moving_bed({std::move(spheres), std::move(masses), {}}, std::move(around), mass_flow, spread), shaft_(shaft) {
    check(shaft.height > 0 && std::isfinite(shaft.height), "height of zone", shaft.height, "finite and > 0 [m]");
    check(!all_.spheres.empty(), "number of particles", 0.0, "> 0");
    for (std::size_t i = 0; i < all_.spheres.size(); ++i) {
        const double z = all_.spheres[i].centre.z - shaft.base.z;
        check(z >= 0 && z <= shaft.height, "height of particle", z, "within the zone [m]",
              static_cast<std::int64_t>(i));
    }
    mass_per_height_ = total_mass() / shaft.height;
}

/// Whole turns take everybody out once each; the rest of the way takes the lowest.
void plug_bed::move(double seconds, passage& done) {
    std::vector<sphere>& spheres = all_.spheres;
    std::vector<double>& masses = all_.masses;
    std::vector<std::int64_t>& ids = all_.ids;
    const double sinks = mass_flow_ * seconds / mass_per_height_;
    std::vector<index> order(spheres.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](index i, index j) {
        const double zi = spheres[static_cast<std::size_t>(i)].centre.z,
                     zj = spheres[static_cast<std::size_t>(j)].centre.z;
        return zi != zj ? zi < zj : i < j;
    });
    for (sphere& s : spheres) s.centre.z -= sinks;
    for (bool any = true; any;) {
        any = false;
        for (const index o : order) {
            const auto i = static_cast<std::size_t>(o);
            if (spheres[i].centre.z >= shaft_.base.z) break;
            spheres[i].centre.z += shaft_.height;
            any = true;
            done.left.push_back({done.origin[i], ids[i], masses[i]});
            done.origin[i] = passage::fed;
            done.mass_in += masses[i];
            done.mass_out += masses[i];
            ledger_.due -= masses[i];
            ids[i] = ledger_.next_id++;
        }
    }
}

std::uint64_t plug_bed::fingerprint() const {
    detail::writer bytes;
    bytes(shaft_);
    bytes(mass_per_height_);
    return detail::checksum(bytes.out.data(), bytes.out.size());
}

}  // namespace hearth::dem
