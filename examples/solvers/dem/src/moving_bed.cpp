// SPDX-License-Identifier: MIT
#include <hearth/dem/moving_bed.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <hearth/core/error.hpp>

#include "archive.hpp"
#include "check.hpp"
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

std::vector<double> masses_of(const bed& b) {
    std::vector<double> masses;
    for (index i = 0; i < b.size(); ++i) masses.push_back(b.mass(i));
    return masses;
}

}  // namespace

surroundings surroundings::of(const bed& b) {
    check(!b.is_shared(), "number of ranks of the bed", b.among().size(), "1: beds that a rule moves are on one rank");
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

moving_bed::moving_bed(std::vector<sphere> spheres, std::vector<double> masses, surroundings around, double mass_flow)
    : spheres_(std::move(spheres)), masses_(std::move(masses)), ids_(spheres_.size()), around_(std::move(around)) {
    check(masses_.size() == spheres_.size(), "number of masses", static_cast<double>(masses_.size()), "that of spheres");
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
        const auto n = static_cast<std::int64_t>(i);
        check(is_finite(spheres_[i].centre), "position of particle", norm(spheres_[i].centre), "finite [m]", n);
        check(spheres_[i].radius > 0 && std::isfinite(spheres_[i].radius), "radius of particle", spheres_[i].radius,
              "finite and > 0 [m]", n);
        check(masses_[i] > 0 && std::isfinite(masses_[i]), "mass of particle", masses_[i], "finite and > 0 [kg]", n);
    }
    std::iota(ids_.begin(), ids_.end(), 0);
    ledger_.next_id = static_cast<std::int64_t>(ids_.size());
    set_mass_flow(mass_flow);
}

void moving_bed::set_mass_flow(double kg_per_s) {
    check(kg_per_s >= 0 && std::isfinite(kg_per_s), "mass_flow", kg_per_s, "finite and >= 0 [kg/s]");
    mass_flow_ = kg_per_s;
}

passage moving_bed::advance(double seconds) {
    check(seconds >= 0 && std::isfinite(seconds), "seconds", seconds, "finite and >= 0 [s]");
    passage done;
    done.origin.resize(spheres_.size());
    std::iota(done.origin.begin(), done.origin.end(), 0);
    ledger_.due += mass_flow_ * seconds;
    move(seconds, done);
    ledger_.in += done.mass_in;
    ledger_.out += done.mass_out;
    ++revision_;
    return done;
}

double moving_bed::total_mass() const { return std::accumulate(masses_.begin(), masses_.end(), 0.0); }

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

const std::vector<bed::pair>& moving_bed::pairs_within(double factor) const {
    check(factor > 0 && std::isfinite(factor), "factor of near pairs", factor, "finite and > 0 [-]");
    if (near_.revision == revision_ && near_.factor >= factor) return near_.pairs;
    near_.pairs = detail::near_pairs(spheres_, factor);
    near_.factor = factor;
    near_.revision = revision_;
    return near_.pairs;
}

std::vector<bed::touch> moving_bed::wall_touches() const {
    std::vector<bed::touch> all;
    if (spheres_.empty()) return all;
    const double largest = largest_radius(spheres_);
    const detail::cell_grid grid(spheres_.data(), spheres_.size(), 2 * largest);
    std::vector<index> order, start;
    grid.sort(spheres_.data(), spheres_.size(), order, start);
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
    archive(spheres_);
    archive(masses_);
    archive(ids_);
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
    decltype(spheres_) spheres;
    decltype(masses_) masses;
    decltype(ids_) ids;
    ledger book;
    double flow = 0;
    archive(spheres);
    archive(masses);
    archive(ids);
    archive(book);
    archive(flow);
    if (!archive.at_end()) throw state_error("hearth: the state of a moving bed is longer than it should be");
    spheres_.swap(spheres);
    masses_.swap(masses);
    ids_.swap(ids);
    ledger_ = book;
    mass_flow_ = flow;
    ++revision_;
}

frozen_bed::frozen_bed(const bed& b)
    : frozen_bed(std::vector<sphere>(b.spheres(), b.spheres() + b.size()), masses_of(b), surroundings::of(b)) {}

plug_bed::plug_bed(std::vector<sphere> spheres, std::vector<double> masses, const zone& shaft, surroundings around,
                   double mass_flow)
    : moving_bed(std::move(spheres), std::move(masses), std::move(around), mass_flow), shaft_(shaft) {
    check(shaft.height > 0 && std::isfinite(shaft.height), "height of zone", shaft.height, "finite and > 0 [m]");
    check(size() > 0, "number of particles", size(), "> 0");
    for (index i = 0; i < size(); ++i) {
        const double z = at(i).centre.z - shaft.base.z;
        check(z >= 0 && z <= shaft.height, "height of particle", z, "within the zone [m]", i);
    }
    mass_per_height_ = total_mass() / shaft.height;
}

/// Whole turns take everybody out once each; the rest of the way takes the lowest.
void plug_bed::move(double seconds, passage& done) {
    const double sinks = mass_flow_ * seconds / mass_per_height_;
    std::vector<index> order(spheres_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](index i, index j) {
        const double zi = at(i).centre.z, zj = at(j).centre.z;
        return zi != zj ? zi < zj : i < j;
    });
    for (sphere& s : spheres_) s.centre.z -= sinks;
    for (bool any = true; any;) {
        any = false;
        for (const index o : order) {
            const auto i = static_cast<std::size_t>(o);
            if (spheres_[i].centre.z >= shaft_.base.z) break;
            spheres_[i].centre.z += shaft_.height;
            any = true;
            done.left.push_back({done.origin[i], ids_[i], masses_[i]});
            done.origin[i] = passage::fed;
            done.mass_in += masses_[i];
            done.mass_out += masses_[i];
            ledger_.due -= masses_[i];
            ids_[i] = ledger_.next_id++;
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
