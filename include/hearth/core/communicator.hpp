// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth {

/// Values that go to one rank, or came from it.
template <class Value>
struct parcel {
    int rank;
    std::vector<Value> values;
};

/// A part [begin, end) of a buffer that goes to, or comes from, one rank.
struct link {
    int rank;
    std::size_t begin;
    std::size_t end;
};

/// The communicator of a program that runs on one rank: every call is free.  It also says what a communicator must
/// offer; hearth::mpi::communicator is the other model.  A communicator is a cheap handle, copied by value.  All ranks
/// make the same calls in the same order.  Values are trivially copyable.
class serial_communicator {
  public:
    /// False: code for ghosts and other ranks is not compiled.
    static constexpr bool is_distributed = false;

    int rank() const { return 0; }
    int size() const { return 1; }

    /// True where any rank says true.
    bool any(bool mine) const { return mine; }
    /// Largest value over all ranks.
    double max(double mine) const { return mine; }
    std::int64_t max(std::int64_t mine) const { return mine; }
    /// Sums over all ranks, element by element.  Integers, so that the result cannot depend on the order.
    void sum(std::int64_t*, std::size_t) const {}

    /// Sends each parcel to its rank (a rank at most once) and returns what the others sent here, in order of rank.
    template <class Value>
    std::vector<parcel<Value>> exchange(std::vector<parcel<Value>> outgoing) const {
        return outgoing;  // only to itself
    }

    /// A fixed pattern, begun and ended so that work can go on between the two.  Both buffers stay alive until then.
    struct request {};
    template <class Value>
    request begin(const Value*, const std::vector<link>&, Value*, const std::vector<link>&) const {
        return {};
    }
    void end(request&) const {}
};

}  // namespace hearth
