// SPDX-License-Identifier: MIT
#include <hearth/core/element.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <type_traits>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include <hearth/core/strided_cloud.hpp>

namespace {

/// A field that is indexed with one integer type, as OpenFOAM's are with a 32-bit label and its vectors with a byte.
template <class Index>
struct narrow {
    double values[3] = {10, 20, 30};
    double& operator[](Index i) { return values[i]; }
    double operator[](Index i) const { return values[i]; }
};

/// Any integer.
struct open {
    double values[3] = {10, 20, 30};
    template <class Index, class = std::enable_if_t<std::is_integral_v<Index>>>
    double& operator[](Index i) {
        return values[i];
    }
};

/// Several index types.
struct overloaded : narrow<int>, narrow<std::size_t> {
    using narrow<int>::operator[];
    using narrow<std::size_t>::operator[];
};

template <class Field, class Index>
void reads_and_writes(Field&& field, Index i) {
    hearth::element(field, i) = 25;
    CHECK(static_cast<double>(hearth::element(field, i)) == 25);
    CHECK(static_cast<double>(hearth::element(field, i - 1)) == 10);
}

template <class Index>
void all_fields() {
    const auto second = static_cast<Index>(1);
    reads_and_writes(std::vector<double>{10, 20, 30}, second);
    reads_and_writes(std::vector<float>{10, 20, 30}, second);
    reads_and_writes(std::deque<double>{10, 20, 30}, second);
    reads_and_writes(std::array<double, 3>{10, 20, 30}, second);
    reads_and_writes(Eigen::VectorXd{Eigen::Vector3d{10, 20, 30}}, second);
    double plain[] = {10, 20, 30};
    reads_and_writes(&plain[0], second);
    reads_and_writes(plain, second);
    double rows[] = {10, 0, 20, 0};
    reads_and_writes(hearth::strided<double>{rows, 2}, second);
    reads_and_writes(narrow<std::int32_t>{}, second);
    reads_and_writes(narrow<unsigned char>{}, second);
    reads_and_writes(open{}, second);
}

}  // namespace

TEST_CASE("element: reads and writes fields of any index type, by numbers of any integer type") {
    all_fields<std::int32_t>();
    all_fields<std::int64_t>();
    all_fields<std::size_t>();
    const narrow<std::int32_t> constant;
    CHECK(hearth::element(constant, std::size_t{2}) == 30);
    overloaded both;
    hearth::element(both, 1) = 25;  // the base of std::size_t
    CHECK(both.narrow<std::size_t>::values[1] == 25);
}
