// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <hearth/core/cell_graph.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/voidage/filtered_fraction.hpp>
#include <hearth/voidage/vfs.hpp>

#include "rivals/voidage.hpp"
#include "support/packing.hpp"

namespace bench {

/// The solid fraction of every cell by one method; what a method leaves above 0.99 is cut off, as a gas solver must.
template <class Mesh>
std::vector<double> solid_fraction(const std::string& method, const Mesh& mesh, const hearth::test::packing& spheres) {
    std::vector<double> field(static_cast<std::size_t>(hearth::mesh_traits<Mesh>::cell_count(mesh)));
    if (method == "filtered") {
        hearth::filtered_solid_fraction(mesh, spheres, field);
        return field;
    }
    const hearth::cell_graph<> graph(mesh);
    const hearth::cell_locator<Mesh> locator(mesh, graph);
    if (method == "centre, clamped") return rivals::clamped(locator, spheres, hearth::deposit::centre{}, 0.9);
    if (method == "divided, clamped") return rivals::clamped(locator, spheres, hearth::deposit::divided{}, 0.9);
    hearth::deposit_solid_fraction(locator, spheres, field, hearth::deposit::centre{});
    const bool paper = method == "VFS of the paper";
    const hearth::vfs_settings settings{0.9, paper ? hearth::vfs_variant::paper : hearth::vfs_variant::completed};
    static_cast<void>(hearth::volume_fraction_smoother(graph, settings).smooth(field));  // what is stuck is cut off
    for (double& fraction : field) fraction = std::min(fraction, 0.99);
    return field;
}

}  // namespace bench
