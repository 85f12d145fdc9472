// SPDX-License-Identifier: MIT
// error: hearth: particle_traits<Cloud> lacks  get(quantity::position, cloud, i)  [m]
#include "host.hpp"

#include <hearth/core/lattice.hpp>
#include <hearth/voidage/deposit.hpp>

template <>
struct hearth::particle_traits<host::cloud> {
    using index = int;
    using scalar = double;
    static index particle_count(const host::cloud&) { return 1; }
#ifdef MENDED
    static host::point get(quantity::position, const host::cloud&, index) { return {}; }
#endif
    static scalar get(quantity::radius, const host::cloud&, index) { return 1; }
};

void plug_in(const hearth::lattice& mesh, const host::cloud& cloud, double* solid_fraction) {
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    hearth::deposit_solid_fraction(locator, cloud, solid_fraction);
}
