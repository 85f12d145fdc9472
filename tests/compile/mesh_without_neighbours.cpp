// SPDX-License-Identifier: MIT
// error: hearth: mesh_traits<Mesh> lacks  for_each_neighbour(mesh, cell, visit)  or  for_each_face(mesh, visit)
#include "host.hpp"

#include <hearth/core/cell_graph.hpp>

template <>
struct hearth::mesh_traits<host::mesh> :
#ifdef MENDED
    host::has_neighbours,
#endif
    host::has_index, host::has_scalar, host::has_cell_count, host::has_volume {};

void plug_in(const host::mesh& mesh) { const hearth::cell_graph graph(mesh); }
