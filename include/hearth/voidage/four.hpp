// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace hearth::detail {

/// A number each of four fields in the same cell or particle.  What visits cells by lists of neighbours then reads the
/// lists once for all four, and four numbers of one cache line; each field gets the bits that it would get alone
/// (where the compiler contracts nothing to fused multiply-adds).
struct four {
    static constexpr std::size_t size = 4;
    std::array<double, size> of{};

    four& operator+=(const four& other) {
        for (std::size_t k = 0; k < size; ++k) of[k] += other.of[k];
        return *this;
    }
    four& operator*=(double factor) {
        for (double& value : of) value *= factor;
        return *this;
    }
    four& operator/=(double divisor) {
        for (double& value : of) value /= divisor;
        return *this;
    }
    friend four operator+(four a, const four& b) { return a += b; }
    friend four operator-(four a, const four& b) {
        for (std::size_t k = 0; k < size; ++k) a.of[k] -= b.of[k];
        return a;
    }
    friend four operator*(double factor, four a) { return a *= factor; }
};

template <class Value>
inline constexpr std::size_t fields_in = std::is_same_v<Value, four> ? four::size : 1;

/// The k-th number of a value.
inline double& number(double& value, std::size_t) { return value; }
inline const double& number(const double& value, std::size_t) { return value; }
inline double& number(four& value, std::size_t k) { return value.of[k]; }
inline const double& number(const four& value, std::size_t k) { return value.of[k]; }

/// One field of several that are stored together, as a field.
template <class Value>
class one_of {
  public:
    one_of(std::vector<Value>& fields, std::size_t k) : fields_(&fields), k_(k) {}
    double& operator[](std::size_t i) const { return number((*fields_)[i], k_); }

  private:
    std::vector<Value>* fields_;
    std::size_t k_;
};

}  // namespace hearth::detail
