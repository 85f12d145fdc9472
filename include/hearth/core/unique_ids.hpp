// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <hearth/core/communicator.hpp>

namespace hearth {

/// An id that occurs twice over all ranks, if there is one.  Each id is checked by the rank id modulo size, so only
/// that rank finds it: follow with throw_agreed.
template <class Communicator>
std::optional<std::int64_t> find_duplicate(const Communicator& communicator, std::vector<std::int64_t> ids) {
    if constexpr (Communicator::is_distributed) {
        const std::int64_t size = communicator.size();
        std::vector<parcel<std::int64_t>> outgoing(static_cast<std::size_t>(size));
        for (int r = 0; r < communicator.size(); ++r) outgoing[static_cast<std::size_t>(r)].rank = r;
        for (const std::int64_t id : ids) {
            outgoing[static_cast<std::size_t>(((id % size) + size) % size)].values.push_back(id);
        }
        ids.clear();
        for (const auto& from : communicator.exchange(std::move(outgoing))) {
            ids.insert(ids.end(), from.values.begin(), from.values.end());
        }
    }
    if (!std::is_sorted(ids.begin(), ids.end())) std::sort(ids.begin(), ids.end());
    const auto twice = std::adjacent_find(ids.begin(), ids.end());
    return twice == ids.end() ? std::nullopt : std::optional<std::int64_t>(*twice);
}

}  // namespace hearth
