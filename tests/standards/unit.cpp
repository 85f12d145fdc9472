// SPDX-License-Identifier: MIT
// Compiled twice, with UNIT = cxx17 and UNIT = cxx20.
#include "both.hpp"

namespace UNIT {

long standard() { return __cplusplus; }

hearth::cell_graph<> build(const hearth::lattice& mesh) { return hearth::cell_graph(mesh); }

hearth::vfs_report smooth(const hearth::cell_graph<>& graph, std::vector<double>& solid_fraction) {
    hearth::volume_fraction_smoother smoother(graph);
    return smoother.smooth(solid_fraction);
}

}  // namespace UNIT
