// SPDX-License-Identifier: MIT
// error: hearth: specialise hearth::mesh_traits<Mesh> for your mesh (see core/mesh_traits.hpp)
#include "host.hpp"

#include <hearth/core/cell_graph.hpp>

#ifdef MENDED
template <>
struct hearth::mesh_traits<host::mesh> :
    host::has_index, host::has_scalar, host::has_cell_count, host::has_volume, host::has_faces {};
#endif

void plug_in(const host::mesh& mesh) { const hearth::cell_graph graph(mesh); }
