// SPDX-License-Identifier: MIT
// LIGGGHTS packs a bed, hearth heats it: radiation, conduction with the true modulus, Time Scale Splitting.
//
//     hearthBed in.pack bed.txt            writes a line an atom: id x y z radius temperature, and hearth's heat rate
//     [W]
//
// Before, it holds LIGGGHTS' own `fix heat/gran/conduction` against hearth's conduction.  Where hearth has the
// conductance 2 k a of the contact's circle, a^2 = R* overlap (Batchelor, O'Brien 1977, doi:10.1098/rspa.1977.0100),
// LIGGGHTS has 2 k sqrt(A) with the area A of the circle in which the two undeformed spheres cut each other,
// A = pi (2 R* overlap - overlap^2 / 4) for equal spheres.  Both take the overlap of the true modulus (LIGGGHTS:
// area_correction).  So LIGGGHTS conducts sqrt(2 pi) = 2.507 times as much: sqrt(pi) for the square root of an area in
// place of a radius, sqrt(2) because undeformed spheres cut each other in twice the area in which elastic ones touch.
//
// Linked with LIGGGHTS, so the program is under the GPL; this file is not.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include <hearth/adapt/liggghts.hpp>

#include <liggghts/compute.h>
#include <liggghts/modify.h>

#include <hearth/core/conformance.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/time/tssm_ledger.hpp>

#include "../bed_heat.hpp"

namespace {

int failures = 0;

void check(bool holds, const char* what, double value) {
    std::printf("%s%s: %.3g\n", holds ? "" : "FAILED ", what, value);
    if (!holds) ++failures;
}

/// Both compute the overlap from the same positions by the same subtraction; what is left is the order of a dozen sums.
constexpr double round_off = 1e-13;

/// LIGGGHTS' own conduction, as documented above, over hearth's contacts [W].
template <class Contacts>
std::vector<double> liggghts_conduction(const Contacts& contacts, const std::vector<double>& temperature) {
    std::vector<double> heat(temperature.size(), 0.0);
    const double correction = std::pow(bed::softened_modulus / bed::true_modulus, 2.0 / 3.0);
    hearth::contact_traits<Contacts>::for_each_contact(contacts, [&](int i, int j, const hearth::contact& touch) {
        const double a = contacts.atoms.radius[i], b = contacts.atoms.radius[j], d = a + b - correction * touch.overlap;
        const double area = -0.25 * std::acos(-1.0) * ((d - a - b) * (d + a - b) * (d - a + b) * (d + a + b)) / (d * d);
        const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
        const double flux = 2 * bed::conductivity * std::sqrt(area) * (temperature[q] - temperature[p]);
        heat[p] += flux;
        heat[q] -= flux;
    });
    return heat;
}

double largest(const std::vector<double>& v) {
    double result = 0;
    for (const double x : v) result = std::max(result, std::abs(x));
    return result;
}

/// The pair forces that LIGGGHTS moves its atoms by, against those of the adapter; the bed is at rest.
template <class Contacts>
void compare_forces(void* host, const Contacts& contacts, const std::vector<std::int64_t>& ids) {
    auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(host);
    auto* rows = static_cast<double**>(lammps_extract_compute(host, "contacts", 2, 2));
    const int count = lmp->modify->compute[lmp->modify->find_compute("contacts")]->size_local_rows;
    std::vector<std::array<double, 3>> theirs, ours;  // smaller id, larger id, force
    for (int k = 0; k < count; ++k) {
        const double* row = rows[k];  // id1 id2 periodic, normal force as a vector, overlap
        theirs.push_back({std::min(row[0], row[1]), std::max(row[0], row[1]), std::hypot(row[3], row[4], row[5])});
    }
    hearth::contact_traits<Contacts>::for_each_contact(contacts, [&](int i, int j, const hearth::contact& touch) {
        const auto p = static_cast<double>(ids[static_cast<std::size_t>(i)]),
                   q = static_cast<double>(ids[static_cast<std::size_t>(j)]);
        ours.push_back({std::min(p, q), std::max(p, q), touch.normal_force});
    });
    std::sort(theirs.begin(), theirs.end());
    std::sort(ours.begin(), ours.end());
    bool same = theirs.size() == ours.size();
    double off = 0, scale = 0;
    for (std::size_t k = 0; same && k < ours.size(); ++k) {
        same = theirs[k][0] == ours[k][0] && theirs[k][1] == ours[k][1];
        off = std::max(off, std::abs(theirs[k][2] - ours[k][2]));
        scale = std::max(scale, ours[k][2]);
    }
    check(same, "contacts, the same as LIGGGHTS'", static_cast<double>(ours.size()));
    // LIGGGHTS' force has its damping in it, by what is left of the motion.
    check(off < 1e-4 * scale, "normal forces beside LIGGGHTS', of the largest", off / scale);
}

/// Warmer upwards [K].
double initial_temperature(const hearth::strided_cloud<>& atoms, std::int64_t i) {
    return 300 + 4000 * atoms.position.row(i)[2];
}

void heat_bed(void* host, const char* output) {
    // The bed hangs still from here on; only LIGGGHTS' heat goes on.
    lammps_command(host, "unfix integrate");
    std::vector<std::int64_t> ids;
    hearth::strided_cloud<> atoms = hearth::liggghts::atoms(host, ids);
    for (std::int64_t i = 0; i < atoms.count; ++i) atoms.temperature[i] = initial_temperature(atoms, i);
    lammps_command(host, "run 1");

    atoms = hearth::liggghts::atoms(host, ids);  // LIGGGHTS sorts its atoms when a run begins
    const auto count = static_cast<std::size_t>(atoms.count);
    std::vector<double> initial;
    for (std::int64_t i = 0; i < atoms.count; ++i) initial.push_back(initial_temperature(atoms, i));
    atoms.conductivity = {&bed::conductivity, 0};
    const auto contacts = hearth::liggghts::contacts(host, atoms, bed::effective(bed::softened_modulus), bed::walls());
    check(hearth::cloud_conformance(atoms).passed(), "conformance of the atoms", static_cast<double>(atoms.count));
    check(hearth::contact_conformance(contacts, atoms.count).passed(), "conformance of the contacts", 0);
    compare_forces(host, contacts, ids);

    // LIGGGHTS' conduction beside ours, both at the temperatures before the step.
    const std::vector<double> theirs(atoms.heat_rate.first, atoms.heat_rate.first + count);
    const std::vector<double> expected = liggghts_conduction(contacts, initial);
    double off = 0;
    for (std::size_t i = 0; i < count; ++i) off = std::max(off, std::abs(theirs[i] - expected[i]));
    check(off < round_off * largest(expected), "LIGGGHTS' conduction, off its formula by, of the largest",
          off / largest(expected));
    for (std::size_t i = 0; i < count; ++i) atoms.temperature[static_cast<std::ptrdiff_t>(i)] = initial[i];

    const auto physics = bed::physics();
    const auto links = physics.links(atoms, contacts);
    std::vector<double> ours(count, 0.0), all(count, 0.0);
    for (std::size_t k = 0; k < links.parts[0].pairs; ++k) {  // the pairs of conduction stand first
        const auto& pair = links.pairs[k];
        const double q = pair.link.conductance * (initial[static_cast<std::size_t>(pair.second)] -
                                                  initial[static_cast<std::size_t>(pair.first)]);
        ours[static_cast<std::size_t>(pair.first)] += q;
        ours[static_cast<std::size_t>(pair.second)] -= q;
    }
    off = 0;
    for (std::size_t i = 0; i < count; ++i)
        off = std::max(off, std::abs(theirs[i] - std::sqrt(2 * std::acos(-1.0)) * ours[i]));
    // The square of an overlap, of the true modulus 1e-6 of the radius, is in their area only.
    check(off < 1e-5 * largest(theirs), "LIGGGHTS' conduction is sqrt(2 pi) times ours; off, of the largest",
          off / largest(theirs));
    std::printf("factor %.6f, sqrt(2 pi) = %.6f\n", largest(theirs) / largest(ours), std::sqrt(2 * std::acos(-1.0)));

    // Heat rates of all of hearth's terms, for other hosts to compare with.
    const auto wall_temperature = [&](int w) { return contacts.walls[static_cast<std::size_t>(w)].temperature; };
    const auto books = hearth::accumulate(links, initial, wall_temperature, all);
    for (const auto& book : books) {
        std::printf("%s: %.4g W between particles, %.4g W from walls, %.4g W from surroundings\n",
                    book.term == 0 ? "conduction" : "radiation", book.between, book.from_walls, book.from_surroundings);
    }
    std::vector<bed::row> rows;
    for (std::size_t i = 0; i < count; ++i) {
        const auto k = static_cast<std::ptrdiff_t>(i);
        const double* x = atoms.position.row(k);
        rows.push_back({static_cast<long>(ids[i]), x[0], x[1], x[2], atoms.radius[k], initial[i], all[i]});
    }
    bed::write(output, rows);

    // An hour of the bed in 18 s of the model.
    const hearth::tssm clock(200);
    hearth::tssm_ledger ledger(clock.gas_storage_factor());
    hearth::thermal_network network;
    std::vector<double> temperature = initial;
    std::vector<hearth::particle_step<double>> taken;
    const std::vector<double> mass(atoms.mass.first, atoms.mass.first + count);
    const hearth::constant_specific_heat<> glass{bed::specific_heat};
    const double step = 0.1;  // of the model [s]
    for (int n = 0; n < 180; ++n) {
        const auto baths = physics.baths(atoms, contacts, hearth::no_gas{}, links, clock);
        const auto report = network.advance(
            links.pairs, baths, mass, [&](std::size_t) { return glass; }, clock, step, temperature, taken);
        if (!report.converged) ++failures;
        for (const auto& particle : taken) {
            ledger.particle(particle.heat, clock.factor(0));
            ledger.boundary((particle.conducted + particle.radiated) / clock.factor(0));
        }
    }
    const auto [low, high] = std::minmax_element(temperature.begin(), temperature.end());
    check(ledger.relative_imbalance() < 1e-12, "after an hour of the bed: energy off by, of what was moved",
          ledger.relative_imbalance());
    check(*low > 290 && *high < 900, "hottest particle, below the floor's 900 K", *high);
    for (std::size_t i = 0; i < count; ++i) atoms.temperature[static_cast<std::ptrdiff_t>(i)] = temperature[i];
    lammps_command(host, "run 1");  // LIGGGHTS goes on from there
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::printf("usage: hearthBed in.pack bed.txt\n");
        return 2;
    }
    MPI_Init(&argc, &argv);
    // LIGGGHTS crashes on insertion when screen or log is `none`.
    const char* options[] = {"hearthBed", "-screen", "liggghts.screen", "-log", "liggghts.log"};
    void* host = nullptr;
    lammps_open(5, const_cast<char**>(options), MPI_COMM_WORLD, &host);
    try {
        lammps_file(host, argv[1]);
        heat_bed(host, argv[2]);
    } catch (const std::exception& error) {
        std::printf("%s\n", error.what());
        ++failures;
    }
    lammps_close(host);
    MPI_Finalize();
    return failures == 0 ? 0 : 1;
}
