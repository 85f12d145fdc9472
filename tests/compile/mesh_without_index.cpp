// SPDX-License-Identifier: MIT
// error: hearth: mesh_traits<Mesh> lacks  using index = ...;
#include "host.hpp"

#include <hearth/core/cell_graph.hpp>

template <>
struct hearth::mesh_traits<host::mesh> :
#ifdef MENDED
    host::has_index,
#endif
    host::has_scalar, host::has_cell_count, host::has_volume, host::has_neighbours {};

void plug_in(const host::mesh& mesh) { const hearth::cell_graph graph(mesh); }
