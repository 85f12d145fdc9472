// SPDX-License-Identifier: MIT
// Heat between stones, and with the wall.
#include <algorithm>
#include <limits>
#include <utility>

#include <hearth/core/particle_halo.hpp>

#include "parts.hpp"

namespace hearth::furnace {

namespace {

constexpr double ring_mass = 1e-6;  // of a ring of the wall, which stores nothing that counts [kg]

/// The nodes of a rank's network: its own parcels, its own rings, then those of others that they are linked with.  Rings are
/// known by numbers behind those of the parcels.
class node_places {
  public:
    node_places(const shares& share, std::size_t parcels, std::size_t rings)
        : share_(share), parcels_(static_cast<std::int32_t>(parcels)), place_(parcels + rings, -1) {
        for (const std::int32_t i : share.mine()) own(i);
        for (std::size_t r = 0; r < rings; ++r) {
            if (share.is_my_ring(r)) own(parcels_ + static_cast<std::int32_t>(r));
        }
    }

    void expect(std::size_t pairs) { pairs_.reserve(pairs); }  // they are many, and growing would take twice their memory
    /// Adds a pair of nodes, of which one at least is this rank's.
    void link(std::int32_t a, std::int32_t b, const thermal_link<double>& link) {
        if (owner(a) != share_.among().rank()) std::swap(a, b);
        std::int32_t& there = place_[static_cast<std::size_t>(b)];
        if (there < 0) {
            there = static_cast<std::int32_t>(ids_.size() + ghosts_.size());
            ghosts_.push_back({b, owner(b)});
        }
        pairs_.push_back({place_[static_cast<std::size_t>(a)], there, link});
    }

    const std::vector<thermal_pair>& pairs() const { return pairs_; }
    particle_halo<ranks> halo() const { return {share_.among(), ids_, ghosts_}; }

  private:
    int owner(std::int32_t node) const {
        return node < parcels_ ? share_.owner(node) : share_.ring_owner(static_cast<std::size_t>(node - parcels_));
    }
    void own(std::int32_t node) {
        place_[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(ids_.size());
        ids_.push_back(node);
    }

    const shares& share_;
    std::int32_t parcels_;
    std::vector<std::int32_t> place_;  // of every node here, or -1
    std::vector<std::int64_t> ids_;
    std::vector<ghost_particle> ghosts_;
    std::vector<thermal_pair> pairs_;
};

}  // namespace

/// This rank needs the neighbours of its own parcels only.
void furnace::parts::look_at_share() {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::int32_t i : share.mine()) {
        const double z = bed->spheres()[static_cast<std::size_t>(i)].centre.z;
        low = std::min(low, z);
        high = std::max(high, z);
    }
    if (low > high) low = high = 0;  // none
    bed->look_between(low, high);
}

/// Radiation and conduction between parcels and with the wall, whose rings pass on what they get to the ambient.  The wall
/// sees the parcels even where these do not see each other: what it loses is a matter of its own.
void furnace::parts::exchange_with_neighbours() {
    wall_loss = 0;
    {
        const stopwatch timing(seconds.links);
        look_at_share();
        stone_terms.links(cloud(), bed_neighbours{*bed, rings, share}, no_gas{}, links);
        std::size_t k = 0;
        for (const link_part& part : links.parts) {
            const bool radiates = part.term == 0;
            for (; k < part.pairs; ++k) {
                auto& link = links.pairs[k].link;
                // Parcels of k stones' width see each other through k times fewer layers than the stones that they stand for.
                if (radiates) link.radiation *= scene.physics.radiation ? 1 / coarse_graining : 0;
                else if (!scene.physics.conduction) link.conductance = 0;
            }
        }
    }
    const stopwatch timing(seconds.radiation);
    // The rings are nodes of the network as the stones are: a wall that took its temperature from the stones of before would
    // lose a third too little, since it is 3 K colder than they are and they move by as much in a step.
    const std::size_t count = fields.temperature.size(), own = share.mine().size();
    node_places nodes(share, count, rings.size());
    nodes.expect(links.pairs.size() + links.walls.size());
    for (const auto& pair : links.pairs) {
        if (pair.link.radiation > 0 || pair.link.conductance > 0) nodes.link(pair.first, pair.second, pair.link);
    }
    for (const auto& wall : links.walls) nodes.link(wall.particle, static_cast<std::int32_t>(count) + wall.patch, wall.link);
    std::vector<double> temperature = share.pick(fields.temperature), mass = share.pick(bed->masses());
    std::vector<heat_bath<double>> baths(own);
    for (std::size_t r = 0; r < rings.size(); ++r) {
        if (!share.is_my_ring(r)) continue;
        temperature.push_back(rings.temperature()[r]);
        baths.emplace_back();
        baths.back().add(conductive_link<double>{rings.conductance(r)}, rings.ambient(r));
    }
    mass.resize(temperature.size(), ring_mass);
    std::vector<particle_step<double>> taken;
    network.advance(nodes.pairs(), baths, mass, [](std::size_t) { return spinel{}; }, clock, process_step / clock.factor(0), temperature,
                    taken, nodes.halo());
    // Rings lie in order of rank, as the slabs do.
    std::vector<double> lost;
    for (std::size_t k = own; k < taken.size(); ++k) lost.push_back(-taken[k].conducted / process_step);
    for (const double power : among.gather(lost)) wall_loss += power;
    const auto of_rings = temperature.begin() + static_cast<std::ptrdiff_t>(own);
    rings.temperature() = among.gather(std::vector<double>(of_rings, temperature.end()));
    temperature.resize(own);
    share.gather(temperature, fields.temperature);
    tell_mechanisms();
}

/// What each parcel gets by radiation, by conduction and from the wall, as temperatures are after the step.
void furnace::parts::tell_mechanisms() {
    const std::vector<double>& t = fields.temperature;
    std::vector<double> radiated(t.size()), conducted(t.size()), walled(t.size());
    std::size_t k = 0;
    for (const link_part& part : links.parts) {
        std::vector<double>& heat = part.term == 0 ? radiated : conducted;
        for (; k < part.pairs; ++k) {
            const auto& pair = links.pairs[k];
            const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
            const double to_first = pair.link.secant(t[i], t[j]) * (t[j] - t[i]);
            heat[i] += to_first;
            heat[j] -= to_first;
        }
    }
    for (const auto& wall : links.walls) {
        const auto i = static_cast<std::size_t>(wall.particle);
        const double ring = rings.temperature()[static_cast<std::size_t>(wall.patch)];
        walled[i] += wall.link.secant(t[i], ring) * (ring - t[i]);
    }
    share.gather(share.pick(radiated), fields.radiated);
    share.gather(share.pick(conducted), fields.conducted);
    share.gather(share.pick(walled), fields.from_wall);
}

}  // namespace hearth::furnace
