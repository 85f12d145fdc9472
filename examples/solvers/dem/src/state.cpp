// SPDX-License-Identifier: MIT
#include <algorithm>

#include "archive.hpp"
#include "implementation.hpp"
#include "packed_particle.hpp"

namespace hearth::dem {

using detail::checksum;
using detail::writer;

namespace {

constexpr std::uint64_t magic = 0x3230'6d65'6468'7265u;  // what it is, and its version

/// Which part of a state it is.
struct part {
    std::int32_t number, count;
    std::int64_t particles;  ///< of all parts
};

/// Throws on every rank where any of them says what is wrong.
void refuse_agreed(const ranks& among, const std::string& wrong) {
    if (!among.any(!wrong.empty())) return;
    throw state_error(wrong.empty() ? "hearth: another rank was given a state of a bed that cannot be restored" : wrong);
}

/// What is missing of the parts of all ranks; empty: nothing.
std::string incomplete(const std::vector<part>& parts, std::int64_t particles) {
    if (parts.empty()) return "hearth: a state of a bed has no parts";
    const auto count = static_cast<std::size_t>(parts[0].count);
    std::vector<int> seen(count, 0);
    for (const part& p : parts) {
        const bool fits = p.count == parts[0].count && p.particles == parts[0].particles && p.number >= 0 && p.number < p.count;
        if (!fits) return "hearth: parts of different states of beds";
        if (++seen[static_cast<std::size_t>(p.number)] > 1)
            return "hearth: part " + std::to_string(p.number) + " of the state of a bed was given twice";
    }
    for (std::size_t k = 0; k < count; ++k)
        if (seen[k] == 0)
            return "hearth: part " + std::to_string(k) + " of " + std::to_string(count) + " of the state of a bed is missing";
    return particles == parts[0].particles ? "" : "hearth: the state of a bed has lost particles";
}

}  // namespace

/// Everything that the next step depends on beside the particles, in one order for both ways.  The near list is made anew
/// when it is asked for, and the list of contacts from where the particles were when it was made.
template <class Archive, class Implementation>
void bed::implementation::each_part(Archive& archive, Implementation& self) {
    for (auto& w : self.walls) {
        archive(w.place.rows);
        archive(w.place.shift);
        archive(w.place.moved);
        archive(w.body.motion);
        archive(w.body.temperature);
        archive(w.open);
    }
    archive(self.next_id);
    archive(self.steps);
    archive(self.rebuilds);
    archive(self.listed);
    archive(self.loaded);
    archive(self.travelled);
    archive(self.wall_travelled);
}

/// What a state must have been made with.
void bed::implementation::each_setting(const std::function<void(double)>& see) const {
    const auto see_contact = [&](const contact_law& c) {
        for (const double v : {c.normal_stiffness, c.tangential_stiffness, c.settings.damping, c.settings.friction,
                               c.settings.rolling_friction, c.settings.rule == slip_rule::paper ? 1.0 : 0.0}) {
            see(v);
        }
    };
    for (const double v : {settings.step, settings.gravity.x, settings.gravity.y, settings.gravity.z, settings.skin,
                           settings.deepest_overlap}) {
        see(v);
    }
    see_contact(law);
    for (const auto& w : walls) {
        see_contact(w.law);
        see(static_cast<double>(w.body.facets.size()));
        for (const facet& f : w.body.facets) {
            // A point that tells one shape from another, without a list of what each consists of.
            for (const vector3& probe : {vector3{0.1, 0.2, 0.3}, vector3{-3, 5, -7}}) {
                const vector3 foot = closest_point(f, probe);
                see(foot.x);
                see(foot.y);
                see(foot.z);
            }
        }
    }
}

void bed::implementation::check_settings(detail::reader& archive) const {
    std::vector<double> made_with, have;
    archive(made_with);
    each_setting([&](double v) { have.push_back(v); });
    if (made_with == have) return;
    std::size_t at = 0;
    while (at < std::min(made_with.size(), have.size()) && made_with[at] == have[at]) ++at;
    throw state_error("hearth: the state was made with other settings or walls; number " + std::to_string(at) +
                      " of them differs first");
}

std::vector<char> bed::state() const {
    const implementation& self = *self_;
    writer archive, common;
    archive(magic);
    std::vector<double> made_with;
    self.each_setting([&](double v) { made_with.push_back(v); });
    archive(made_with);
    archive(part{self.among->rank(), self.among->size(), self.everybody});
    implementation::each_part(common, self);
    common(self.slabs.cuts());
    archive(common.out);
    for (const auto& w : self.walls) archive(w.reaction);  // what this part has of it
    archive(self.particles.pushed);
    detail::pack(self.particles, self.everyone(), self.remember(true), archive);
    const std::uint64_t sum = checksum(archive.out.data(), archive.out.size());
    archive(sum);
    return std::move(archive.out);
}

void bed::restore(const std::vector<char>& state) { restore_parts({state}); }

void bed::restore_parts(const std::vector<std::vector<char>>& states) {
    const implementation& self = *self_;
    implementation read(self.settings, {self.among, self.slabs.axis(), self.near_factor});
    read.rolling = self.rolling;
    read.walls = self.walls;
    read.particles.built_goes_along = true;
    detail::history past(read.rolling);
    past.start(0);
    past.begin_filling();
    std::vector<part> parts;
    std::vector<char> common;
    std::vector<vector3> reactions(self.walls.size());
    std::string wrong;
    try {
        for (const std::vector<char>& state : states) {
            detail::reader archive = detail::opened(state, magic, "a bed");
            self.check_settings(archive);
            archive(parts.emplace_back());
            std::vector<char> block;
            archive(block);
            if (parts.back().number == 0) common = std::move(block);
            for (vector3& sum : reactions) {
                vector3 share;
                archive(share);
                sum += share;
            }
            bool pushed = false;
            archive(pushed);
            if (pushed && !read.particles.pushed) {
                read.particles.pushed = true;
                read.particles.outer_forces.resize(read.particles.owned);
            }
            detail::unpack(archive, read.particles, past);
            if (!archive.at_end()) throw state_error("hearth: the state of a bed is longer than it should be");
        }
    } catch (const state_error& e) {
        wrong = e.what();
    }
    refuse_agreed(*self.among, wrong);
    const auto found = self.among->sum(static_cast<std::int64_t>(read.particles.owned));
    refuse_agreed(*self.among, incomplete(self.among->gather(parts), found));
    common = self.among->gather(common);
    detail::reader archive(common.data(), common.size());
    implementation::each_part(archive, read);
    std::vector<double> cuts;
    archive(cuts);
    read.slabs.set_cuts(cuts);

    // Lists as they were made, then everybody back to where it is.
    const auto swap_places = [&] {
        for (std::size_t i = 0; i < read.particles.owned; ++i)
            std::swap(read.particles.spheres[i].centre, read.particles.built[i]);
    };
    swap_places();
    read.build_lists(std::move(past), read.everyone());
    swap_places();
    read.particles.built_goes_along = false;
    for (std::size_t w = 0; w < read.walls.size(); ++w) read.walls[w].reaction = reactions[w];
    if (read.shared) read.ghosts.update(read.particles);
    read.revision = self.revision + 1;
    *self_ = std::move(read);
}

}  // namespace hearth::dem
