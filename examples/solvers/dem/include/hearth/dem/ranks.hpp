// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/communicator.hpp>
#include <hearth/core/particle_halo.hpp>

namespace hearth::dem {

/// The ranks that share a bed, behind one interface: the solver is compiled once, without MPI.  Made by over().
/// All ranks make the same calls in the same order.
class ranks {
  public:
    static constexpr bool is_distributed = true;  // as a communicator for hearth's own algorithms

    virtual ~ranks() = default;
    virtual int rank() const = 0;
    virtual int size() const = 0;
    virtual double max(double mine) const = 0;
    virtual std::int64_t max(std::int64_t mine) const = 0;
    virtual void sum(std::int64_t* values, std::size_t count) const = 0;
    /// Sends each parcel to its rank and returns what came, in order of rank.  Throws std::length_error from 2 GB a
    /// parcel.
    virtual std::vector<parcel<char>> exchange(std::vector<parcel<char>> outgoing) const = 0;
    /// A pattern of messages, ended by end(); one at a time.
    virtual void begin(const char* outgoing, const std::vector<link>& exports, char* incoming,
                       const std::vector<link>& imports) = 0;
    virtual void end() = 0;

    double min(double mine) const { return -max(-mine); }
    bool any(bool mine) const { return max(mine ? 1.0 : 0.0) > 0; }
    std::int64_t sum(std::int64_t mine) const {
        sum(&mine, 1);
        return mine;
    }

    /// The values of all ranks, in order of rank.
    template <class Value>
    std::vector<Value> gather(const std::vector<Value>& mine) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        if (size() == 1) return mine;
        const auto* bytes = reinterpret_cast<const char*>(mine.data());
        std::vector<parcel<char>> outgoing;
        for (int r = 0; r < size(); ++r) outgoing.push_back({r, {bytes, bytes + mine.size() * sizeof(Value)}});
        std::vector<Value> all;
        for (const auto& from : exchange(std::move(outgoing))) {
            const std::size_t before = all.size();
            all.resize(before + from.values.size() / sizeof(Value));
            std::copy(from.values.begin(), from.values.end(), reinterpret_cast<char*>(all.data() + before));
        }
        return all;
    }
};

/// The ranks of a communicator: hearth::mpi::communicator, or hearth::serial_communicator.
template <class Communicator>
std::shared_ptr<ranks> over(Communicator communicator) {
    class model final : public ranks {
      public:
        explicit model(Communicator c) : communicator_(c) {}
        int rank() const override { return communicator_.rank(); }
        int size() const override { return communicator_.size(); }
        double max(double mine) const override { return communicator_.max(mine); }
        std::int64_t max(std::int64_t mine) const override { return communicator_.max(mine); }
        void sum(std::int64_t* values, std::size_t count) const override { communicator_.sum(values, count); }
        std::vector<parcel<char>> exchange(std::vector<parcel<char>> outgoing) const override {
            bool fits = true;
            for (const auto& to : outgoing) fits = fits && to.values.size() < std::numeric_limits<int>::max();
            if (communicator_.any(!fits)) {
                throw std::length_error(
                    "hearth: more than 2 GB of particles go from one rank to another at once; "
                    "insert them in several calls");
            }
            return communicator_.exchange(std::move(outgoing));
        }
        void begin(const char* outgoing, const std::vector<link>& exports, char* incoming,
                   const std::vector<link>& imports) override {
            under_way_ = communicator_.begin(outgoing, exports, incoming, imports);
        }
        void end() override { communicator_.end(under_way_); }

      private:
        Communicator communicator_;
        typename Communicator::request under_way_;
    };
    return std::make_shared<model>(communicator);
}

/// How a bed is spread over ranks: slabs across an axis, with as many particles each, cut anew as the bed moves.
/// Trajectories have the same bits on any number of ranks.
struct decomposition {
    std::shared_ptr<ranks> among = over(serial_communicator{});
    int axis = 2;            ///< of the cuts: 0, 1 or 2; slabs cost least across the longest side of the bed
    double near_factor = 0;  ///< largest factor that bed::for_each_near() is asked for [-]; 0: contacts alone
};

/// The ghosts of a bed on several ranks, in its order, for a hearth::particle_halo.
template <class Bed>
std::vector<ghost_particle> ghosts_of(const Bed& b) {
    std::vector<ghost_particle> found;
    for (auto i = b.size(); i < b.size() + b.ghost_count(); ++i)
        found.push_back({b.ids()[static_cast<std::size_t>(i)], b.ghost_owner(i)});
    return found;
}

}  // namespace hearth::dem
