// SPDX-License-Identifier: MIT
#include <malloc.h>

#include <memory>

#include <doctest/doctest.h>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

using namespace hearth::gas;

namespace {

/// What the C library has given out and not got back [bytes]; 0 under a sanitizer, which has an allocator of its own.
double allocated() {
    const auto heap = mallinfo2();
    return static_cast<double>(heap.uordblks) + static_cast<double>(heap.hblkhd);
}

}  // namespace

TEST_CASE("memory: mesh, state and solver of 27 000 cells, after some iterations of everything") {
    const double before = allocated();
    mesh m(box(graded(0.3, 30), graded(0.3, 30), graded(0.6, 30)));
    const double with_mesh = allocated();
    if (!(with_mesh > before)) return;
    solver gas(m, std::make_shared<simple_gas>());
    gas.set("z_min", mass_flow_inlet(0.1, {300}));
    gas.set("z_max", pressure_outlet(101325));
    for (int c = 0; c < m.cells(); ++c) gas.bed.void_fraction[c] = m.centre[c].z < 0.3 ? 0.42 : 1;
    gas.initialise(300);
    for (int i = 0; i < 3; ++i) gas.iterate();
    const double per_cell = 1.0 / m.cells();
    const double all = allocated();
    m.release_shape();  // who writes pictures keeps it
    const double without_shape = allocated();
    MESSAGE("mesh " << (with_mesh - before) * per_cell << ", all " << (all - before) * per_cell << ", without points "
                    << (without_shape - before) * per_cell << " B per cell");
    // Counted by hand: mesh 248 for its fields, 84 for points and faces' points; workspace 224, state 160, bed and sources
    // 48, pattern and gradients 100, multigrid 110, the rest 54: 1028, and 4 % for boundary faces.
    CHECK((with_mesh - before) * per_cell < 350);
    CHECK((all - before) * per_cell < 1090);
    CHECK((without_shape - before) * per_cell < 1000);  // the bar
    CHECK(gas.iterate().flow.velocity_change < 1);
}
