// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// A mesh file that cannot be read: names the file and the line (the byte in binary parts).
struct file_error : std::runtime_error {
    file_error(const std::string& file_, long line_, const std::string& text)
        : std::runtime_error(file_ + ":" + std::to_string(line_) + ": " + text), file(file_), line(line_) {}
    std::string file;
    long line;
};

/// Reads OpenFOAM's polyMesh folder (points, faces, owner, neighbour, boundary), ASCII or binary, labels of 32 or 64 bits
/// and scalars of 32 or 64 bits as the files' `arch` entry says; compressed files are not read.
/// Patches keep their order and names; empty and wedge patches are patches like others (set them to slip).
/// Throws file_error.  The mesh itself is checked by the constructor of mesh.
polyhedra read_poly_mesh(const std::string& folder);

}  // namespace hearth::gas
