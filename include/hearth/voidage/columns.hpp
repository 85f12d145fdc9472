// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/element.hpp>
#include <hearth/voidage/four.hpp>

namespace hearth::detail {

/// A field or a std::tie of fields, seen as columns of numbers: one of a field of scalars, three of one of vectors.
template <class Field>
struct columns {
    using value = std::decay_t<decltype(element(std::declval<Field&>(), 0))>;
    static constexpr std::size_t count = std::is_arithmetic_v<value> ? 1 : 3;

    /// Calls visit(k-th column, field, component).
    template <class Any, class Visit>
    static void for_each(Any& field, std::size_t first, Visit&& visit) {
        for (std::size_t a = 0; a < count; ++a) visit(first + a, field, a);
    }
};

template <class... Fields>
struct columns<std::tuple<Fields...>> {
    static constexpr std::size_t count = (columns<std::remove_reference_t<Fields>>::count + ... + 0);

    template <class Tuple, class Visit>
    static void for_each(Tuple& fields, std::size_t first, Visit&& visit) {
        std::apply(
            [&](auto&... field) {
                ((columns<std::remove_reference_t<Fields>>::for_each(field, first, visit),
                  first += columns<std::remove_reference_t<Fields>>::count),
                 ...);
            },
            fields);
    }
};

/// Component a of a vector; of a scalar itself.
template <class Value>
double component(const Value& v, [[maybe_unused]] std::size_t a) {
    if constexpr (std::is_arithmetic_v<Value>) {
        return static_cast<double>(v);
    } else {
        return static_cast<double>(element(v, a));
    }
}

/// The first elements of the columns from `first` on, as many columns as a value holds; zero beyond the last.
template <class Value, class Fields>
void read_columns(const Fields& fields, std::size_t first, std::size_t count, std::vector<Value>& values) {
    values.assign(count, Value{});
    columns<Fields>::for_each(fields, 0, [&](std::size_t column, const auto& field, std::size_t a) {
        if (column < first || column >= first + fields_in<Value>) return;
        for (std::size_t i = 0; i < count; ++i) number(values[i], column - first) = component(element(field, i), a);
    });
}

/// The way back.
template <class Value, class Fields>
void write_columns(const std::vector<Value>& values, std::size_t first, std::size_t count, Fields& fields) {
    columns<Fields>::for_each(fields, 0, [&](std::size_t column, auto& field, std::size_t a) {
        if (column < first || column >= first + fields_in<Value>) return;
        for (std::size_t i = 0; i < count; ++i) {
            auto&& target = element(field, i);
            using target_type = std::decay_t<decltype(target)>;
            const double value = number(values[i], column - first);
            if constexpr (std::is_arithmetic_v<target_type>) {
                target = static_cast<target_type>(value);
            } else {
                auto&& along = element(target, a);
                along = static_cast<std::decay_t<decltype(along)>>(value);
            }
        }
    });
}

/// Calls work(first column, a value that tells how many columns at once: four, or double for a last one alone).
template <class Fields, class Work>
void for_each_block_of_columns(const Work& work) {
    constexpr std::size_t count = columns<Fields>::count, blocks = (count + 2) / four::size;
    for (std::size_t block = 0; block < blocks; ++block) work(block * four::size, four{});
    if constexpr (count % four::size == 1) work(blocks * four::size, double{});
}

}  // namespace hearth::detail
