// SPDX-License-Identifier: MIT
#pragma once

#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <hearth/dem/bed.hpp>

namespace rivals {

/// LAMMPS or LIGGGHTS through the C interface that both have (library.h), loaded at run time: both define the same symbols,
/// and a machine without them runs the other benchmarks.
class lammps {
  public:
    enum class kind { lammps, liggghts };

    static const char* name(kind which) { return which == kind::lammps ? "LAMMPS" : "LIGGGHTS"; }

    static bool installed(kind which) { return load(which) != nullptr; }

    /// Throws std::runtime_error where the library cannot be loaded.
    explicit lammps(kind which) : kind_(which), library_(load(which)) {
        if (!library_) throw std::runtime_error(std::string(name(which)) + " is not installed");
        const auto open = find<void (*)(int, char**, void**)>("lammps_open_no_mpi");
        command_ = find<char* (*)(void*, const char*)>("lammps_command");
        extract_ = find<void* (*)(void*, const char*)>("lammps_extract_atom");
        global_ = find<void* (*)(void*, const char*)>("lammps_extract_global");
        std::vector<std::string> words{name(which), "-screen", "none", "-log", "none"};
        std::vector<char*> arguments;
        for (std::string& w : words) arguments.push_back(w.data());
        open(static_cast<int>(arguments.size()), arguments.data(), &handle_);
        if (!handle_) throw std::runtime_error(std::string(name(which)) + " did not start");
    }
    // Neither is closed: both end MPI for the whole program, and the next one could not start.
    lammps(const lammps&) = delete;
    lammps& operator=(const lammps&) = delete;

    void operator()(const std::string& line) { command_(handle_, line.c_str()); }

    /// The spheres of a bed in a cylinder of a radius on a floor at z = 0, with its material, step and skin.
    void take(const hearth::dem::bed& b, double radius, double density) {
        const auto& law = b.law();
        const auto& s = b.settings();
        double top = 0, smallest = 1;
        for (hearth::dem::index i = 0; i < b.size(); ++i) {
            top = std::fmax(top, b.spheres()[i].centre.z);
            smallest = std::fmin(smallest, 2 * b.spheres()[i].radius);
        }
        std::string path = (std::filesystem::temp_directory_path() / "bed_XXXXXX").string();
        close(mkstemp(path.data()));
        std::ofstream file(path);
        file.precision(17);
        file << "settled bed\n\n" << b.size() << " atoms\n1 atom types\n\n"
             << -radius - 0.01 << ' ' << radius + 0.01 << " xlo xhi\n"
             << -radius - 0.01 << ' ' << radius + 0.01 << " ylo yhi\n-0.01 " << top + 0.1 << " zlo zhi\n\nAtoms\n\n";
        for (hearth::dem::index i = 0; i < b.size(); ++i) {
            const auto& sphere = b.spheres()[i];
            file << i + 1 << " 1 " << 2 * sphere.radius << ' ' << density << ' ' << sphere.centre.x << ' ' << sphere.centre.y
                 << ' ' << sphere.centre.z << '\n';
        }
        file.close();

        const bool old = kind_ == kind::liggghts;
        std::ostringstream radius_text;
        radius_text << radius;
        run_lines({"units si", old ? "atom_style granular" : "atom_style sphere", "atom_modify map array", "boundary f f f",
                   "newton off", old ? "communicate single vel yes" : "comm_modify mode single vel yes"});
        (*this)("read_data " + path);
        std::remove(path.c_str());
        std::ostringstream skin;
        skin << "neighbor " << s.skin * smallest << " bin";
        run_lines({skin.str(), "neigh_modify delay 0 every 1 check yes"});
        std::ostringstream model;
        if (old) {
            run_number("fix m1 all property/global youngsModulus peratomtype", s.body.youngs_modulus);
            run_number("fix m2 all property/global poissonsRatio peratomtype", s.body.poisson_ratio);
            run_number("fix m3 all property/global coefficientRestitution peratomtypepair 1",
                       hearth::dem::restitution_of_damping(s.contact.damping));
            run_number("fix m4 all property/global coefficientFriction peratomtypepair 1", s.contact.friction);
            run_lines({"pair_style gran model hertz tangential history", "pair_coeff * *",
                       "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0.0",
                       "fix side all wall/gran model hertz tangential history primitive type 1 zcylinder " + radius_text.str() +
                           " 0. 0."});
        } else {
            // Its dashpot, gamma m sqrt(R* overlap), equals Tsuji's at an overlap of 1e-5 m.
            model << law.normal_stiffness << ' ' << law.tangential_stiffness << " 4.6e6 4.6e6 " << s.contact.friction << " 1";
            run_lines({"pair_style gran/hertz/history " + model.str(), "pair_coeff * *",
                       "fix floor all wall/gran hertz/history " + model.str() + " zplane 0.0 NULL",
                       "fix side all wall/gran hertz/history " + model.str() + " zcylinder " + radius_text.str()});
        }
        run_number("timestep", s.step);
        run_lines({"fix pull all gravity 9.81 vector 0.0 0.0 -1.0", "fix move all nve/sphere", "thermo 1000000",
                   "run 0"});
    }

    /// Lists anew every so many steps whatever has moved, or, by 0, when the skin is used up.
    void rebuild_every(int steps) {
        (*this)(steps > 0 ? "neigh_modify delay 0 every " + std::to_string(steps) + " check no"
                          : std::string("neigh_modify delay 0 every 1 check yes"));
    }
    /// Conduction through contacts; LIGGGHTS alone has it.
    void conduct() {
        run_lines({"fix k all property/global thermalConductivity peratomtype 4.0",
                   "fix c all property/global thermalCapacity peratomtype 800.0",
                   "fix heat all heat/gran/conduction initial_temperature 300.0", "run 0"});
    }

    void advance(int steps) { (*this)("run " + std::to_string(steps) + " pre no post no"); }

    /// Root mean square velocity [m/s]; 0 at rest.
    double speed() const {
        const int count = *static_cast<int*>(global_(handle_, "nlocal"));
        double** velocity = static_cast<double**>(extract_(handle_, "v"));
        double sum = 0;
        for (int i = 0; i < count; ++i)
            for (int a = 0; a < 3; ++a) sum += velocity[i][a] * velocity[i][a];
        return std::sqrt(sum / count);
    }

  private:
    static void* load(kind which) {
        dlopen("libmpi.so.40", RTLD_NOW | RTLD_GLOBAL);  // whose plugins look for its symbols among the global ones
        return dlopen(which == kind::lammps ? "liblammps.so.0" : "libliggghts.so.3", RTLD_NOW | RTLD_LOCAL);
    }
    template <class Function>
    Function find(const char* symbol) const {
        void* const found = dlsym(library_, symbol);
        if (!found) throw std::runtime_error(std::string(name(kind_)) + " lacks " + symbol);
        return reinterpret_cast<Function>(found);
    }
    void run_lines(const std::vector<std::string>& lines) {
        for (const std::string& line : lines) (*this)(line);
    }
    void run_number(const std::string& line, double value) {
        std::ostringstream text;
        text.precision(17);
        text << line << ' ' << value;
        (*this)(text.str());
    }

    kind kind_;
    void* library_;
    void* handle_ = nullptr;
    char* (*command_)(void*, const char*) = nullptr;
    void* (*extract_)(void*, const char*) = nullptr;
    void* (*global_)(void*, const char*) = nullptr;
};

}  // namespace rivals
