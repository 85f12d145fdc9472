// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include <hearth/dem/bed.hpp>

/// Plain values to bytes and back, in the byte order of this machine.
namespace hearth::dem::detail {

/// FNV-1a over eight bytes at a time; http://www.isthe.com/chongo/tech/comp/fnv.
inline std::uint64_t checksum(const char* bytes, std::size_t count) {
    std::uint64_t sum = 0xcbf29ce484222325u;
    for (std::size_t at = 0; at < count; at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + at, std::min<std::size_t>(8, count - at));
        sum = (sum ^ word) * 0x100000001b3u;
        sum ^= sum >> 29;  // a multiplication moves no bit down
    }
    return sum;
}

class writer {
  public:
    template <class Value>
    void operator()(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        const auto* bytes = reinterpret_cast<const char*>(&value);
        out.insert(out.end(), bytes, bytes + sizeof(Value));
    }
    template <class Value>
    void operator()(const std::vector<Value>& values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        (*this)(static_cast<std::uint64_t>(values.size()));
        const auto* bytes = reinterpret_cast<const char*>(values.data());
        out.insert(out.end(), bytes, bytes + values.size() * sizeof(Value));
    }

    std::vector<char> out;
};

class reader {
  public:
    reader(const char* bytes, std::size_t count) : bytes_(bytes), left_(count) {}

    template <class Value>
    void operator()(Value& value) {
        take(&value, sizeof(Value));
    }
    template <class Value>
    void operator()(std::vector<Value>& values) {
        std::uint64_t count = 0;
        (*this)(count);
        if (count > left_ / sizeof(Value)) throw state_error("hearth: the state of a bed ends too early");
        values.resize(static_cast<std::size_t>(count));
        if (count > 0) take(values.data(), values.size() * sizeof(Value));
    }
    bool at_end() const { return left_ == 0; }

  private:
    void take(void* to, std::size_t count) {
        if (count > left_) throw state_error("hearth: the state of a bed ends too early");
        std::memcpy(to, bytes_, count);
        bytes_ += count;
        left_ -= count;
    }

    const char* bytes_;
    std::size_t left_;
};

/// Behind the kind of a state whose last word is its checksum.  Throws state_error that says of what.
inline reader opened(const std::vector<char>& state, std::uint64_t kind, const std::string& of) {
    std::uint64_t sum = 0, found = 0;
    if (state.size() < 2 * sizeof sum)
        throw state_error("hearth: this is no state of " + of + ": " + std::to_string(state.size()) + " bytes");
    const std::size_t length = state.size() - sizeof sum;
    std::memcpy(&found, state.data(), sizeof found);
    std::memcpy(&sum, state.data() + length, sizeof sum);
    if (found != kind) throw state_error("hearth: this is no state of " + of + " of this version");
    if (sum != checksum(state.data(), length))
        throw state_error("hearth: the state of " + of + " is damaged: its checksum differs");
    reader archive(state.data(), length);
    archive(found);
    return archive;
}

}  // namespace hearth::dem::detail
