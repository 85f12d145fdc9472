// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace hearth::gas {

/// std::vector that is sized and indexed by int, as cells and faces are numbered here.
template <class T>
class array : public std::vector<T> {
    using base = std::vector<T>;

  public:
    using base::base;
    array() = default;
    explicit array(int n, const T& value = T()) : base(static_cast<std::size_t>(n), value) {}

    template <class Index>
    T& operator[](Index i) { return base::operator[](static_cast<std::size_t>(i)); }
    template <class Index>
    const T& operator[](Index i) const { return base::operator[](static_cast<std::size_t>(i)); }

    using base::assign;
    void assign(int n, const T& value) { base::assign(static_cast<std::size_t>(n), value); }
    void resize(int n) { base::resize(static_cast<std::size_t>(n)); }
    void reserve(int n) { base::reserve(static_cast<std::size_t>(n)); }
    int count() const { return static_cast<int>(base::size()); }
};

/// Looks into an array without holding it: the array must outlive it and keep its size.
template <class T>
class view {
  public:
    view() = default;
    view(const array<T>& whole) : data_(whole.empty() ? nullptr : whole.data()) {}
    view(array<T>&&) = delete;

    template <class Index>
    const T& operator[](Index i) const { return data_[i]; }
    bool empty() const { return !data_; }

  private:
    const T* data_ = nullptr;
};

}  // namespace hearth::gas
