// SPDX-License-Identifier: MIT
#pragma once

#include <array>

/// Pieces from which a case puts together the traits of a host, all but one.
namespace host {

struct mesh {};
struct cloud {};
using point = std::array<double, 3>;

struct has_index {
    using index = int;
};
struct has_scalar {
    using scalar = double;
};
struct has_cell_count {
    static int cell_count(const mesh&) { return 1; }
};
struct has_volume {
    static double volume(const mesh&, int) { return 1; }
};
struct has_neighbours {
    template <class Visit>
    static void for_each_neighbour(const mesh&, int, Visit&&) {}
};
struct has_faces {
    template <class Visit>
    static void for_each_face(const mesh&, Visit&& visit) {
        visit(0, 1, 1.0, 1.0);
    }
};
struct has_centre {
    static point centre(const mesh&, int) { return {}; }
};
struct has_find_cell {
    static int find_cell(const mesh&, const point&) { return 0; }
};

}  // namespace host
