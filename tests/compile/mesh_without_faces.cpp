// SPDX-License-Identifier: MIT
// error: hearth: mesh_traits<Mesh> lacks  for_each_face(mesh, visit)  with visit(cell, neighbour, area, conductance)
#include "host.hpp"

#include <vector>

#include <hearth/core/strided_cloud.hpp>
#include <hearth/voidage/filtered_fraction.hpp>

template <>
struct hearth::mesh_traits<host::mesh> :
#ifdef MENDED
    host::has_faces,
#endif
    host::has_index, host::has_scalar, host::has_cell_count, host::has_volume, host::has_neighbours, host::has_centre,
    host::has_find_cell {};

void plug_in(const host::mesh& mesh, const hearth::strided_cloud<>& cloud, std::vector<double>& solid_fraction) {
    hearth::filtered_solid_fraction(mesh, cloud, solid_fraction);
}
