// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace hearth::furnace {

/// Arrays of doubles, or of vectors of doubles, and single numbers, as arrays of doubles and back: for checkpoints.
template <class Item>
std::size_t flat_size(const Item& item) {
    if constexpr (std::is_arithmetic_v<Item>) {
        return 1;
    } else {
        static_assert(sizeof(typename Item::value_type) % sizeof(double) == 0, "made of doubles");
        return item.size() * sizeof(typename Item::value_type) / sizeof(double);
    }
}

template <class Item>
std::vector<double> to_flat(const Item& item) {
    if constexpr (std::is_arithmetic_v<Item>) {
        return {static_cast<double>(item)};
    } else {
        std::vector<double> flat(flat_size(item));
        if (!flat.empty()) std::memcpy(flat.data(), item.data(), flat.size() * sizeof(double));
        return flat;
    }
}

template <class Item>
void from_flat(const std::vector<double>& flat, Item& item) {
    if constexpr (std::is_arithmetic_v<Item>) {
        item = static_cast<Item>(flat.at(0));
    } else {
        using value = typename Item::value_type;
        item.assign(flat.size() * sizeof(double) / sizeof(value), value{});
        if (!flat.empty()) std::memcpy(static_cast<void*>(item.data()), flat.data(), flat.size() * sizeof(double));
    }
}

/// Bytes in the bits of numbers; the first number says how many.
inline std::vector<double> to_numbers(const std::vector<char>& bytes) {
    std::vector<double> numbers(1 + (bytes.size() + sizeof(double) - 1) / sizeof(double), 0.0);
    numbers[0] = static_cast<double>(bytes.size());
    if (!bytes.empty()) std::memcpy(numbers.data() + 1, bytes.data(), bytes.size());
    return numbers;
}

inline std::vector<char> to_bytes(const std::vector<double>& numbers) {
    if (numbers.empty() || numbers[0] < 0 || numbers[0] > static_cast<double>((numbers.size() - 1) * sizeof(double))) return {};
    std::vector<char> bytes(static_cast<std::size_t>(numbers[0]));
    if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data() + 1, bytes.size());
    return bytes;
}

}  // namespace hearth::furnace
