// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <hearth/core/communicator.hpp>
#include <hearth/core/error.hpp>

namespace hearth {

/// Throws the same bad_value on every rank if any rank found one (that of the lowest rank), so that no rank waits for
/// another that gave up.  Called by all ranks after each has looked at its own input.
template <class Communicator>
void throw_agreed(const Communicator& communicator, const std::optional<bad_value>& mine) {
    if constexpr (!Communicator::is_distributed) {
        if (mine) throw bad_value(*mine);
    } else {
        const std::int64_t last = communicator.size() - 1;
        const std::int64_t first = last - communicator.max(mine ? last - communicator.rank() : std::int64_t{-1});
        if (first > last) return;
        std::vector<parcel<char>> outgoing;
        if (communicator.rank() == first) {
            std::vector<char> bytes(sizeof(std::int64_t) + sizeof(double));
            std::memcpy(bytes.data(), &mine->index, sizeof(std::int64_t));
            std::memcpy(bytes.data() + sizeof(std::int64_t), &mine->value, sizeof(double));
            bytes.insert(bytes.end(), mine->place.c_str(), mine->place.c_str() + mine->place.size() + 1);
            bytes.insert(bytes.end(), mine->allowed.c_str(), mine->allowed.c_str() + mine->allowed.size() + 1);
            for (int r = 0; r < communicator.size(); ++r) {
                if (r != first) outgoing.push_back({r, bytes});
            }
        }
        const auto incoming = communicator.exchange(std::move(outgoing));
        if (communicator.rank() == first) throw bad_value(*mine);
        const std::vector<char>& bytes = incoming.front().values;
        std::int64_t index = 0;
        double value = 0;
        std::memcpy(&index, bytes.data(), sizeof index);
        std::memcpy(&value, bytes.data() + sizeof index, sizeof value);
        const std::string place = bytes.data() + sizeof index + sizeof value;
        const std::string allowed = bytes.data() + sizeof index + sizeof value + place.size() + 1;
        throw bad_value(place, index, value, allowed);
    }
}

}  // namespace hearth
