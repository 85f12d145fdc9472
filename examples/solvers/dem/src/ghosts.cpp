// SPDX-License-Identifier: MIT
#include "ghosts.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace hearth::dem::detail {
namespace {

/// A ghost as it comes, without gaps between the members.
struct packed_ghost {
    vector3 centre, velocity, spin;
    double radius, inverse_mass, inverse_inertia, temperature;
    lead ahead;
    std::int64_t id;
};
struct packed_state {
    vector3 centre, velocity, spin;
    double temperature, inverse_mass, inverse_inertia;
};

template <class Value>
std::vector<link> in_bytes(std::vector<link> links) {
    for (link& l : links) {
        l.begin *= sizeof(Value);
        l.end *= sizeof(Value);
    }
    return links;
}

template <class Value>
const char* bytes_of(const std::vector<Value>& values) {
    return reinterpret_cast<const char*>(values.data());
}
template <class Value>
char* bytes_of(std::vector<Value>& values) {
    return reinterpret_cast<char*>(values.data());
}

}  // namespace

void ghosts::survey(const store& particles, const std::vector<index>& kept) {
    range own{std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
    for (const index k : kept) {
        const double x = particles.spheres[static_cast<std::size_t>(k)].centre[axis_];
        own = {std::fmin(own.low, x), std::fmax(own.high, x)};
    }
    ranges_ = among_->gather(std::vector<range>{own});
}

std::vector<index> ghosts::make(store& particles, double largest_radius, double reach, double near_reach) {
    const auto is_near = [&](double x, double width, const range& r) {
        return r.low <= r.high && x > r.low - width && x < r.high + width;
    };
    const auto contact_width = [&](const sphere& s) { return s.radius + largest_radius + reach; };
    exported_.clear();
    exports_.clear();
    imports_.clear();
    owners_.clear();
    std::vector<parcel<char>> outgoing;
    for (int r = 0; r < among_->size(); ++r) {
        const range& theirs = ranges_[static_cast<std::size_t>(r)];
        if (r == among_->rank() || theirs.low > theirs.high) continue;
        const std::size_t first = exported_.size();
        std::vector<packed_ghost> packed;
        for (std::size_t i = 0; i < particles.owned; ++i) {
            const sphere& s = particles.spheres[i];
            if (!is_near(s.centre[axis_], std::fmax(contact_width(s), near_reach), theirs)) continue;
            const motion& m = particles.motions[i];
            exported_.push_back(static_cast<index>(i));
            packed.push_back({s.centre, m.velocity, m.spin, s.radius, m.inverse_mass, m.inverse_inertia,
                              particles.temperatures[i], particles.leads[i], particles.ids[i]});
        }
        if (packed.empty()) continue;
        exports_.push_back({r, first, exported_.size()});
        outgoing.push_back({r, {bytes_of(packed), bytes_of(packed) + packed.size() * sizeof(packed_ghost)}});
    }
    std::vector<index> touching;
    for (const auto& from : among_->exchange(std::move(outgoing))) {
        const std::size_t count = from.values.size() / sizeof(packed_ghost), before = particles.total();
        imports_.push_back({from.rank, before - particles.owned, before - particles.owned + count});
        particles.resize(before + count);
        owners_.resize(owners_.size() + count, from.rank);
        for (std::size_t k = 0; k < count; ++k) {
            packed_ghost g;
            std::memcpy(&g, from.values.data() + k * sizeof g, sizeof g);
            const std::size_t i = before + k;
            particles.spheres[i] = {g.centre, g.radius};
            particles.motions[i] = {g.velocity, g.inverse_mass, g.spin, g.inverse_inertia};
            particles.leads[i] = g.ahead;
            particles.ids[i] = g.id;
            particles.temperatures[i] = g.temperature;
            if (is_near(g.centre[axis_], contact_width(particles.spheres[i]), mine()))
                touching.push_back(static_cast<index>(i));
        }
    }
    return touching;
}

void ghosts::want(const store& particles, const pair_list& pairs) {
    std::vector<char> wanted(particles.total() - particles.owned, 0);
    for (const auto& p : pairs.pairs) {
        const auto last = static_cast<std::size_t>(std::max(p.i, p.j));
        if (last >= particles.owned) wanted[last - particles.owned] = 1;
    }
    moved_in_.clear();
    moved_out_.clear();
    std::vector<link> links_in, links_out;
    std::vector<parcel<char>> outgoing;
    for (const link& from : imports_) {
        const std::size_t first = moved_in_.size();
        outgoing.push_back({from.rank,
                            {wanted.begin() + static_cast<std::ptrdiff_t>(from.begin),
                             wanted.begin() + static_cast<std::ptrdiff_t>(from.end)}});
        for (std::size_t g = from.begin; g < from.end; ++g)
            if (wanted[g]) moved_in_.push_back(static_cast<index>(particles.owned + g));
        links_in.push_back({from.rank, first, moved_in_.size()});
    }
    for (const auto& to : among_->exchange(std::move(outgoing))) {
        const auto export_to =
            std::find_if(exports_.begin(), exports_.end(), [&](const link& l) { return l.rank == to.rank; });
        const std::size_t first = moved_out_.size();
        for (std::size_t k = 0; k < to.values.size(); ++k)
            if (to.values[k]) moved_out_.push_back(exported_[export_to->begin + k]);
        links_out.push_back({to.rank, first, moved_out_.size()});
    }
    bytes_in_ = in_bytes<moving>(std::move(links_in));
    bytes_out_ = in_bytes<moving>(std::move(links_out));
    outgoing_.resize(moved_out_.size());
    incoming_.resize(moved_in_.size());
}

void ghosts::begin_motion(const store& particles) {
    for (std::size_t k = 0; k < moved_out_.size(); ++k) {
        const auto i = static_cast<std::size_t>(moved_out_[k]);
        outgoing_[k] = {particles.spheres[i].centre, particles.motions[i].velocity, particles.motions[i].spin,
                        particles.leads[i]};
    }
    among_->begin(bytes_of(outgoing_), bytes_out_, bytes_of(incoming_), bytes_in_);
}

void ghosts::end_motion(store& particles) {
    among_->end();
    for (std::size_t k = 0; k < moved_in_.size(); ++k) {
        const auto i = static_cast<std::size_t>(moved_in_[k]);
        particles.spheres[i].centre = incoming_[k].centre;
        particles.motions[i].velocity = incoming_[k].velocity;
        particles.motions[i].spin = incoming_[k].spin;
        particles.leads[i] = incoming_[k].ahead;
        particles.loads[i] = {};
    }
}

void ghosts::update(store& particles) {
    std::vector<packed_state> outgoing, incoming(particles.total() - particles.owned);
    for (const index e : exported_) {
        const auto i = static_cast<std::size_t>(e);
        const motion& m = particles.motions[i];
        outgoing.push_back({particles.spheres[i].centre, m.velocity, m.spin, particles.temperatures[i], m.inverse_mass,
                            m.inverse_inertia});
    }
    among_->begin(bytes_of(outgoing), in_bytes<packed_state>(exports_), bytes_of(incoming),
                  in_bytes<packed_state>(imports_));
    among_->end();
    for (std::size_t k = 0; k < incoming.size(); ++k) {
        const std::size_t i = particles.owned + k;
        const packed_state& p = incoming[k];
        particles.spheres[i].centre = p.centre;
        particles.motions[i] = {p.velocity, p.inverse_mass, p.spin, p.inverse_inertia};
        particles.temperatures[i] = p.temperature;
    }
}

std::size_t ghosts::bytes() const {
    return (exported_.capacity() + moved_out_.capacity() + moved_in_.capacity()) * sizeof(index) +
           (outgoing_.capacity() + incoming_.capacity()) * sizeof(moving) + owners_.capacity() * sizeof(int);
}

}  // namespace hearth::dem::detail
