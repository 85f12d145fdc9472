// SPDX-License-Identifier: MIT
// What hearth costs on the arrays and the neighbour list of LAMMPS, beside the same numbers in plain arrays: conduction
// and radiation of 8000 spheres.  The results are the same to the bit.
#include <cstdio>
#include <cstdlib>

#include <mpi.h>

#include <hearth/adapt/lammps.hpp>

#include "hosts/atoms.hpp"

namespace {

void* open() {
    MPI_Init(nullptr, nullptr);
    const char* options[] = {"bench", "-screen", "lammps.screen", "-log", "lammps.log", "-nocite"};
    void* host = lammps_open(6, const_cast<char**>(options), MPI_COMM_WORLD, nullptr);
    char box[80], lattice[80], neighbor[80];
    std::snprintf(box, sizeof box, "region box block 0 %d 0 %d 0 %d", bench::atoms_along, bench::atoms_along,
                  bench::atoms_along);
    std::snprintf(lattice, sizeof lattice, "lattice sc %g origin 0.5 0.5 0.5", bench::spacing);
    std::snprintf(neighbor, sizeof neighbor, "neighbor %g bin", bench::skin);
    for (const char* line :
         {"units si", "atom_style sphere", "atom_modify map array sort 0 0", "boundary f f f", "newton off",
          "comm_modify vel yes", static_cast<const char*>(lattice), static_cast<const char*>(box), "create_box 1 box",
          static_cast<const char*>(neighbor), "pair_style gran/hertz/history 1e6 NULL 0 NULL 0.5 0", "pair_coeff * *",
          "timestep 2e-5", "create_atoms 1 box", "set group all diameter 0.01 density 2500", "run 0"}) {
        lammps_command(host, line);
    }
    return host;
}

void lammps_step(benchmark::State& state) {
    static void* const host = open();
    std::vector<std::int64_t> ids;
    const auto atoms = hearth::lammps::atoms(host, ids);
    if (atoms.count != bench::atoms_along * bench::atoms_along * bench::atoms_along) std::abort();
    bench::atoms_step(state, hearth::lammps::contacts(host, atoms, "gran/hertz/history", bench::skin,
                                                      bed::effective(bed::softened_modulus)));
}
BENCHMARK(lammps_step)->Name("hosts/LAMMPS/step")->UseManualTime()->Iterations(60)->Unit(benchmark::kMillisecond);

}  // namespace
