// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <hearth/hearth.hpp>

/// What one translation unit makes and the other uses, in both directions.
namespace cxx17 {
long standard();
hearth::cell_graph<> build(const hearth::lattice& mesh);
hearth::vfs_report smooth(const hearth::cell_graph<>& graph, std::vector<double>& solid_fraction);
}  // namespace cxx17

namespace cxx20 {
long standard();
hearth::cell_graph<> build(const hearth::lattice& mesh);
hearth::vfs_report smooth(const hearth::cell_graph<>& graph, std::vector<double>& solid_fraction);
}  // namespace cxx20
