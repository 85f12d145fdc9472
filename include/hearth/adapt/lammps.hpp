// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <lammps/library.h>

#include <hearth/transfer/sphere_contacts.hpp>

/// A running LAMMPS, by the handle of its C library: its atoms (atom_style sphere) are a strided_cloud, its neighbour
/// list the contacts.  Both hold LAMMPS' own pointers: make them anew after each command that runs it.  Compile with
/// LAMMPS_LIB_MPI.  A program that links LAMMPS is under its licence, the GPL.
namespace hearth::lammps {

/// An array of LAMMPS, one row per atom.  Errors: invalid_argument where it has none of this name.
inline double* array(void* host, const std::string& name) {
    void* found = lammps_extract_atom(host, name.c_str());
    if (found == nullptr) throw std::invalid_argument("hearth: LAMMPS has no array " + name);
    return static_cast<double*>(found);
}

/// Atoms; temperatures and heat rates are the caller's to add: LAMMPS' spheres have none.
inline strided_cloud<> atoms(void* host, std::vector<std::int64_t>& ids) {
    strided_cloud<> cloud;
    cloud.count = lammps_extract_setting(host, "nlocal");
    const int* tags = reinterpret_cast<const int*>(array(host, "id"));
    ids.assign(tags, tags + cloud.count);
    cloud.ids = ids.data();
    if (cloud.count == 0) return cloud;
    cloud.position = {*reinterpret_cast<double**>(array(host, "x")), 3};
    cloud.velocity = {*reinterpret_cast<double**>(array(host, "v")), 3};
    cloud.radius = {array(host, "radius"), 1};
    cloud.mass = {array(host, "rmass"), 1};
    return cloud;
}

/// The pairs of a half list; with `newton off` those with ghosts of other ranks stand on both.
struct pairs {
    struct row {
        int atom, length;
        const int* others;
    };
    std::vector<row> rows;

    pairs(void* host, int list) : rows(static_cast<std::size_t>(lammps_neighlist_num_elements(host, list))) {
        for (row& r : rows) {
            int* others = nullptr;
            const int number = static_cast<int>(&r - rows.data());
            lammps_neighlist_element_neighbors(host, list, number, &r.atom, &r.length, &others);
            r.others = others;
        }
    }

    template <class Visit>
    void operator()(Visit&& visit) const {
        for (const row& r : rows)
            for (int n = 0; n < r.length; ++n) visit(r.atom, r.others[n] & 0x1FFFFFFF);  // LAMMPS' NEIGHMASK
    }
};

/// style: the pair style that moves the atoms, by gran/hertz; skin: as given to LAMMPS' command `neighbor` [m];
/// effective_modulus: E* of that style [Pa].  Errors: invalid_argument where LAMMPS has no list of this style.
inline sphere_contacts<pairs> contacts(void* host, const strided_cloud<>& atoms, const std::string& style, double skin,
                                       double effective_modulus, std::vector<plane_wall> walls = {}) {
    const int list = lammps_find_pair_neighlist(host, style.c_str(), 1, 0, 0);
    if (list < 0) throw std::invalid_argument("hearth: LAMMPS has no neighbour list of pair style " + style);
    return {atoms, {host, list}, skin, effective_modulus, std::move(walls)};
}

}  // namespace hearth::lammps
