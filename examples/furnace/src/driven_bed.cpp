// SPDX-License-Identifier: MIT
#include "driven_bed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat.hpp"
#include "packing.hpp"

namespace hearth::furnace {

namespace {

/// At the start: all but those above the bed that touch nobody.
dem::moving_bed::population who_rests(const settings& scene, dem::bed& parcels, const ranks& among) {
    parcels.update_ghosts();
    const std::vector<int> contacts = parcels.contact_counts();
    std::vector<std::int64_t> falling;
    for (dem::index i = 0; i < parcels.size(); ++i) {
        if (parcels.spheres()[i].centre.z >= scene.shaft.height && contacts[static_cast<std::size_t>(i)] < 2)
            falling.push_back(parcels.ids()[i]);
    }
    falling = among.gather(falling);
    std::sort(falling.begin(), falling.end());
    dem::moving_bed::population found;
    for (const parcel_of_shaft& p : all_parcels(parcels, among)) {
        if (std::binary_search(falling.begin(), falling.end(), p.id)) continue;
        found.spheres.push_back(p.where);
        found.masses.push_back(p.mass);
        found.ids.push_back(p.id);
    }
    return found;
}

}  // namespace

driven_bed::driven_bed(const settings& scene, const ranks& among, dem::bed parcels, driven_motion motion,
                       double void_fraction)
    : driven_bed(who_rests(scene, parcels, among), scene, among, std::move(parcels), std::move(motion), void_fraction) {
}

driven_bed::driven_bed(population known, const settings& scene, const ranks& among, dem::bed&& parcels,
                       driven_motion motion, double void_fraction)
    : moving_bed(std::move(known), surroundings_of(scene), scene.particles.mass_flow, {}),
      among_(among),
      parcels_(std::move(parcels)),
      motion_(std::move(motion)),
      void_fraction_(void_fraction) {}

dem::vector3 driven_bed::velocity(dem::index i) const {
    const auto k = static_cast<std::size_t>(i);
    return k < velocities_.size() ? velocities_[k] : dem::vector3{};
}

double driven_bed::flying() const {
    return sum_over(parcels_, [&](dem::index i) { return parcels_.mass(i); }) - total_mass();
}

/// Adds those who rest, and were not of the bed before.
void driven_bed::see_who_lands(std::map<std::int64_t, double>& mass_of) {
    struct newcomer {
        std::int64_t id;
        double mass;
    };
    parcels_.update_ghosts();
    const std::vector<int> contacts = parcels_.contact_counts();
    std::vector<newcomer> mine;
    for (dem::index i = 0; i < parcels_.size(); ++i) {
        const std::int64_t id = parcels_.ids()[i];
        if (contacts[static_cast<std::size_t>(i)] >= 2 && !std::binary_search(all_.ids.begin(), all_.ids.end(), id))
            mine.push_back({id, parcels_.mass(i)});
    }
    for (const newcomer& n : among_.gather(mine)) mass_of.emplace(n.id, n.mass);
}

void driven_bed::move(double seconds, dem::passage& done) {
    motion_.set_mass_flow(mass_flow_);
    const double step = parcels_.settings().step;
    behind_ += seconds / motion_.pace();
    auto steps = static_cast<std::int64_t>(behind_ / step);
    behind_ -= static_cast<double>(steps) * step;
    std::map<std::int64_t, double> landed;
    while (steps > 0) {
        const auto some = std::min<std::int64_t>(steps, driven_motion::stretch);
        motion_.advance(parcels_, static_cast<int>(some));
        see_who_lands(landed);
        steps -= some;
    }

    population now;
    std::vector<dem::index> origin;
    std::vector<dem::vector3> velocities;
    const auto leaves = [&](std::size_t k) {
        done.left.push_back({static_cast<dem::index>(k), all_.ids[k], all_.masses[k]});
    };
    std::size_t before = 0;
    for (const parcel_of_shaft& p : all_parcels(parcels_, among_)) {
        for (; before < all_.ids.size() && all_.ids[before] < p.id; ++before) leaves(before);
        const bool stayed = before < all_.ids.size() && all_.ids[before] == p.id;
        if (!stayed && landed.erase(p.id) == 0) continue;  // falls yet
        const bool moved = stayed && seconds > 0;
        velocities.push_back(moved ? (1 / seconds) * (p.where.centre - all_.spheres[before].centre) : dem::vector3{});
        origin.push_back(stayed ? static_cast<dem::index>(before++) : dem::passage::fed);
        if (!stayed) done.mass_in += p.mass;
        now.spheres.push_back(p.where);
        now.masses.push_back(p.mass);
        now.ids.push_back(p.id);
    }
    for (; before < all_.ids.size(); ++before) leaves(before);
    std::stable_sort(done.left.begin(), done.left.end(), [&](const auto& a, const auto& b) {
        return all_.spheres[static_cast<std::size_t>(a.from)].centre.z <
               all_.spheres[static_cast<std::size_t>(b.from)].centre.z;
    });
    for (const auto& [id, mass] : landed) {  // landed and left again
        done.left.push_back({dem::passage::fed, id, mass});
        done.mass_in += mass;
    }
    for (const dem::passage::leaver& l : done.left) done.mass_out += l.mass;
    ledger_.due -= done.mass_out;
    if (!now.ids.empty()) ledger_.next_id = std::max(ledger_.next_id, now.ids.back() + 1);
    all_ = std::move(now);
    velocities_ = std::move(velocities);
    done.origin = std::move(origin);
}

void driven_bed::save(saved_state& into) const {
    into["motion/numbers"] = {void_fraction_, behind_};
    into["motion/state"] = to_numbers(parcels_.state());
    motion_.save(into, "motion");
}

std::unique_ptr<driven_bed> driven_bed::read(const settings& scene, const ranks& among, const saved_state& from) {
    const auto find = [&](const char* name) -> const std::vector<double>& {
        const auto found = from.find(name);
        if (found == from.end()) throw bad_scene(std::string("the state lacks ") + name);
        return found->second;
    };
    const std::vector<double>&numbers = find("motion/numbers"), &state = find("motion/state");
    if (numbers.size() != 2 || !(numbers[0] > 0 && numbers[0] < 1))
        throw bad_scene("the state of motion/numbers is damaged");
    driven_motion motion(scene, numbers[0]);
    motion.restore(from, "motion");
    dem::bed parcels = empty_shaft(scene, among);
    set_weight(parcels, weight_of(scene));
    restore_parts(parcels, state, among);
    std::unique_ptr<driven_bed> made(
        new driven_bed({}, scene, among, std::move(parcels), std::move(motion), numbers[0]));
    made->behind_ = numbers[1];
    return made;
}

}  // namespace hearth::furnace
