// SPDX-License-Identifier: MIT
#include <hearth/io/vtkhdf.hpp>

#include <numeric>
#include <utility>

namespace hearth::io {

grid_piece vertices(std::vector<double> points) {
    grid_piece piece;
    const std::size_t count = points.size() / 3;
    piece.points = std::move(points);
    piece.connectivity.resize(count);
    std::iota(piece.connectivity.begin(), piece.connectivity.end(), 0);
    piece.offsets.resize(count + 1);
    std::iota(piece.offsets.begin(), piece.offsets.end(), 0);
    piece.types.assign(count, 1);
    return piece;
}

vtkhdf_file::vtkhdf_file(const std::string& path, const grid_piece& piece, double time, MPI_Comm ranks)
    : file_(path, hdf5_file::mode::write, ranks), cells_(piece.types.size()), points_(piece.points.size() / 3) {
    if (piece.points.size() % 3 != 0 || piece.offsets.size() != cells_ + 1 ||
        static_cast<std::size_t>(piece.offsets.back()) != piece.connectivity.size()) {
        throw std::logic_error(path + ": a grid whose arrays do not fit together");
    }
    file_.write_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
    file_.write_attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
    const auto count = [](std::size_t n) { return std::vector<std::int64_t>{static_cast<std::int64_t>(n)}; };
    file_.write("/VTKHDF/NumberOfPoints", count(points_));
    file_.write("/VTKHDF/NumberOfCells", count(cells_));
    file_.write("/VTKHDF/NumberOfConnectivityIds", count(piece.connectivity.size()));
    file_.write("/VTKHDF/Points", piece.points, 3);
    file_.write("/VTKHDF/Connectivity", piece.connectivity);
    file_.write("/VTKHDF/Offsets", piece.offsets);
    file_.write("/VTKHDF/Types", piece.types);
    int rank = 0;
    MPI_Comm_rank(ranks, &rank);
    file_.write("/VTKHDF/FieldData/TimeValue", rank == 0 ? std::vector<double>{time} : std::vector<double>{});
}

void vtkhdf_file::cell_field(const std::string& name, const std::vector<float>& values, std::size_t components) {
    if (values.size() != cells_ * components) throw std::logic_error(name + ": not one value per cell");
    file_.write("/VTKHDF/CellData/" + name, values, components);
}

void vtkhdf_file::point_field(const std::string& name, const std::vector<float>& values, std::size_t components) {
    if (values.size() != points_ * components) throw std::logic_error(name + ": not one value per point");
    file_.write("/VTKHDF/PointData/" + name, values, components);
}

void vtkhdf_file::point_field(const std::string& name, const std::vector<std::int64_t>& values) {
    if (values.size() != points_) throw std::logic_error(name + ": not one value per point");
    file_.write("/VTKHDF/PointData/" + name, values);
}

}  // namespace hearth::io
