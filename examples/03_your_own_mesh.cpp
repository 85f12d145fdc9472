// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <vector>

#include <hearth/voidage/vfs.hpp>

namespace host {  // yours; it knows nothing of hearth
struct lattice {
    int nx, ny, nz;
    double spacing;
};
}  // namespace host

template <>
struct hearth::mesh_traits<host::lattice> {  // the plug
    using index = int;
    using scalar = double;
    static index cell_count(const host::lattice& m) { return m.nx * m.ny * m.nz; }
    static scalar volume(const host::lattice& m, index) { return m.spacing * m.spacing * m.spacing; }  // [m^3]
    template <class Visit>
    static void for_each_neighbour(const host::lattice& m, index cell, Visit&& visit) {
        const int i = cell % m.nx, j = cell / m.nx % m.ny, k = cell / (m.nx * m.ny);
        if (i > 0) visit(cell - 1);
        if (i + 1 < m.nx) visit(cell + 1);
        if (j > 0) visit(cell - m.nx);
        if (j + 1 < m.ny) visit(cell + m.nx);
        if (k > 0) visit(cell - m.nx * m.ny);
        if (k + 1 < m.nz) visit(cell + m.nx * m.ny);
    }
};

int main() {
    const host::lattice mesh{16, 16, 16, 1e-3};
    std::vector<double> solid_fraction(16 * 16 * 16);  // solid volume over cell volume
    solid_fraction[2184] = 12;                         // a sphere as large as twelve cells, where its centre is

    const hearth::vfs_report report = hearth::smooth_volume_fraction(mesh, solid_fraction, {0.9});

    double solid = 0;
    for (const double fraction : solid_fraction) solid += fraction;
    std::printf("%d sweeps, largest solid fraction %g, solid volume off by %.0e\n", report.sweeps, report.maximum,
                solid - 12);
    return report.maximum <= 0.9 && std::abs(solid - 12) < 1e-13 ? 0 : 1;
}
