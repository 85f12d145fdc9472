// SPDX-License-Identifier: MIT
// The bed that LIGGGHTS packed, in LAMMPS: the same contacts, and through hearth the same heat.
//
//     hearthBedLammps bed.txt          of examples/hosts/liggghts
//
// Linked with LAMMPS, so the program is under the GPL; this file is not.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include <mpi.h>

#include <hearth/adapt/lammps.hpp>
#include <hearth/core/conformance.hpp>

#include "../bed_heat.hpp"

namespace {

/// A LAMMPS that holds the bed at rest, with gran/hertz of the same modulus as LIGGGHTS' `model hertz`: kn = 4/3 E*.
void* open(const std::vector<bed::row>& rows) {
    const char* options[] = {"hearthBedLammps", "-screen", "lammps.screen", "-log", "lammps.log", "-nocite"};
    void* host = lammps_open(6, const_cast<char**>(options), MPI_COMM_WORLD, nullptr);
    char pair[120];
    std::snprintf(pair, sizeof pair, "pair_style gran/hertz/history %.17g NULL 0 NULL 0.5 0",
                  4.0 / 3.0 * bed::effective(bed::softened_modulus));
    for (const char* line :
         {"units si", "atom_style sphere", "atom_modify map array sort 0 0", "boundary f f f", "newton off",
          "comm_modify vel yes", "region box block 0 0.06 0 0.06 0 0.2", "create_box 1 box", "neighbor 0.0155 bin",
          static_cast<const char*>(pair), "pair_coeff * *", "timestep 2e-5"}) {
        lammps_command(host, line);
    }
    std::vector<int> ids, types(rows.size(), 1);
    std::vector<double> positions, velocities(3 * rows.size(), 0.0);
    for (const bed::row& r : rows) {
        ids.push_back(static_cast<int>(r.id));
        positions.insert(positions.end(), {r.x, r.y, r.z});
    }
    lammps_create_atoms(host, static_cast<int>(rows.size()), ids.data(), types.data(), positions.data(),
                        velocities.data(), nullptr, 0);
    const int* placed = reinterpret_cast<const int*>(hearth::lammps::array(host, "id"));
    double *radius = hearth::lammps::array(host, "radius"), *mass = hearth::lammps::array(host, "rmass");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bed::row& r =
            *std::find_if(rows.begin(), rows.end(), [&](const bed::row& row) { return row.id == placed[i]; });
        radius[i] = r.radius;
        mass[i] = 4.0 / 3.0 * std::acos(-1.0) * r.radius * r.radius * r.radius * bed::density;
    }
    lammps_command(host, "run 0");
    return host;
}

int compare(void* host, const std::vector<bed::row>& rows) {
    std::vector<std::int64_t> ids;
    hearth::strided_cloud<> atoms = hearth::lammps::atoms(host, ids);
    std::vector<const bed::row*> there;  // LIGGGHTS' row of each of LAMMPS' atoms
    std::vector<double> temperature;
    for (const std::int64_t id : ids) {
        there.push_back(&*std::find_if(rows.begin(), rows.end(), [&](const bed::row& r) { return r.id == id; }));
        temperature.push_back(there.back()->temperature);
    }
    atoms.temperature = {temperature.data(), 1};
    atoms.conductivity = {&bed::conductivity, 0};
    const auto contacts = hearth::lammps::contacts(host, atoms, "gran/hertz/history", 0.0155,
                                                   bed::effective(bed::softened_modulus), bed::walls());
    if (!hearth::cloud_conformance(atoms).passed() || !hearth::contact_conformance(contacts, atoms.count).passed())
        return 1;

    // LAMMPS' own forces in the bed at rest, of the adapter's contacts.
    std::vector<std::array<double, 3>> force(ids.size());
    const double* theirs = *reinterpret_cast<double**>(hearth::lammps::array(host, "f"));
    double largest = 0, off = 0;
    hearth::contact_traits<std::decay_t<decltype(contacts)>>::for_each_contact(
        contacts, [&](int i, int j, const hearth::contact& touch) {
            const double *x = atoms.position.row(i), *y = atoms.position.row(j);
            const double apart = std::hypot(y[0] - x[0], y[1] - x[1], y[2] - x[2]);
            for (std::size_t a = 0; a < 3; ++a) {
                const double f = touch.normal_force * (y[a] - x[a]) / apart;
                force[static_cast<std::size_t>(i)][a] -= f;
                force[static_cast<std::size_t>(j)][a] += f;
            }
            largest = std::max(largest, touch.normal_force);
        });
    for (std::size_t i = 0; i < ids.size(); ++i) {
        for (std::size_t a = 0; a < 3; ++a) off = std::max(off, std::abs(force[i][a] - theirs[3 * i + a]));
    }
    std::printf("forces beside LAMMPS', of the largest: %.2g\n", off / largest);

    const auto links = bed::physics().links(atoms, contacts);
    std::vector<double> heat(ids.size(), 0.0);
    hearth::accumulate(
        links, temperature, [&](int w) { return contacts.walls[static_cast<std::size_t>(w)].temperature; }, heat);
    double hottest = 0, difference = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        hottest = std::max(hottest, std::abs(there[i]->heat));
        difference = std::max(difference, std::abs(heat[i] - there[i]->heat));
    }
    std::printf("%zu atoms: heat beside that in LIGGGHTS, of the largest: %.2g\n", ids.size(), difference / hottest);
    // The same positions, so the same contacts; the sums are in another order, over a dozen contacts of a particle.
    return off <= 1e-12 * largest && difference <= 1e-12 * hottest ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::printf("usage: hearthBedLammps bed.txt\n");
        return 2;
    }
    MPI_Init(&argc, &argv);
    int result = 1;
    try {
        const std::vector<bed::row> rows = bed::read(argv[1]);
        void* host = open(rows);
        result = compare(host, rows);
        lammps_close(host);
    } catch (const std::exception& error) {
        std::printf("%s\n", error.what());
    }
    MPI_Finalize();
    return result;
}
