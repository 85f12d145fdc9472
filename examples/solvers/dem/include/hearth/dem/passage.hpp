// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <hearth/dem/particles.hpp>
#include <hearth/dem/ranks.hpp>

namespace hearth::dem {

/// What a move did to the particles.  They stay the same particles; only their indices change, and on several ranks
/// their owners.  Each rank has its part: the particles that it owns now, and those that it owned and that have left
/// the bed.
struct passage {
    static constexpr index fed = -1;
    static constexpr index from_another_rank = -2;
    struct leaver {
        index from;  ///< its index before the move; `fed` if it came and left in the same move: told by the first rank
        std::int64_t id;
        double mass;  ///< [kg]
    };

    std::vector<index> origin;  ///< of each particle that there is now: its index before, or one of the two above
    std::vector<leaver> left;   ///< in the order of leaving
    double mass_in = 0, mass_out = 0;  ///< of all ranks [kg]

    /// What goes from rank to rank; without `among` there is but one.
    struct crossing {
        std::shared_ptr<ranks> among;
        std::vector<index> sent, got;        ///< indices before and after the move, rank by rank
        std::vector<link> exports, imports;  ///< parts of them
    } over_ranks;

    /// Takes what belongs to particles (temperature, moisture, ...) along, to other ranks too.  Together; values that
    /// are not trivially copyable go no farther than this rank: throws std::invalid_argument on several.
    template <class Value>
    void carry(std::vector<Value>& values, const Value& of_feed) const {
        std::vector<Value> now(origin.size(), of_feed);
        for (std::size_t i = 0; i < origin.size(); ++i)
            if (origin[i] >= 0) now[i] = values[static_cast<std::size_t>(origin[i])];
        if (over_ranks.among) carry_over_ranks(values, now);
        values.swap(now);
    }

  private:
    template <class Value>
    void carry_over_ranks(const std::vector<Value>& values, std::vector<Value>& now) const {
        if constexpr (std::is_trivially_copyable_v<Value>) {
            const auto in_bytes = [](std::vector<link> links) {
                for (link& l : links) l.begin *= sizeof(Value), l.end *= sizeof(Value);
                return links;
            };
            std::vector<char> outgoing(over_ranks.sent.size() * sizeof(Value)),
                incoming(over_ranks.got.size() * sizeof(Value));
            for (std::size_t k = 0; k < over_ranks.sent.size(); ++k) {
                const Value v = values[static_cast<std::size_t>(over_ranks.sent[k])];
                std::memcpy(outgoing.data() + k * sizeof v, &v, sizeof v);
            }
            over_ranks.among->begin(outgoing.data(), in_bytes(over_ranks.exports), incoming.data(),
                                    in_bytes(over_ranks.imports));
            over_ranks.among->end();
            for (std::size_t k = 0; k < over_ranks.got.size(); ++k) {
                Value v;
                std::memcpy(&v, incoming.data() + k * sizeof v, sizeof v);
                now[static_cast<std::size_t>(over_ranks.got[k])] = v;
            }
        } else {
            throw std::invalid_argument("hearth: values that are not trivially copyable do not go from rank to rank");
        }
    }
};

}  // namespace hearth::dem
