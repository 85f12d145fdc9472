// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/dem/particles.hpp>

namespace hearth::dem::detail {

/// Arrays over particles: those that this rank owns, then ghosts of other ranks.
struct store {
    std::size_t owned = 0;
    std::vector<sphere> spheres;
    std::vector<motion> motions;
    std::vector<load> loads;
    std::vector<lead> leads;
    std::vector<std::int64_t> ids;
    std::vector<double> temperatures;
    std::vector<std::uint8_t> flights;  ///< 128 in flight, and how long the number of contacts has asked for the other
    std::vector<index> near_places;     ///< of each particle in the near list, -1 where it is new
    std::vector<vector3> outer_forces;  ///< empty unless pushed
    std::vector<vector3> built;         ///< centres when the lists were built
    bool pushed = false;                ///< somebody has set a force from outside
    bool built_goes_along = false;      ///< with its particle wherever that goes; else it is made anew with the lists

    static constexpr std::uint8_t in_flight = 128;

    std::size_t total() const { return spheres.size(); }

    /// Takes no more memory than is asked for: growth comes with a rebuild of the lists, which costs more than a copy.
    void resize(std::size_t total) {
        fit(spheres, total);
        fit(motions, total);
        fit(loads, total);
        fit(leads, total);
        fit(ids, total);
        fit(temperatures, total);
        fit(flights, total, in_flight);
        fit(near_places, total, index{-1});
        if (pushed) fit(outer_forces, total);
        if (built_goes_along) fit(built, total);
    }

    void drop_ghosts() { resize(owned); }

    /// Owned particle k becomes the old particle order[k], for k < kept; the others in `order`, a permutation of all owned,
    /// are gone, and so are ghosts.  In place: memory does not grow.
    void reorder(const std::vector<index>& order, std::size_t kept) {
        permute(spheres, order, kept);
        permute(motions, order, kept);
        permute(loads, order, kept);
        permute(leads, order, kept);
        permute(ids, order, kept);
        permute(temperatures, order, kept);
        permute(flights, order, kept);
        permute(near_places, order, kept);
        if (pushed) permute(outer_forces, order, kept);
        if (built_goes_along) permute(built, order, kept);
        owned = kept;
    }

    std::size_t bytes() const {
        return spheres.capacity() * sizeof(sphere) + motions.capacity() * sizeof(motion) +
               loads.capacity() * sizeof(load) + leads.capacity() * sizeof(lead) +
               ids.capacity() * sizeof(std::int64_t) +
               temperatures.capacity() * sizeof(double) + flights.capacity() + near_places.capacity() * sizeof(index) +
               (outer_forces.capacity() + built.capacity()) * sizeof(vector3);
    }

  private:
    template <class Value>
    static void fit(std::vector<Value>& values, std::size_t total, const Value& filler = {}) {
        values.reserve(total);
        values.resize(total, filler);
    }

    template <class Value>
    static void permute(std::vector<Value>& values, const std::vector<index>& order, std::size_t kept) {
        std::vector<bool> done(order.size(), false);
        for (std::size_t first = 0; first < order.size(); ++first) {
            if (done[first]) continue;
            const Value carried = values[first];
            std::size_t at = first;
            for (;;) {
                done[at] = true;
                const auto from = static_cast<std::size_t>(order[at]);
                if (from == first) break;
                values[at] = values[from];
                at = from;
            }
            values[at] = carried;
        }
        values.resize(kept);
    }
};

}  // namespace hearth::dem::detail
