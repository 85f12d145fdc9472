// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/hearth.hpp>

/// What one translation unit makes and the other uses, in both directions.
namespace cxx17 {
long standard();
hearth::cell_graph<> build(const hearth::lattice& mesh);
double volume(const hearth::cell_graph<>& graph);
}  // namespace cxx17

namespace cxx20 {
long standard();
hearth::cell_graph<> build(const hearth::lattice& mesh);
double volume(const hearth::cell_graph<>& graph);
}  // namespace cxx20
