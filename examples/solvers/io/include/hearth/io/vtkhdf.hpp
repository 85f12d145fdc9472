// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <hearth/io/hdf5_file.hpp>

namespace hearth::io {

/// The part of a mesh that this rank writes, as VTK's unstructured grid.
struct grid_piece {
    std::vector<double> points;             ///< x, y, z of each point in turn [m]
    std::vector<std::int64_t> connectivity; ///< points of each cell in turn, numbered within this piece
    std::vector<std::int64_t> offsets;      ///< where each cell starts in connectivity, and one more: its size
    std::vector<std::uint8_t> types;        ///< VTK's cell types, e.g. 1 vertex, 12 hexahedron
};

/// Points alone, e.g. particles: one vertex each.
grid_piece vertices(std::vector<double> points);

/// A picture for ParaView (VTKHDF 1.0, read by ParaView 5.10 and later): a grid and fields on its cells and points.
/// Ranks write their pieces together; a rank may have none.  Number the files of a series: name_0000.hdf, ...; ParaView 5.11
/// knows no other ending.
class vtkhdf_file {
  public:
    /// time: process time that the picture shows [s], kept as field data "TimeValue".
    vtkhdf_file(const std::string& path, const grid_piece& piece, double time, MPI_Comm ranks = MPI_COMM_WORLD);

    /// A value per cell, or per point; components 1 or 3.  The name says the unit: "temperature_K".  Particles have theirs on
    /// their points, where ParaView's Glyph and Point Gaussian look for sizes and colours.
    void cell_field(const std::string& name, const std::vector<float>& values, std::size_t components = 1);
    void point_field(const std::string& name, const std::vector<float>& values, std::size_t components = 1);
    void point_field(const std::string& name, const std::vector<std::int64_t>& values);

    void close() { file_.close(); }

  private:
    hdf5_file file_;
    std::size_t cells_;
    std::size_t points_;
};

}  // namespace hearth::io
