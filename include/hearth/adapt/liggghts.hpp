// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <mpi.h>  // LIGGGHTS' headers use it without including it

#include <liggghts/force.h>
#include <liggghts/lammps.h>
#include <liggghts/library.h>
#include <liggghts/neigh_list.h>
#include <liggghts/neighbor.h>
#include <liggghts/pair.h>

#include <hearth/transfer/sphere_contacts.hpp>

/// A running LIGGGHTS, by the handle of its C library: its atoms are a strided_cloud, its neighbour list the contacts.
/// Both hold LIGGGHTS' own pointers: make them anew after each command that runs it.  A program that links LIGGGHTS is
/// under its licence, the GPL.
namespace hearth::liggghts {

/// An array of LIGGGHTS, one row per atom.  Errors: invalid_argument where it has none of this name.
inline double* array(void* host, const std::string& name, bool is_fix) {
    void* found = is_fix ? lammps_extract_fix(host, name.c_str(), 1, 1, 0, 0) : lammps_extract_atom(host, name.c_str());
    if (found == nullptr) throw std::invalid_argument("hearth: LIGGGHTS has no array " + name);
    return static_cast<double*>(found);
}
inline double* rows(void* host, const std::string& name) {
    return *reinterpret_cast<double**>(array(host, name, false));
}

/// Atoms with the temperatures and heat rates of `fix heat/gran`, where there is one.
inline strided_cloud<> atoms(void* host, std::vector<std::int64_t>& ids) {
    strided_cloud<> cloud;
    cloud.count = *static_cast<int*>(lammps_extract_global(host, "nlocal"));
    const int* tags = reinterpret_cast<const int*>(array(host, "id", false));
    ids.assign(tags, tags + cloud.count);
    cloud.ids = ids.data();
    if (cloud.count == 0) return cloud;
    cloud.position = {rows(host, "x"), 3};
    cloud.velocity = {rows(host, "v"), 3};
    cloud.radius = {array(host, "radius", false), 1};
    cloud.mass = {array(host, "rmass", false), 1};
    cloud.temperature = {static_cast<double*>(lammps_extract_fix(host, "Temp", 1, 1, 0, 0)), 1};
    cloud.heat_rate = {static_cast<double*>(lammps_extract_fix(host, "heatFlux", 1, 1, 0, 0)), 1};
    return cloud;
}

/// The pairs of LIGGGHTS' half list; with `newton off` those with ghosts of other ranks stand on both.
struct pairs {
    const LAMMPS_NS::NeighList* list;

    template <class Visit>
    void operator()(Visit&& visit) const {
        for (int k = 0; k < list->inum; ++k) {
            const int i = list->ilist[k];
            for (int n = 0; n < list->numneigh[i]; ++n) visit(i, list->firstneigh[i][n] & NEIGHMASK);
        }
    }
};

/// effective_modulus: E* of the `model hertz` that moves the atoms [Pa].
inline sphere_contacts<pairs> contacts(void* host, const strided_cloud<>& atoms, double effective_modulus,
                                       std::vector<plane_wall> walls = {}) {
    const auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(host);
    return {atoms, {lmp->force->pair->list}, lmp->neighbor->skin, effective_modulus, std::move(walls)};
}

}  // namespace hearth::liggghts
