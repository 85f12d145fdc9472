// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/element.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/core/unique_ids.hpp>

namespace hearth {

/// A particle as the cells see it.
struct visitor {
    std::int64_t id;  ///< persistent, unique over all ranks
    point position;   ///< centre [m]
    double radius;    ///< [m]

    double volume() const { return 4.0 / 3.0 * constants<double>::pi() * radius * radius * radius; }  ///< [m^3]
};

/// The particles that may touch the cells of this rank, in the order of their ids, whichever rank owns them; and the
/// way for values from the owners to them and back.
///
/// A particle visits every rank whose cells' reach meets it (see cell_locator): particles larger than cells, across
/// ranks and across periodic boundaries need nothing else.  Ids are the host's global indices; in serial the particle
/// numbers where the host has no others.
/// Errors: bad_value for positions that are not finite, radii that are not finite and positive, a sphere larger than
/// the whole mesh, and duplicate ids.  Thrown on every rank.
template <class Communicator = serial_communicator>
class visitors {
  public:
    template <class Mesh, class Cloud>
    visitors(const cell_locator<Mesh, Communicator>& locator, const Cloud& cloud)
        : communicator_(locator.communicator()) {
        require_particle_cloud<Cloud>();
        if constexpr (is_particle_cloud_v<Cloud>) {
            static_assert(
                !Communicator::is_distributed || detail::has_particle_index_v<Cloud>,
                "hearth: particle_traits<Cloud> lacks  std::int64_t global_index(cloud, i), needed on several "
                "ranks");
            read(cloud, locator.total_volume());
            throw_agreed(communicator_, wrong_);
            check_unique();
            throw_agreed(communicator_, wrong_);
            if constexpr (Communicator::is_distributed) {
                ship(locator);
            } else {
                all_ = owned_;
            }
            sort();
        }
    }

    std::size_t size() const { return all_.size(); }
    const visitor& operator[](std::size_t k) const { return all_[k]; }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }

    /// Particles that this rank owns, in the host's order.
    std::size_t owned_count() const { return owned_.size(); }
    const Communicator& communicator() const { return communicator_; }

    /// An owned particle, in the host's order.
    const visitor& owned(std::size_t particle) const { return owned_[particle]; }

    /// What this rank holds [bytes].
    std::size_t memory() const {
        std::size_t sum = (owned_.capacity() + all_.capacity()) * sizeof(visitor) +
                          order_.capacity() * sizeof(order_[0]) + received_.capacity() * sizeof(received_[0]);
        for (const auto& to : sent_) sum += sizeof(to) + to.values.capacity() * sizeof(to.values[0]);
        return sum;
    }

    /// Brings a value of each owned particle to its visitors: the k-th result belongs to the k-th visitor.
    template <class Value>
    std::vector<Value> bring(const std::vector<Value>& at_owner) const {
        std::vector<Value> arrived;
        if constexpr (Communicator::is_distributed) {
            std::vector<parcel<Value>> outgoing;
            for (const parcel<std::int32_t>& to : sent_) {
                outgoing.push_back({to.rank, {}});
                for (const std::int32_t i : to.values) {
                    outgoing.back().values.push_back(at_owner[static_cast<std::size_t>(i)]);
                }
            }
            for (const auto& from : communicator_.exchange(std::move(outgoing))) {
                arrived.insert(arrived.end(), from.values.begin(), from.values.end());
            }
        }
        const std::vector<Value>& values = Communicator::is_distributed ? arrived : at_owner;
        if (order_.empty()) return values;
        std::vector<Value> result;
        result.reserve(all_.size());
        for (const std::uint32_t k : order_) result.push_back(values[k]);
        return result;
    }

    /// Takes a value of each visitor back to its owner: calls combine(owned particle, value) for every visit.  The
    /// order of the visits of one particle depends on the ranks, so combine must not: it adds integers or takes a
    /// minimum.
    template <class Value, class Combine>
    void take_back(const std::vector<Value>& at_visitors, Combine&& combine) const {
        std::vector<Value> unsorted(at_visitors);
        for (std::size_t k = 0; k < order_.size(); ++k) unsorted[order_[k]] = at_visitors[k];
        if constexpr (Communicator::is_distributed) {
            std::vector<parcel<Value>> outgoing;
            for (const link& from : received_) {
                outgoing.push_back({from.rank,
                                    {unsorted.begin() + static_cast<std::ptrdiff_t>(from.begin),
                                     unsorted.begin() + static_cast<std::ptrdiff_t>(from.end)}});
            }
            // Every rank that was visited answers, in order of rank: the parcels match those sent.
            const auto incoming = communicator_.exchange(std::move(outgoing));
            for (std::size_t r = 0; r < incoming.size(); ++r) {
                for (std::size_t k = 0; k < incoming[r].values.size(); ++k) {
                    combine(static_cast<std::size_t>(sent_[r].values[k]), incoming[r].values[k]);
                }
            }
        } else {
            for (std::size_t i = 0; i < unsorted.size(); ++i) combine(i, unsorted[i]);
        }
    }

  private:
    void complain(const char* place, std::int64_t id, double value, const char* allowed) {
        if (!wrong_) wrong_.emplace(place, id, value, allowed);
    }

    template <class Cloud>
    void read(const Cloud& cloud, double mesh_volume) {
        using traits = particle_traits<Cloud>;
        const auto count = traits::particle_count(cloud);
        owned_.reserve(static_cast<std::size_t>(count));
        for (auto i = decltype(count){0}; i < count; ++i) {
            visitor v{};
            v.id = particle_global_index(cloud, i);
            const auto position = traits::get(quantity::position{}, cloud, i);
            for (std::size_t a = 0; a < 3; ++a) {
                v.position[a] = static_cast<double>(element(position, a));
                if (!std::isfinite(v.position[a])) complain("position of particle", v.id, v.position[a], "finite [m]");
            }
            v.radius = static_cast<double>(traits::get(quantity::radius{}, cloud, i));
            if (!(v.radius > 0 && std::isfinite(v.radius))) {
                complain("radius of particle", v.id, v.radius, "finite and > 0 [m]");
            } else if (!(v.volume() <= mesh_volume)) {
                complain("radius of particle", v.id, v.radius, "at most that of a sphere as large as the mesh [m]");
            }
            owned_.push_back(v);
        }
    }

    void check_unique() {
        std::vector<std::int64_t> ids;
        ids.reserve(owned_.size());
        for (const visitor& v : owned_) ids.push_back(v.id);
        if (const auto twice = find_duplicate(communicator_, std::move(ids))) {
            complain("global index of particle", *twice, static_cast<double>(*twice),
                     "unique over all particles and ranks");
        }
    }

    template <class Mesh>
    void ship(const cell_locator<Mesh, Communicator>& locator) {
        std::vector<parcel<visitor>> outgoing;
        for (int r = 0; r < communicator_.size(); ++r) {
            const box& target = locator.reach_of_ranks()[static_cast<std::size_t>(r)];
            parcel<visitor> particles{r, {}};
            parcel<std::int32_t> numbers{r, {}};
            for (std::size_t i = 0; i < owned_.size(); ++i) {
                bool visits = false;
                locator.for_each_image(owned_[i].position, owned_[i].radius, target,
                                       [&](const point&) { visits = true; });
                if (!visits) continue;
                particles.values.push_back(owned_[i]);
                numbers.values.push_back(static_cast<std::int32_t>(i));
            }
            if (numbers.values.empty()) continue;
            outgoing.push_back(std::move(particles));
            sent_.push_back(std::move(numbers));
        }
        for (const auto& from : communicator_.exchange(std::move(outgoing))) {
            received_.push_back({from.rank, all_.size(), all_.size() + from.values.size()});
            all_.insert(all_.end(), from.values.begin(), from.values.end());
        }
    }

    /// Orders the visitors by id; order_ stays empty where they are in order already.
    void sort() {
        const auto before = [](const visitor& a, const visitor& b) { return a.id < b.id; };
        if (std::is_sorted(all_.begin(), all_.end(), before)) return;
        order_.resize(all_.size());
        std::iota(order_.begin(), order_.end(), 0U);
        std::sort(order_.begin(), order_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return before(all_[a], all_[b]); });
        std::vector<visitor> sorted;
        sorted.reserve(all_.size());
        for (const std::uint32_t k : order_) sorted.push_back(all_[k]);
        all_ = std::move(sorted);
    }

    Communicator communicator_;
    std::optional<bad_value> wrong_;
    std::vector<visitor> owned_;
    std::vector<visitor> all_;
    std::vector<std::uint32_t> order_;        // place of the k-th visitor before sorting
    std::vector<parcel<std::int32_t>> sent_;  // owned particles, by the rank that they visit
    std::vector<link> received_;              // visitors before sorting, by the rank that owns them
};

}  // namespace hearth
