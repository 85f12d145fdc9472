// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <hearth/core/communicator.hpp>

namespace hearth::mpi {

/// The communicator of a program that runs on several ranks: see serial_communicator for what each call means.
///
/// Borrows the host's MPI_Comm; never initialises, duplicates, frees or finalises.  Messages carry the tag below: a host
/// that receives with MPI_ANY_TAG on the same communicator passes a duplicate of it (MPI_Comm_dup).  Errors of MPI go to
/// the handler that the host has set.
class communicator {
  public:
    static constexpr bool is_distributed = true;
    static constexpr int tag = 21467;

    explicit communicator(MPI_Comm borrowed = MPI_COMM_WORLD) : comm_(borrowed) {
        MPI_Comm_rank(comm_, &rank_);
        MPI_Comm_size(comm_, &size_);
    }

    MPI_Comm native() const { return comm_; }
    int rank() const { return rank_; }
    int size() const { return size_; }

    bool any(bool mine) const {
        int all = mine ? 1 : 0;
        MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_LOR, comm_);
        return all != 0;
    }
    double max(double mine) const {
        MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, comm_);
        return mine;
    }
    std::int64_t max(std::int64_t mine) const {
        MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_INT64_T, MPI_MAX, comm_);
        return mine;
    }
    void sum(std::int64_t* values, std::size_t count) const {
        MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(count), MPI_INT64_T, MPI_SUM, comm_);
    }

    template <class Value>
    std::vector<parcel<Value>> exchange(std::vector<parcel<Value>> outgoing) const {
        const auto ranks = static_cast<std::size_t>(size_);
        std::vector<std::int64_t> outgoing_count(ranks, 0), incoming_count(ranks, 0);
        for (const auto& to : outgoing) {
            outgoing_count[static_cast<std::size_t>(to.rank)] = static_cast<std::int64_t>(to.values.size());
        }
        MPI_Alltoall(outgoing_count.data(), 1, MPI_INT64_T, incoming_count.data(), 1, MPI_INT64_T, comm_);
        const value_type<Value> type;
        std::vector<parcel<Value>> incoming;
        for (int r = 0; r < size_; ++r) {
            const auto count = static_cast<std::size_t>(incoming_count[static_cast<std::size_t>(r)]);
            if (count > 0) incoming.push_back({r, std::vector<Value>(count)});
        }
        request under_way;
        for (auto& from : incoming) receive(from.values.data(), from.values.size(), type, from.rank, under_way);
        for (const auto& to : outgoing) {
            if (!to.values.empty()) send(to.values.data(), to.values.size(), type, to.rank, under_way);
        }
        end(under_way);
        return incoming;
    }

    /// Messages under way.
    class request {
        std::vector<MPI_Request> requests_;
        friend class communicator;
    };

    template <class Value>
    request begin(const Value* outgoing, const std::vector<link>& exports, Value* incoming,
                  const std::vector<link>& imports) const {
        const value_type<Value> type;
        request under_way;
        under_way.requests_.reserve(exports.size() + imports.size());
        for (const link& from : imports) {
            receive(incoming + from.begin, from.end - from.begin, type, from.rank, under_way);
        }
        for (const link& to : exports) send(outgoing + to.begin, to.end - to.begin, type, to.rank, under_way);
        return under_way;
    }

    void end(request& under_way) const {
        MPI_Waitall(static_cast<int>(under_way.requests_.size()), under_way.requests_.data(), MPI_STATUSES_IGNORE);
        under_way.requests_.clear();
    }

  private:
    /// A value as so many bytes, so that counts stay below 2^31 for any message that fits in memory.
    template <class Value>
    class value_type {
        static_assert(std::is_trivially_copyable_v<Value>);

      public:
        value_type() {
            MPI_Type_contiguous(static_cast<int>(sizeof(Value)), MPI_BYTE, &type_);
            MPI_Type_commit(&type_);
        }
        value_type(const value_type&) = delete;
        value_type& operator=(const value_type&) = delete;
        ~value_type() { MPI_Type_free(&type_); }  // MPI keeps it until pending messages are done
        operator MPI_Datatype() const { return type_; }

      private:
        MPI_Datatype type_ = MPI_DATATYPE_NULL;
    };

    template <class Value>
    void receive(Value* values, std::size_t count, MPI_Datatype type, int from, request& under_way) const {
        under_way.requests_.emplace_back();
        MPI_Irecv(values, static_cast<int>(count), type, from, tag, comm_, &under_way.requests_.back());
    }
    template <class Value>
    void send(const Value* values, std::size_t count, MPI_Datatype type, int to, request& under_way) const {
        under_way.requests_.emplace_back();
        MPI_Isend(values, static_cast<int>(count), type, to, tag, comm_, &under_way.requests_.back());
    }

    MPI_Comm comm_;
    int rank_ = 0;
    int size_ = 1;
};

}  // namespace hearth::mpi
