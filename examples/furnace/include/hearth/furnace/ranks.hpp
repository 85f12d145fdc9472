// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/communicator.hpp>

namespace hearth::furnace {

/// The ranks that share a furnace: any communicator of hearth behind one type, so that the furnace is compiled once and
/// sees no MPI.  By default there is one rank.
///
///     hearth::furnace::furnace shaft(scene, hearth::mpi::communicator());
///
/// It is a communicator itself; see serial_communicator for what each call means.
class ranks {
  public:
    static constexpr bool is_distributed = true;

    ranks() : ranks(serial_communicator{}) {}
    template <class Communicator, class = std::enable_if_t<!std::is_same_v<std::decay_t<Communicator>, ranks>>>
    ranks(Communicator communicator) : among_(std::make_shared<model<Communicator>>(std::move(communicator))) {}

    int rank() const { return among_->rank(); }
    int size() const { return among_->size(); }
    bool any(bool mine) const { return among_->any(mine); }
    double max(double mine) const { return among_->max(mine); }
    std::int64_t max(std::int64_t mine) const { return among_->max(mine); }
    void sum(std::int64_t* values, std::size_t count) const { among_->sum(values, count); }

    template <class Value>
    std::vector<parcel<Value>> exchange(std::vector<parcel<Value>> outgoing) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::vector<parcel<char>> bytes;
        for (const parcel<Value>& to : outgoing) {
            const auto* first = reinterpret_cast<const char*>(to.values.data());
            bytes.push_back({to.rank, {first, first + to.values.size() * sizeof(Value)}});
        }
        std::vector<parcel<Value>> incoming;
        for (const parcel<char>& from : among_->exchange(std::move(bytes))) {
            incoming.push_back({from.rank, std::vector<Value>(from.values.size() / sizeof(Value))});
            copy_bytes(from.values, incoming.back().values);
        }
        return incoming;
    }

    using request = std::shared_ptr<void>;
    template <class Value>
    request begin(const Value* outgoing, const std::vector<link>& exports, Value* incoming, const std::vector<link>& imports) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        return among_->begin(reinterpret_cast<const char*>(outgoing), in_bytes(exports, sizeof(Value)),
                             reinterpret_cast<char*>(incoming), in_bytes(imports, sizeof(Value)));
    }
    void end(request& under_way) const {
        among_->end(under_way.get());
        under_way.reset();
    }

    /// The values of all ranks, in order of rank, on every rank.
    template <class Value>
    std::vector<Value> gather(const std::vector<Value>& mine) const {
        if (size() == 1) return mine;
        std::vector<parcel<Value>> outgoing;
        for (int r = 0; r < size(); ++r) outgoing.push_back({r, mine});
        return joined(exchange(std::move(outgoing)));
    }
    /// The same on rank 0 alone; nothing on the others.
    template <class Value>
    std::vector<Value> gather_on_first(const std::vector<Value>& mine) const {
        if (size() == 1) return mine;
        return joined(exchange(std::vector<parcel<Value>>{{0, mine}}));
    }

  private:
    struct concept_of_ranks {
        virtual ~concept_of_ranks() = default;
        virtual int rank() const = 0;
        virtual int size() const = 0;
        virtual bool any(bool mine) const = 0;
        virtual double max(double mine) const = 0;
        virtual std::int64_t max(std::int64_t mine) const = 0;
        virtual void sum(std::int64_t* values, std::size_t count) const = 0;
        virtual std::vector<parcel<char>> exchange(std::vector<parcel<char>> outgoing) const = 0;
        virtual request begin(const char* outgoing, const std::vector<link>& exports, char* incoming,
                              const std::vector<link>& imports) const = 0;
        virtual void end(void* under_way) const = 0;
    };
    template <class Communicator>
    struct model final : concept_of_ranks {
        explicit model(Communicator c) : communicator(std::move(c)) {}
        int rank() const override { return communicator.rank(); }
        int size() const override { return communicator.size(); }
        bool any(bool mine) const override { return communicator.any(mine); }
        double max(double mine) const override { return communicator.max(mine); }
        std::int64_t max(std::int64_t mine) const override { return communicator.max(mine); }
        void sum(std::int64_t* values, std::size_t count) const override { communicator.sum(values, count); }
        std::vector<parcel<char>> exchange(std::vector<parcel<char>> outgoing) const override {
            return communicator.exchange(std::move(outgoing));
        }
        using pending = typename Communicator::request;
        request begin(const char* outgoing, const std::vector<link>& exports, char* incoming,
                      const std::vector<link>& imports) const override {
            return std::make_shared<pending>(communicator.begin(outgoing, exports, incoming, imports));
        }
        void end(void* under_way) const override { communicator.end(*static_cast<pending*>(under_way)); }

        Communicator communicator;
    };

    template <class Value>
    static void copy_bytes(const std::vector<char>& from, std::vector<Value>& to) {
        std::copy(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(to.size() * sizeof(Value)), reinterpret_cast<char*>(to.data()));
    }
    static std::vector<link> in_bytes(std::vector<link> links, std::size_t size) {
        for (link& l : links) l = {l.rank, l.begin * size, l.end * size};
        return links;
    }
    template <class Value>
    static std::vector<Value> joined(const std::vector<parcel<Value>>& parts) {
        std::vector<Value> all;
        for (const parcel<Value>& from : parts) all.insert(all.end(), from.values.begin(), from.values.end());
        return all;
    }

    std::shared_ptr<concept_of_ranks> among_;
};

}  // namespace hearth::furnace
