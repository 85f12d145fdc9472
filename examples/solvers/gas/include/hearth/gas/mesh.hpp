// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include <hearth/gas/array.hpp>
#include <hearth/gas/vector3.hpp>

namespace hearth::gas {

/// A mesh that no finite-volume method can use.  Names the cell or the face (-1 where it is not the place).
struct mesh_error : std::invalid_argument {
    mesh_error(const std::string& text, int cell_, int face_)
        : std::invalid_argument("hearth::gas: mesh: " + text), cell(cell_), face(face_) {}
    int cell, face;
};

/// Consecutive boundary faces that share one condition.
struct patch {
    std::string name;
    int first = 0;  ///< first face
    int count = 0;  ///< number of faces
};

/// Points and the faces spanned by them: what a generator or a reader hands in.
struct polyhedra {
    array<vector3> points;     ///< [m]
    array<int> face_first;     ///< size faces + 1: where the points of a face begin in face_points
    array<int> face_points;    ///< point numbers, turning right-handed about the area vector
    array<int> owner;          ///< one per face
    array<int> neighbour;      ///< one per internal face; internal faces come first
    array<patch> patches;      ///< in face order, covering every boundary face
};

/// Face-addressed polyhedral mesh.
///
/// Faces: first those between two owned cells, then those towards ghost cells (only in a distributed mesh), then the
/// boundary, patch by patch.  The area vector points from the owner to the neighbour, or out of the domain.
/// Cells: owned cells first, then ghosts.
class mesh {
  public:
    mesh() = default;

    /// Computes the geometry and checks it: closed cells, positive volumes, owner below neighbour, patches complete,
    /// every point finite.  Throws mesh_error.
    explicit mesh(polyhedra shape);

    /// The share of one rank: its cells in the order of the whole mesh, then the cells of other ranks across its faces
    /// (ghosts) in order of rank and number.  Geometry is the whole mesh's, bit for bit.  See partition.hpp.
    /// Throws std::invalid_argument where the rank owns no cell.
    mesh(const mesh& whole, const array<int>& rank_of_cell, int rank);

    int owned_cells() const { return owned_cells_; }
    int cells() const { return static_cast<int>(volume.size()); }  ///< with ghosts
    int faces() const { return static_cast<int>(owner.size()); }
    int internal_faces() const { return static_cast<int>(neighbour.size()); }
    int boundary_faces() const { return faces() - internal_faces(); }

    /// The patch of that name; throws std::invalid_argument that lists the names there are.
    const patch& find_patch(const std::string& name) const;
    double area_of(const patch& p) const;  ///< [m^2]

    /// The owned cell that holds the point, or -1.  A point on a face belongs to one of its cells.  The first call makes
    /// bins of all cells, 47 B each.
    int find_cell(const vector3& point) const;

    /// Drops the points and the faces' lists of them, 84 B per cell of a box.  The solver needs neither; pictures, shares
    /// of the mesh and the first find_cell do.
    void release_shape() { shape = {}; }

    array<int> owner, neighbour;
    array<vector3> area;         ///< [m^2] per face
    array<vector3> face_centre;  ///< [m]
    array<vector3> centre;       ///< [m] per cell
    array<double> volume;        ///< [m^3] per cell
    array<double> owner_weight;  ///< per internal face: weight of the owner in a linear interpolation [-]
    array<double> conductance;   ///< per face: |S|^2 / (S.d), d from centre to centre (or to the face) [m]
    array<patch> patches;
    polyhedra shape;                   ///< points and faces, for output and location, until released; without owner, neighbour
    array<std::int64_t> global;  ///< per cell: number in the undivided mesh; empty where that is the cell itself
    array<int> ghost_rank;       ///< per ghost: the rank that owns it
    double largest_angle = 0;          ///< greatest angle between face normal and the line of centres [degree]

  private:
    void compute_geometry();
    void check_topology() const;
    void check_geometry() const;
    void compute_weights();
    struct location;
    const location& locate() const;

    int owned_cells_ = 0;
    mutable std::shared_ptr<const location> location_;
};

/// Cells in reverse Cuthill-McKee order and faces sorted by owner, then neighbour: near cells lie near in memory.
/// Patches keep their order.  `new_of_old`, where given, receives the new number of each cell.
polyhedra renumbered(const polyhedra& shape, array<int>* new_of_old = nullptr);

}  // namespace hearth::gas
