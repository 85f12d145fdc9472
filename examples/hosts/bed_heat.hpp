// SPDX-License-Identifier: MIT
#pragma once

#include <fstream>
#include <iomanip>
#include <stdexcept>
#include <string>
#include <vector>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>
#include <hearth/transfer/sphere_contacts.hpp>

/// What the LIGGGHTS and the LAMMPS host share: one bed of glass spheres and its heat, in whatever arrays the host has.
namespace bed {

constexpr double softened_modulus = 5e6, true_modulus = 6.5e10, poisson_ratio = 0.25;  // [Pa] [Pa] [-]
constexpr double conductivity = 1.0, specific_heat = 840, density = 2500;              // [W/(m K)] [J/(kg K)] [kg/m^3]
/// E* of two equal bodies [Pa].
constexpr double effective(double modulus) { return modulus / (2 * (1 - poisson_ratio * poisson_ratio)); }

/// Physics that the hosts do not have: conduction of the true modulus, radiation between particles and to walls.
inline auto physics() {
    const hearth::closure::elastic<double> glass{true_modulus, poisson_ratio};
    return hearth::scene{hearth::conduction{hearth::closure::zhang::constriction{}, {glass, glass, conductivity}},
                         hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}}};
}

/// The box of in.pack: a hot floor, cold sides.
inline std::vector<hearth::plane_wall> walls() {
    return {{{0, 0, 1}, 0, 900},
            {{1, 0, 0}, 0, 300},
            {{-1, 0, 0}, -0.06, 300},
            {{0, 1, 0}, 0, 300},
            {{0, -1, 0}, -0.06, 300}};
}

struct row {
    long id;
    double x, y, z, radius, temperature, heat;
};

/// Heat rates [W] of all atoms by their id, as text that keeps every bit.
inline void write(const std::string& name, const std::vector<row>& rows) {
    std::ofstream file(name);
    file << std::setprecision(17);
    for (const row& r : rows) {
        file << r.id << ' ' << r.x << ' ' << r.y << ' ' << r.z << ' ' << r.radius << ' ' << r.temperature << ' '
             << r.heat << '\n';
    }
    if (!file) throw std::runtime_error("cannot write " + name);
}

inline std::vector<row> read(const std::string& name) {
    std::ifstream file(name);
    std::vector<row> rows;
    for (row r{}; file >> r.id >> r.x >> r.y >> r.z >> r.radius >> r.temperature >> r.heat;) rows.push_back(r);
    if (rows.empty()) throw std::runtime_error("no atoms in " + name);
    return rows;
}

}  // namespace bed
