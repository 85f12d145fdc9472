// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <hearth/io/hdf5_file.hpp>
#include <hearth/io/vtkhdf.hpp>

using hearth::io::file_error;
using hearth::io::hdf5_file;

namespace {

int rank() { int r = 0; MPI_Comm_rank(MPI_COMM_WORLD, &r); return r; }
int size() { int n = 0; MPI_Comm_size(MPI_COMM_WORLD, &n); return n; }

/// A name of its own for each number of ranks, so that tests run side by side.
std::string file_name(const std::string& stem) { return stem + "_" + std::to_string(size()) + ".h5"; }

std::vector<double> rows_of(int r) {
    std::mt19937_64 random(static_cast<std::uint64_t>(r) + 17);
    std::vector<double> rows(static_cast<std::size_t>(3 * 1000 * r));  // rank 0 has none
    for (double& value : rows) value = static_cast<double>(random()) * 0x1p-64;
    return rows;
}

void write_checkpoint(const std::string& path) {
    hdf5_file file(path, hdf5_file::mode::write_checksummed);
    file.write("bed/position", rows_of(rank()), 3);
    file.write("bed/id", std::vector<std::int64_t>(5, rank()));
    file.write_attribute("/bed", "scene", std::string("shaft"));
    file.close();
}

/// Changes one byte of a file, or cuts it off there.
void damage(const std::string& path, std::uintmax_t at, bool cut) {
    if (rank() == 0) {
        if (cut) {
            std::filesystem::resize_file(path, at);
        } else {
            std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
            file.seekg(static_cast<std::streamoff>(at));
            const int byte = file.get();
            file.seekp(static_cast<std::streamoff>(at));
            file.put(static_cast<char>(byte ^ 0x10));
        }
    }
    MPI_Barrier(MPI_COMM_WORLD);
}

/// True where the whole file reads back as it was written; file_error where it is refused.
bool reads_back(const std::string& path) {
    const hdf5_file file(path, hdf5_file::mode::read_checksummed);
    return file.read<double>("bed/position", 3) == rows_of(rank()) &&
           file.read<std::int64_t>("bed/id") == std::vector<std::int64_t>(5, rank()) &&
           file.read_text_attribute("/bed", "scene") == "shaft";
}

}  // namespace

TEST_CASE("files: what a rank wrote it reads back, bit for bit") {
    const std::string path = file_name("back");
    write_checkpoint(path);
    CHECK(reads_back(path));
    CHECK_FALSE(std::filesystem::exists(path + ".part"));
    const hdf5_file file(path, hdf5_file::mode::read);
    std::vector<double> all;
    for (int r = 0; r < size(); ++r) {
        const auto rows = rows_of(r);
        all.insert(all.end(), rows.begin(), rows.end());
    }
    CHECK(file.read_all<double>("bed/position") == all);
    CHECK(file.has("bed/position"));
    CHECK_FALSE(file.has("bed/spin"));
    CHECK_FALSE(file.has("no/such/group"));
    CHECK_THROWS_AS(file.read<double>("bed/spin"), file_error);
    CHECK_THROWS_AS(file.read<double>("bed/position", 2), file_error);
}

TEST_CASE("files: a checkpoint with one changed byte, or cut off, is refused") {
    const std::string path = file_name("damaged");
    write_checkpoint(path);
    std::uintmax_t bytes = rank() == 0 ? std::filesystem::file_size(path) : 0;
    MPI_Bcast(&bytes, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    std::mt19937_64 random(5);
    int refused = 0;
    const int trials = 60;
    for (int k = 0; k < trials; ++k) {
        const std::uintmax_t at = random() % bytes;
        const bool cut = k % 4 == 0;
        write_checkpoint(path);
        damage(path, at, cut);
        try {
            reads_back(path);
        } catch (const file_error&) {
            ++refused;
        }
        MPI_Barrier(MPI_COMM_WORLD);
    }
    CHECK(refused == trials);
}

TEST_CASE("files: a file that is given up leaves the one before it") {
    const std::string path = file_name("kept");
    write_checkpoint(path);
    {
        hdf5_file file(path, hdf5_file::mode::write_checksummed);
        file.write("bed/id", std::vector<std::int64_t>{1, 2, 3});
    }
    MPI_Barrier(MPI_COMM_WORLD);
    CHECK(reads_back(path));
    CHECK_FALSE(std::filesystem::exists(path + ".part"));
}

TEST_CASE("files: errors name the file and the cause") {
    CHECK_THROWS_WITH_AS(hdf5_file("no/such/folder/a.h5", hdf5_file::mode::read),
                         "no/such/folder/a.h5: cannot be opened: No such file or directory", file_error);
    CHECK_THROWS_AS(hdf5_file("no/such/folder/a.h5", hdf5_file::mode::write), file_error);
    const std::string path = file_name("foreign");
    if (rank() == 0) std::ofstream(path) << "not HDF5 at all";
    MPI_Barrier(MPI_COMM_WORLD);
    CHECK_THROWS_WITH_AS(hdf5_file(path, hdf5_file::mode::read), (path + ": is not an HDF5 file").c_str(), file_error);
    CHECK_THROWS_WITH_AS(hdf5_file(path, hdf5_file::mode::read_checksummed),
                         (path + ": " + (rank() == 0 ? "is too short to be a checkpoint" : "another rank failed on this file")).c_str(),
                         file_error);
}

TEST_CASE("pictures: pieces of all ranks, some of them empty, in VTKHDF's layout") {
    const std::string path = file_name("particles");
    std::vector<double> points;
    for (int i = 0; i < 4 * rank(); ++i) points.insert(points.end(), {1.0 * i, 2.0 * i, 3.0 * rank()});
    const auto count = points.size() / 3;
    hearth::io::vtkhdf_file picture(path, hearth::io::vertices(points), 12.5);
    picture.cell_field("temperature_K", std::vector<float>(count, 300.0F));
    picture.point_field("velocity_m_per_s", std::vector<float>(3 * count, 1.0F), 3);
    picture.point_field("id", std::vector<std::int64_t>(count, rank()));
    CHECK_THROWS_AS(picture.point_field("short", std::vector<std::int64_t>(count + 1, 0)), std::logic_error);
    CHECK_THROWS_AS(picture.cell_field("short", std::vector<float>(count + 1, 0.0F)), std::logic_error);
    picture.close();
    const hdf5_file file(path, hdf5_file::mode::read);
    std::vector<std::int64_t> counts, offsets;
    for (int r = 0; r < size(); ++r) {
        counts.push_back(4 * r);
        for (int i = 0; i <= 4 * r; ++i) offsets.push_back(i);
    }
    CHECK(file.read_all<std::int64_t>("VTKHDF/NumberOfPoints") == counts);
    CHECK(file.read_all<std::int64_t>("VTKHDF/Offsets") == offsets);
    CHECK(file.read_all<std::int64_t>("VTKHDF/PointData/id").size() == file.read_all<float>("VTKHDF/CellData/temperature_K").size());
    CHECK(file.read_text_attribute("/VTKHDF", "Type") == "UnstructuredGrid");
    CHECK(file.read_all<double>("VTKHDF/FieldData/TimeValue") == std::vector<double>{12.5});
}
