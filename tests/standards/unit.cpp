// SPDX-License-Identifier: MIT
// Compiled twice, with UNIT = cxx17 and UNIT = cxx20.
#include "both.hpp"

namespace UNIT {

long standard() { return __cplusplus; }

hearth::cell_graph<> build(const hearth::lattice& mesh) { return hearth::cell_graph(mesh); }

double volume(const hearth::cell_graph<>& graph) {
    graph.require_current();
    double sum = 0;
    for (int cell = 0; cell < graph.cell_count(); ++cell) sum += graph.volume(cell);
    return sum;
}

}  // namespace UNIT
