// SPDX-License-Identifier: MIT
// error: hearth: mesh_traits<Mesh> lacks  point centre(mesh, cell)  [m]
#include "host.hpp"

#include <hearth/core/cell_locator.hpp>

template <>
struct hearth::mesh_traits<host::mesh> :
#ifdef MENDED
    host::has_centre,
#endif
    host::has_index, host::has_scalar, host::has_cell_count, host::has_volume, host::has_faces, host::has_find_cell {};

void plug_in(const host::mesh& mesh) {
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
}
