// SPDX-License-Identifier: MIT
// error: hearth: mesh_traits<Mesh> lacks  index cell_count(mesh)
#include "host.hpp"

#include <hearth/core/cell_graph.hpp>

template <>
struct hearth::mesh_traits<host::mesh> :
#ifdef MENDED
    host::has_cell_count,
#endif
    host::has_index, host::has_scalar, host::has_volume, host::has_neighbours {};

void plug_in(const host::mesh& mesh) { const hearth::cell_graph graph(mesh); }
