// SPDX-License-Identifier: MIT
#include "archive.hpp"
#include "implementation.hpp"

namespace hearth::dem {

using detail::checksum;
using detail::writer;

namespace {

constexpr std::uint64_t magic = 0x3130'6d65'6468'7265u;  // what it is, and its version

}  // namespace

/// Everything that the next step depends on, in one order for both ways.  The near list is made anew when it is asked for,
/// and leads by the first kick.
template <class Archive, class Implementation>
void bed::implementation::each_part(Archive& archive, Implementation& self) {
    auto& p = self.particles;
    archive(p.owned);
    archive(p.spheres);
    archive(p.motions);
    archive(p.loads);
    archive(p.ids);
    archive(p.temperatures);
    archive(p.flights);
    archive(p.outer_forces);
    archive(self.pairs.pairs);
    archive(self.pairs.springs);
    archive(self.pairs.rolls);
    for (auto& w : self.walls) {
        archive(w.place.rows);
        archive(w.place.shift);
        archive(w.place.moved);
        archive(w.body.motion);
        archive(w.body.temperature);
        archive(w.open);
        archive(w.candidates);
        archive(w.springs);
        archive(w.rolls);
        archive(w.reaction);
    }
    archive(self.next_id);
    archive(self.steps);
    archive(self.rebuilds);
    archive(self.listed);
    archive(self.loaded);
    archive(self.travelled);
    archive(self.wall_travelled);
    archive(self.largest_radius);
    archive(self.smallest_radius);
    archive(self.extent);
    archive(self.built);
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

std::vector<char> bed::state() const {
    writer archive;
    archive(magic);
    std::vector<double> made_with;
    self_->each_setting([&](double v) { made_with.push_back(v); });
    archive(made_with);
    implementation::each_part(archive, static_cast<const implementation&>(*self_));
    const std::uint64_t sum = checksum(archive.out.data(), archive.out.size());
    archive(sum);
    return std::move(archive.out);
}

void bed::restore(const std::vector<char>& state) {
    detail::reader archive = detail::opened(state, magic, "a bed");
    std::vector<double> made_with, have;
    archive(made_with);
    self_->each_setting([&](double v) { have.push_back(v); });
    if (made_with != have) {
        std::size_t at = 0;
        while (at < std::min(made_with.size(), have.size()) && made_with[at] == have[at]) ++at;
        throw state_error("hearth: the state was made with other settings or walls; number " + std::to_string(at) +
                          " of them differs first");
    }
    implementation read = *self_;
    implementation::each_part(archive, read);
    if (!archive.at_end()) throw state_error("hearth: the state of a bed is longer than it should be");
    read.particles.leads.assign(read.particles.total(), lead{});
    read.particles.near_places.assign(read.particles.total(), -1);
    read.near = {};
    read.revision = self_->revision + 1;
    *self_ = std::move(read);
}

}  // namespace hearth::dem
