// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include "both.hpp"

int main() {
    hearth::lattice mesh;
    mesh.cells = {5, 5, 5};
    std::vector<double> one(125), other(125);
    one[62] = other[62] = 20;

    const hearth::vfs_report crossed = cxx20::smooth(cxx17::build(mesh), one);
    const hearth::vfs_report back = cxx17::smooth(cxx20::build(mesh), other);

    const bool standards = cxx17::standard() == 201703L && cxx20::standard() >= 202002L;
    const bool same = one == other && crossed.sweeps == back.sweeps && crossed.sweeps > 0;
    std::printf("standards %ld and %ld in one program: %s\n", cxx17::standard(), cxx20::standard(),
                same ? "the same field" : "different fields");
    return standards && same ? 0 : 1;
}
