// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace hearth {

namespace detail {

/// A number that becomes the integer that it is asked for.
struct any_index {
    std::int64_t value;
    template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
    constexpr operator Integer() const {
        return static_cast<Integer>(value);
    }
};

template <class Field, class = void>
inline constexpr bool takes_any_index_v = false;
template <class Field>
inline constexpr bool takes_any_index_v<Field, std::void_t<decltype(std::declval<Field&>()[any_index{}])>> = true;

}  // namespace detail

/// field[i] of a host's field, whatever integer its operator[] takes: std::size_t of a std::vector, a 32-bit label of
/// OpenFOAM, std::ptrdiff_t of a pointer; where it takes several or any, std::size_t.
template <class Field, class Integer>
constexpr decltype(auto) element(Field&& field, Integer i) {
    if constexpr (detail::takes_any_index_v<Field>) {
        return field[detail::any_index{static_cast<std::int64_t>(i)}];
    } else {
        return field[static_cast<std::size_t>(i)];
    }
}

}  // namespace hearth
