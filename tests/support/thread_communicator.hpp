// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include <hearth/core/communicator.hpp>

namespace hearth::test {

/// Ranks as threads of one process: distributed code is tested without MPI, under sanitisers, on any number of ranks.
/// A rank that throws wakes the others, which then throw rank_gave_up: a missing agreement shows as that, not as a hang.
struct rank_gave_up : std::runtime_error {
    rank_gave_up() : std::runtime_error("another rank threw while this one waited for it") {}
};

class thread_communicator {
  public:
    static constexpr bool is_distributed = true;

    /// What the ranks share: one table of byte messages, and a barrier.
    struct shared {
        explicit shared(int size_) : size(size_), boxes(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_)) {}

        void wait() {
            std::unique_lock lock(mutex);
            if (failed) throw rank_gave_up();
            const int mine = turn;
            if (++waiting == size) {
                waiting = 0;
                ++turn;
                changed.notify_all();
                return;
            }
            changed.wait(lock, [&] { return turn != mine || failed; });
            if (turn == mine) throw rank_gave_up();
        }
        void fail() {
            const std::lock_guard lock(mutex);
            failed = true;
            changed.notify_all();
        }

        const int size;
        std::vector<std::vector<char>> boxes;  // from * size + to
        std::mutex mutex;
        std::condition_variable changed;
        int waiting = 0;
        int turn = 0;
        bool failed = false;
    };

    thread_communicator(std::shared_ptr<shared> common, int rank) : common_(std::move(common)), rank_(rank) {}
    thread_communicator() = default;  // as halo holds one before it is built

    int rank() const { return rank_; }
    int size() const { return common_->size; }

    bool any(bool mine) const { return max(std::int64_t{mine}) != 0; }
    double max(double mine) const { return largest(all(mine)); }
    std::int64_t max(std::int64_t mine) const { return largest(all(mine)); }
    void sum(std::int64_t* values, std::size_t count) const {
        for (std::size_t k = 0; k < count; ++k) {
            std::int64_t total = 0;
            for (const std::int64_t v : all(values[k])) total += v;
            values[k] = total;
        }
    }

    template <class Value>
    std::vector<parcel<Value>> exchange(std::vector<parcel<Value>> outgoing) const {
        for (const auto& to : outgoing) put(to.rank, to.values.data(), to.values.size());
        common_->wait();
        std::vector<parcel<Value>> incoming;
        for (int r = 0; r < size(); ++r) {
            std::vector<char>& bytes = box(r, rank_);
            if (bytes.empty()) continue;
            incoming.push_back({r, std::vector<Value>(bytes.size() / sizeof(Value))});
            std::memcpy(static_cast<void*>(incoming.back().values.data()), bytes.data(), bytes.size());
            bytes.clear();
        }
        common_->wait();
        return incoming;
    }

    struct request {};
    template <class Value>
    request begin(const Value* outgoing, const std::vector<link>& exports, Value* incoming,
                  const std::vector<link>& imports) const {
        std::vector<parcel<Value>> parcels;
        for (const link& to : exports) parcels.push_back({to.rank, {outgoing + to.begin, outgoing + to.end}});
        const auto received = exchange(std::move(parcels));
        if (received.size() != imports.size()) throw std::logic_error("a halo whose exports and imports do not match");
        for (std::size_t k = 0; k < imports.size(); ++k) {
            if (received[k].rank != imports[k].rank || received[k].values.size() != imports[k].end - imports[k].begin) {
                throw std::logic_error("a halo whose exports and imports do not match");
            }
            std::copy(received[k].values.begin(), received[k].values.end(), incoming + imports[k].begin);
        }
        return {};
    }
    void end(request&) const {}

  private:
    std::vector<char>& box(int from, int to) const {
        return common_->boxes[static_cast<std::size_t>(from) * static_cast<std::size_t>(size()) +
                              static_cast<std::size_t>(to)];
    }
    template <class Value>
    void put(int to, const Value* values, std::size_t count) const {
        std::vector<char>& bytes = box(rank_, to);
        bytes.resize(count * sizeof(Value));
        if (count > 0) std::memcpy(bytes.data(), static_cast<const void*>(values), bytes.size());
    }
    template <class Value>
    std::vector<Value> all(Value mine) const {
        std::vector<parcel<Value>> parcels;
        for (int r = 0; r < size(); ++r) parcels.push_back({r, {mine}});
        std::vector<Value> values;
        for (const auto& from : exchange(std::move(parcels))) values.push_back(from.values.front());
        return values;
    }
    template <class Value>
    static Value largest(const std::vector<Value>& values) {
        return *std::max_element(values.begin(), values.end());
    }

    std::shared_ptr<shared> common_;
    int rank_ = 0;
};

/// Runs body(communicator) on so many ranks at the same time; throws what the lowest rank threw of its own.
template <class Body>
void on_ranks(int size, Body&& body) {
    auto common = std::make_shared<thread_communicator::shared>(size);
    std::vector<std::exception_ptr> errors(static_cast<std::size_t>(size));
    std::vector<std::thread> threads;
    for (int r = 0; r < size; ++r) {
        threads.emplace_back([&, r] {
            try {
                body(thread_communicator(common, r));
            } catch (...) {
                errors[static_cast<std::size_t>(r)] = std::current_exception();
                common->fail();
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    std::exception_ptr waiting;
    for (const std::exception_ptr& error : errors) {
        if (!error) continue;
        try {
            std::rethrow_exception(error);
        } catch (const rank_gave_up&) {
            waiting = error;
        } catch (...) {
            throw;
        }
    }
    if (waiting) std::rethrow_exception(waiting);
}

}  // namespace hearth::test
