// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hearth {

/// A value that a host handed in and that is not allowed: names the place, the index, the value and what is allowed.
/// Thrown before anything is changed.  In a distributed run every rank throws the same error (see agree.hpp).
struct bad_value : std::invalid_argument {
    bad_value(std::string place_, std::int64_t index_, double value_, std::string allowed_)
        : std::invalid_argument(text(place_, index_, value_, allowed_)),
          place(std::move(place_)),
          index(index_),
          value(value_),
          allowed(std::move(allowed_)) {}

    /// For settings and other values that have no index.
    static constexpr std::int64_t no_index = -1;

    std::string place;    ///< e.g. "volume of cell", "acceleration_factor"
    std::int64_t index;   ///< global index of the cell or particle, or no_index
    double value;         ///< the offending value
    std::string allowed;  ///< e.g. "finite and > 0 [m^3]"

  private:
    static std::string text(const std::string& place, std::int64_t index, double value, const std::string& allowed) {
        std::ostringstream out;
        out.precision(17);
        out << "hearth: " << place;
        if (index != no_index) out << ' ' << index;
        out << " is " << value << ", allowed: " << allowed;
        return out.str();
    }
};

/// More solid than the cells can hold at the threshold: thrown with every field as it was.
struct infeasible_volume : std::runtime_error {
    infeasible_volume(std::int64_t component_, double capacity_, double excess_)
        : std::runtime_error(text(component_, capacity_, excess_)),
          component(component_),
          capacity(capacity_),
          excess(excess_) {}

    std::int64_t component;  ///< smallest global cell index of the connected component
    double capacity;         ///< threshold times volume of the component [m^3]
    double excess;           ///< solid volume above the capacity [m^3]

  private:
    static std::string text(std::int64_t component, double capacity, double excess) {
        std::ostringstream out;
        out.precision(17);
        out << "hearth: the cells connected with cell " << component << " hold at most " << capacity
            << " m^3 of solid at the threshold, but " << excess << " m^3 more were given";
        return out.str();
    }
};

/// The host changed its mesh after the graph was built.  Build a new cell_graph.
struct stale_graph : std::logic_error {
    stale_graph(std::uint64_t built, std::uint64_t now)
        : std::logic_error("hearth: the mesh is at revision " + std::to_string(now) +
                           ", but the graph was built at revision " + std::to_string(built) +
                           "; build a new cell_graph after each change of the mesh") {}
};

}  // namespace hearth
