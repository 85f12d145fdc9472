// SPDX-License-Identifier: MIT
// What hearth costs on the arrays and the neighbour list of LIGGGHTS, beside the same numbers in plain arrays:
// conduction and radiation of 8000 spheres.  The results are the same to the bit.
#include <cstdio>
#include <cstdlib>

#include <hearth/adapt/liggghts.hpp>

#include "hosts/atoms.hpp"

namespace {

void* open() {
    MPI_Init(nullptr, nullptr);
    const char* options[] = {"bench", "-screen", "liggghts.screen", "-log", "liggghts.log"};
    void* host = nullptr;
    lammps_open(5, const_cast<char**>(options), MPI_COMM_WORLD, &host);
    char box[80], lattice[80], neighbor[80];
    const double side = bench::atoms_along * bench::spacing;
    std::snprintf(box, sizeof box, "region box block 0 %g 0 %g 0 %g units box", side, side, side);
    std::snprintf(lattice, sizeof lattice, "lattice sc %g origin 0.5 0.5 0.5", bench::spacing);
    std::snprintf(neighbor, sizeof neighbor, "neighbor %g bin", bench::skin);
    for (const char* line : {"atom_style granular",
                             "atom_modify map array",
                             "boundary f f f",
                             "newton off",
                             "communicate single vel yes",
                             "units si",
                             static_cast<const char*>(lattice),
                             static_cast<const char*>(box),
                             "create_box 1 box",
                             static_cast<const char*>(neighbor),
                             "neigh_modify delay 0",
                             "fix young all property/global youngsModulus peratomtype 5e6",
                             "fix poisson all property/global poissonsRatio peratomtype 0.25",
                             "fix restitution all property/global coefficientRestitution peratomtypepair 1 0.3",
                             "fix friction all property/global coefficientFriction peratomtypepair 1 0.3",
                             "pair_style gran model hertz tangential history",
                             "pair_coeff * *",
                             "timestep 2e-5",
                             "create_atoms 1 box",
                             "set group all diameter 0.01 density 2500",
                             "fix integrate all nve/sphere",
                             "run 0"}) {
        lammps_command(host, line);
    }
    return host;
}

void liggghts_step(benchmark::State& state) {
    static void* const host = open();
    std::vector<std::int64_t> ids;
    const auto atoms = hearth::liggghts::atoms(host, ids);
    if (atoms.count != bench::atoms_along * bench::atoms_along * bench::atoms_along) std::abort();
    bench::atoms_step(state, hearth::liggghts::contacts(host, atoms, bed::effective(bed::softened_modulus)));
}
BENCHMARK(liggghts_step)->Name("hosts/LIGGGHTS/step")->UseManualTime()->Iterations(60)->Unit(benchmark::kMillisecond);

}  // namespace
