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
    std::vector<vector3> outer_forces;  ///< empty while nobody has set one

    std::size_t total() const { return spheres.size(); }

    void resize(std::size_t total) {
        spheres.resize(total);
        motions.resize(total);
        loads.resize(total);
        leads.resize(total);
        ids.resize(total);
        temperatures.resize(total);
        if (!outer_forces.empty()) outer_forces.resize(total);
    }

    /// Owned particle k becomes the old particle order[k]; those left out are gone, and so are ghosts.
    void reorder(const std::vector<index>& order) {
        pick(spheres, order);
        pick(motions, order);
        pick(loads, order);
        pick(leads, order);
        pick(ids, order);
        pick(temperatures, order);
        if (!outer_forces.empty()) pick(outer_forces, order);
        owned = order.size();
    }

    std::size_t bytes() const {
        return spheres.capacity() * sizeof(sphere) + motions.capacity() * sizeof(motion) +
               loads.capacity() * sizeof(load) + leads.capacity() * sizeof(lead) +
               ids.capacity() * sizeof(std::int64_t) +
               temperatures.capacity() * sizeof(double) + outer_forces.capacity() * sizeof(vector3);
    }

  private:
    template <class Value>
    static void pick(std::vector<Value>& values, const std::vector<index>& order) {
        std::vector<Value> picked(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) picked[k] = values[static_cast<std::size_t>(order[k])];
        values.swap(picked);
    }
};

}  // namespace hearth::dem::detail
