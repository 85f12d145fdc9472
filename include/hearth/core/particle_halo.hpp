// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/communicator.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/unique_ids.hpp>

namespace hearth {

/// A copy of a particle that another rank owns.
struct ghost_particle {
    std::int64_t id;  ///< unique over all ranks
    int owner;        ///< rank
};

/// Which particles other ranks hold as ghosts, and which ghosts come from where: what halo (halo.hpp) is for cells.
/// Fields hold the owned particles first, then the ghosts in the host's own order.
///
/// `particle_halo<>` is that of one rank: no ghosts, and every call is free.
template <class Communicator = serial_communicator>
class particle_halo {
  public:
    particle_halo() = default;

    /// `owned` are the ids of this rank's particles, `ghosts` its ghosts, each once.  All ranks call it.  Throws
    /// bad_value, the same on every rank, for an id that is owned twice, and for a ghost whose owner is no other rank
    /// or does not own it.
    particle_halo(Communicator communicator, std::vector<std::int64_t> owned, const std::vector<ghost_particle>& ghosts)
        : communicator_(std::move(communicator)), ids_(std::move(owned)), ghost_count_(ghosts.size()) {
        const std::size_t count = ids_.size();
        const auto refuse = [&](const ghost_particle& ghost) {
            return bad_value("owner of ghost particle", ghost.id, ghost.owner, "another rank, which owns the particle");
        };
        std::optional<bad_value> wrong;
        for (const ghost_particle& ghost : ghosts)
            if (ghost.owner < 0 || ghost.owner >= communicator_.size() || ghost.owner == communicator_.rank())
                wrong = refuse(ghost);
        throw_agreed(communicator_, wrong);
        if (const auto twice = find_duplicate(communicator_, ids_))
            wrong = bad_value("id of particle", *twice, static_cast<double>(*twice), "unique over all ranks");
        throw_agreed(communicator_, wrong);

        // Ghosts by rank; each owner is asked for its own.
        order_.resize(ghosts.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return ghosts[a].owner < ghosts[b].owner; });
        std::vector<parcel<std::int64_t>> asked;
        for (std::size_t k = 0; k < order_.size(); ++k) {
            const ghost_particle& ghost = ghosts[order_[k]];
            ids_.push_back(0);
            if (asked.empty() || asked.back().rank != ghost.owner) {
                asked.push_back({ghost.owner, {}});
                imports_.push_back({ghost.owner, k, k});
            }
            asked.back().values.push_back(ghost.id);
            imports_.back().end = k + 1;
        }
        for (std::size_t g = 0; g < ghosts.size(); ++g) ids_[count + g] = ghosts[g].id;

        std::vector<std::size_t> by_id(count);
        std::iota(by_id.begin(), by_id.end(), std::size_t{0});
        std::sort(by_id.begin(), by_id.end(), [&](std::size_t a, std::size_t b) { return ids_[a] < ids_[b]; });
        for (const auto& from : communicator_.exchange(std::move(asked))) {
            exports_.push_back({from.rank, exported_.size(), exported_.size() + from.values.size()});
            for (const std::int64_t id : from.values) {
                const auto found =
                    std::lower_bound(by_id.begin(), by_id.end(), id,
                                     [&](std::size_t i, std::int64_t wanted) { return ids_[i] < wanted; });
                if (found == by_id.end() || ids_[*found] != id)
                    wrong = refuse({id, communicator_.rank()});
                else
                    exported_.push_back(*found);
            }
        }
        throw_agreed(communicator_, wrong);
    }

    const Communicator& communicator() const { return communicator_; }
    std::size_t ghost_count() const { return ghost_count_; }

    /// Global ids of the owned particles, then of the ghosts; empty for one rank.
    const std::vector<std::int64_t>& ids() const { return ids_; }

    /// Ghosts of one owner after the other: (rank, begin, end) of places in order().
    const std::vector<link>& imports() const { return imports_; }
    const std::vector<std::size_t>& order() const { return order_; }

    /// Copies the owners' values of a field to its ghosts.
    template <class Value>
    void gather(std::vector<Value>& field) const {
        if constexpr (Communicator::is_distributed) {
            std::vector<Value> outgoing, incoming(ghost_count_);
            outgoing.reserve(exported_.size());
            for (const std::size_t i : exported_) outgoing.push_back(field[i]);
            auto under_way = communicator_.begin(outgoing.data(), exports_, incoming.data(), imports_);
            communicator_.end(under_way);
            const std::size_t owned = ids_.size() - ghost_count_;
            for (std::size_t k = 0; k < ghost_count_; ++k) field[owned + order_[k]] = incoming[k];
        }
    }

  private:
    Communicator communicator_{};
    std::vector<std::int64_t> ids_;
    std::size_t ghost_count_ = 0;
    std::vector<std::size_t> exported_, order_;
    std::vector<link> exports_, imports_;
};

}  // namespace hearth
