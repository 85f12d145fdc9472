// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <hearth/dem/recording.hpp>

#include "archive.hpp"
#include "check.hpp"
#include "gathered.hpp"

namespace hearth::dem {

using detail::check;

namespace {

constexpr std::uint64_t magic = 0x3130'7372'6463'6572u;  // what it is, and its version

}  // namespace

recorder::recorder(const recording::settings& s) : settings_(s) {
    check(is_finite(s.shaft.base), "base of zone", norm(s.shaft.base), "finite [m]");
    check(s.shaft.radius > 0 && std::isfinite(s.shaft.radius), "radius of zone", s.shaft.radius, "finite and > 0 [m]");
    check(s.shaft.height > 0 && std::isfinite(s.shaft.height), "height of zone", s.shaft.height, "finite and > 0 [m]");
    check(s.rings > 0, "rings", s.rings, "> 0");
    check(s.layers > 0, "layers", s.layers, "> 0");
    check(s.size_weight >= 0 && std::isfinite(s.size_weight), "size_weight", s.size_weight, "finite and >= 0 [-]");
}

void recorder::meet(const bed& b) {
    const std::vector<int> contacts = b.contact_counts();
    const auto arrives = [&](index i) {
        return contacts[static_cast<std::size_t>(i)] >= 2 && slots_.count(b.ids()[i]) == 0;
    };
    for (const detail::placed& p : detail::gathered(b, arrives)) {
        slots_.emplace(p.id, static_cast<std::uint32_t>(record_.radii_.size()));
        record_.radii_.push_back(p.radius);
        record_.masses_.push_back(p.mass);
    }
}

bool recorder::observe(const bed& b) {
    meet(b);
    if (!record_.frames_.empty()) {
        const std::vector<std::uint32_t>& before = record_.frames_.back().slots;
        std::int64_t still_there = 0;
        for (index i = 0; i < b.size(); ++i) {
            const auto known = slots_.find(b.ids()[i]);
            still_there += known != slots_.end() && std::binary_search(before.begin(), before.end(), known->second);
        }
        if (b.among().sum(still_there) == static_cast<std::int64_t>(before.size())) return false;
    }
    std::vector<std::pair<std::uint32_t, vector3>> seen;
    for (const detail::placed& p : detail::gathered(b, [&](index i) { return slots_.count(b.ids()[i]) > 0; }))
        seen.emplace_back(slots_.at(p.id), p.centre);
    std::sort(seen.begin(), seen.end(), [](const auto& one, const auto& other) { return one.first < other.first; });
    recording::frame f;
    for (const auto& [slot, centre] : seen) {
        f.slots.push_back(slot);
        f.centres.push_back(centre);
    }
    if (!record_.frames_.empty()) {
        const std::vector<std::uint32_t>& before = record_.frames_.back().slots;
        std::vector<std::uint32_t> gone;
        std::set_difference(before.begin(), before.end(), f.slots.begin(), f.slots.end(), std::back_inserter(gone));
        for (const std::uint32_t slot : gone) mass_left_ += record_.masses_[slot];
    }
    record_.frames_.push_back(std::move(f));
    return true;
}

recording recorder::finish() const {
    const std::size_t count = record_.frames_.size();
    check(count > 1, "number of frames", static_cast<double>(count),
          "> 1: particles must leave the bed while it is recorded");
    const auto size_of = [&](std::size_t k) { return static_cast<double>(record_.frames_[k].slots.size()); };
    std::size_t last = count - 1;
    for (std::size_t k = count - 1; k > 0 && 2 * k >= count; --k)
        if (std::fabs(size_of(k) - size_of(0)) < std::fabs(size_of(last) - size_of(0))) last = k;
    const double change = (size_of(last) - size_of(0)) / size_of(0);
    check(std::fabs(change) <= 0.05, "relative change of the number of particles while recorded", change,
          "within 0.05");
    recording done = record_;
    done.frames_.resize(last + 1);
    done.join(settings_.size_weight);
    done.average(settings_);
    return done;
}

std::vector<char> recorder::state() const {
    std::vector<std::int64_t> ids;
    std::vector<std::uint32_t> slots;
    for (const auto& [id, slot] : slots_) {
        ids.push_back(id);
        slots.push_back(slot);
    }
    detail::writer archive;
    archive(magic);
    archive(record_.bytes());
    archive(ids);
    archive(slots);
    archive(mass_left_);
    archive(detail::checksum(archive.out.data(), archive.out.size()));
    return std::move(archive.out);
}

void recorder::restore(const std::vector<char>& state) {
    detail::reader archive = detail::opened(state, magic, "a recorder");
    recorder read(settings_);
    std::vector<char> record;
    std::vector<std::int64_t> ids;
    std::vector<std::uint32_t> slots;
    archive(record);
    archive(ids);
    archive(slots);
    archive(read.mass_left_);
    read.record_ = recording::read(record);
    if (slots.size() != ids.size())
        throw state_error("hearth: the state of a recorder has not a slot for each particle");
    for (std::size_t k = 0; k < ids.size(); ++k) read.slots_.emplace(ids[k], slots[k]);
    *this = std::move(read);
}

}  // namespace hearth::dem
