// SPDX-License-Identifier: MIT
#include <cstdio>

#include "both.hpp"

int main() {
    hearth::lattice mesh;
    mesh.cells = {2, 2, 2};
    const double expected = 8;  // unit cells
    const bool standards = cxx17::standard() == 201703L && cxx20::standard() >= 202002L;
    const bool exchanged = cxx20::volume(cxx17::build(mesh)) == expected && cxx17::volume(cxx20::build(mesh)) == expected;
    std::printf("standards %ld and %ld in one program: %s\n", cxx17::standard(), cxx20::standard(),
                exchanged ? "same answer" : "different answers");
    return standards && exchanged ? 0 : 1;
}
