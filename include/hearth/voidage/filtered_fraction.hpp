// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/cell_graph.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/core/communicator.hpp>
#include <hearth/voidage/transfer_operator.hpp>

namespace hearth {

/// The recommended solid fraction [-] of every owned cell, in one call: ramp deposit, kernel of standard deviation d/2,
/// cap at 0.74.
///
///     const auto report = hearth::filtered_solid_fraction(mesh, cloud, solid_fraction);
///
/// Closures such as those of Ergun and Gunn were fitted to porosities of whole beds.  Averaged over less than about a
/// diameter, a porosity is an indicator of where the spheres are, and flow computed with it runs around them; the
/// kernel keeps that scale whatever the mesh (see transfer_operator for the method, for polydisperse beds and for the
/// errors).
///
/// Reads the mesh each time.  A host that calls it each step keeps a cell_graph, a cell_locator and a
/// transfer_operator, whose distribute() does the same, and uses that also for sources and for gas values at particles.
template <class Mesh, class Cloud, class Field, class Communicator = serial_communicator>
filtered_fraction_report filtered_solid_fraction(const Mesh& mesh, const Cloud& cloud, Field& solid_fraction,
                                                 filtered_fraction_settings settings = {},
                                                 Communicator communicator = {}) {
    require_faced_mesh<Mesh>();
    const cell_graph<Communicator> graph(mesh, communicator);
    const cell_locator<Mesh, Communicator> locator(mesh, graph);
    return transfer_operator<Mesh, Communicator>(locator, settings).distribute(cloud, solid_fraction);
}

}  // namespace hearth
