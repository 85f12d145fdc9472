// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <string>

#include <hearth/gas/array.hpp>
#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// Any mesh of hexahedra: eight points per cell, the lower four and above them the upper four, each four turning from x
/// to y.  `patch_of(cell, side)` names the patch of each boundary side: 0..5 = x-, x+, y-, y+, z-, z+ of the cell.
/// Patches appear in the order of first use.  Throws mesh_error.
polyhedra from_hexahedra(array<vector3> points, const array<std::array<int, 8>>& cells,
                         const std::function<std::string(int cell, int side)>& patch_of);

/// Levels from 0 to length in `cells` steps, the last step `ratio` times the first (geometric).  [m]
array<double> graded(double length, int cells, double ratio = 1.0);

/// Box with the given levels along each axis, rising.  Patches: x_min, x_max, y_min, y_max, z_min, z_max.
/// `map`, where given, moves every point: a distorted or curved box with the same topology.
polyhedra box(const array<double>& x, const array<double>& y, const array<double>& z,
              const std::function<vector3(const vector3&)>& map = {});

/// Round shaft around the z axis: an O-grid (square core, ring of wedges) extruded along R(z).
struct shaft {
    /// Burners in a circle, flush with the wall.  Each is a patch of one rectangle of wall faces whose area is that of
    /// the round nozzle; the mesh lines run along its edges.
    struct nozzles {
        int count = 12;          ///< a multiple of 4
        double diameter = 0.015; ///< [m]
        double height = 8.0;     ///< of the centres [m]
    };
    /// Off-gas pipe in the side wall: a rectangle of wall faces, centred on the x axis, with the area of the round pipe.
    struct side_outlet {
        double diameter = 0.4;  ///< [m]
        double height = 9.5;    ///< of the centre [m]
    };
    struct radius_at { double z, radius; };  ///< [m]
    struct size_at { double z, size; };      ///< [m]

    array<radius_at> profile{{0, 0.425}, {10, 0.425}};  ///< piecewise linear, rising in z
    array<size_at> axial_size{{0, 0.05}, {10, 0.05}};   ///< axial size of cells, piecewise linear
    double cross_size = 0.05;       ///< size of cells across the shaft [m]
    double wall_growth = 1.0;       ///< outermost ring cell over innermost: below 1 refines towards the wall [-]
    bool burners = false, outlet = false;
    nozzles burner;
    side_outlet pipe;
};

/// The mesh of a shaft.  Patches: bottom, top, wall, and burner_0.. and outlet where asked for.
/// The polygon of each level has the area of the circle, so volumes are exact; the wall area is within 0.1 %.
/// Throws std::invalid_argument where the settings make no mesh.
polyhedra make(const shaft& settings);

}  // namespace hearth::gas
