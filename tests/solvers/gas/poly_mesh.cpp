// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include <doctest/doctest.h>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/poly_mesh.hpp>
#include <hearth/gas/solver.hpp>

using namespace hearth::gas;

namespace {

namespace fs = std::filesystem;

std::string header(const char* kind, const char* object, bool binary, int label_bits) {
    std::ostringstream out;
    out << "/*---- a banner; with (brackets) ----*/\nFoamFile\n{\n    version 2.0;\n    format "
        << (binary ? "binary" : "ascii") << ";\n    arch \"LSB;label=" << label_bits
        << ";scalar=64\";\n    note \"nPoints: 1 nCells: 2\";\n    class " << kind << ";\n    object " << object
        << ";\n}\n// * * *\n\n";
    return out.str();
}

template <class Label>
void write_labels(std::ostream& out, const array<int>& values, bool binary) {
    out << values.size() << "\n(";
    for (const int v : values) {
        const auto label = static_cast<Label>(v);
        if (binary) out.write(reinterpret_cast<const char*>(&label), sizeof label);
        else out << '\n' << v;
    }
    out << ")\n\n// end\n";
}

/// Writes a mesh as OpenFOAM does: its layout is that of the documentation of the polyMesh format.
template <class Label>
fs::path write(const polyhedra& p, const char* name, bool binary) {
    const fs::path folder = fs::temp_directory_path() / (std::string("hearth_poly_mesh_") + name);
    fs::create_directories(folder);
    const int bits = 8 * static_cast<int>(sizeof(Label));
    const auto open = [&](const char* kind, const char* file) {
        std::ofstream out(folder / file, std::ios::binary);
        out.precision(17);
        out << header(kind, file, binary, bits);
        return out;
    };
    auto points = open("vectorField", "points");
    points << p.points.size() << "\n(";
    for (const vector3& x : p.points) {
        if (binary) points.write(reinterpret_cast<const char*>(&x), 24);
        else points << "\n(" << x.x << ' ' << x.y << ' ' << x.z << ')';
    }
    points << ")\n";
    auto faces = open(binary ? "faceCompactList" : "faceList", "faces");
    if (binary) {
        write_labels<Label>(faces, p.face_first, true);
        write_labels<Label>(faces, p.face_points, true);
    } else {
        faces << p.owner.size() << "\n(\n";
        for (std::size_t f = 0; f < p.owner.size(); ++f) {
            faces << p.face_first[f + 1] - p.face_first[f] << '(';
            for (int i = p.face_first[f]; i < p.face_first[f + 1]; ++i) faces << (i > p.face_first[f] ? " " : "") << p.face_points[i];
            faces << ")\n";
        }
        faces << ")\n";
    }
    auto owner = open("labelList", "owner");
    write_labels<Label>(owner, p.owner, binary);
    auto neighbour = open("labelList", "neighbour");
    write_labels<Label>(neighbour, p.neighbour, binary);
    std::ofstream boundary(folder / "boundary");
    boundary << header("polyBoundaryMesh", "boundary", false, bits) << p.patches.size() << "\n(\n";
    for (const patch& q : p.patches)
        boundary << "    " << q.name << "\n    {\n        type wall;\n        inGroups 1(wall);\n        nFaces " << q.count
                 << ";\n        startFace " << q.first << ";\n    }\n";
    boundary << ")\n";
    return folder;
}

void replace(const fs::path& file, const std::string& from, const std::string& to) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    std::string text = all.str();
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    std::ofstream(file, std::ios::binary) << text;
}

polyhedra sample() { return box(graded(1, 3), graded(0.5, 2, 3.0), graded(1.0 / 3, 2)); }

}  // namespace

TEST_CASE("poly_mesh: ASCII, binary, and 64-bit binary give the very mesh that was written") {
    const polyhedra p = sample();
    for (const fs::path& folder : {write<std::int32_t>(p, "ascii", false), write<std::int32_t>(p, "binary", true),
                                   write<std::int64_t>(p, "binary64", true)}) {
        CAPTURE(folder.string());
        const polyhedra q = read_poly_mesh(folder.string());
        CHECK(q.owner == p.owner);
        CHECK(q.neighbour == p.neighbour);
        CHECK(q.face_points == p.face_points);
        CHECK(q.face_first == p.face_first);
        REQUIRE(q.points.size() == p.points.size());
        for (std::size_t i = 0; i < p.points.size(); ++i) CHECK(norm(q.points[i] - p.points[i]) == 0);
        REQUIRE(q.patches.size() == 6);
        CHECK(q.patches[3].name == p.patches[3].name);
        CHECK(q.patches[3].first == p.patches[3].first);
        CHECK(mesh(q).owned_cells() == 12);
        fs::remove_all(folder);
    }
}

TEST_CASE("poly_mesh: each fault of a file is told with file and line") {
    struct fault { const char *file, *from, *to, *says; };
    for (const fault& f : {fault{"owner", "\n0\n0", "\n0\nx", "expected a number, found 'x'"},
                           fault{"points", "(0 0 0)", "(0 0)", "expected a number"},
                           fault{"faces", "4(", "4[", "found"},
                           fault{"boundary", "startFace", "firstFace", "lacks nFaces or startFace"},
                           fault{"boundary", "6\n(", "7\n(", ""},
                           fault{"neighbour", "FoamFile", "Foam", "expected 'FoamFile'"},
                           fault{"owner", "\n(\n0", "\n(\n0.5", "whole number"},
                           fault{"owner", "// * * *", "/* * *", "a comment does not end"}}) {
        const fs::path folder = write<std::int32_t>(sample(), "faulty", false);
        replace(folder / f.file, f.from, f.to);
        CAPTURE(f.file); CAPTURE(f.says);
        try {
            const polyhedra p = read_poly_mesh(folder.string());
            FAIL("was accepted");
        } catch (const file_error& e) {
            CHECK(e.file == (folder / f.file).string());
            CHECK(e.line > 0);
            CHECK(std::string(e.what()).find(f.says) != std::string::npos);
        }
        fs::remove_all(folder);
    }
}

TEST_CASE("poly_mesh: missing, compressed and cut files are refused; a count beyond the file asks for no memory") {
    CHECK_THROWS_AS(read_poly_mesh("/nowhere"), file_error);
    const fs::path folder = write<std::int32_t>(sample(), "cut", true);
    fs::resize_file(folder / "points", fs::file_size(folder / "points") / 2);
    CHECK_THROWS_WITH_AS(read_poly_mesh(folder.string()), doctest::Contains("cut off"), file_error);
    std::ofstream(folder / "points", std::ios::binary) << "\x1f\x8b";
    CHECK_THROWS_WITH_AS(read_poly_mesh(folder.string()), doctest::Contains("compressed"), file_error);
    std::ofstream(folder / "points", std::ios::binary) << header("vectorField", "points", false, 32) << "2000000000\n(";
    CHECK_THROWS_WITH_AS(read_poly_mesh(folder.string()), doctest::Contains("does not fit"), file_error);
    fs::remove_all(folder);
}

TEST_CASE("poly_mesh: a mesh of snappyHexMesh, refined and snapped to a tube, is closed and carries flow") {
    const mesh m(read_poly_mesh(HEARTH_SNAPPED_MESH));  // by snapped/make.sh; its constructor checks each cell
    REQUIRE(m.owned_cells() == 321);
    array<int> faces(m.cells(), 0);
    for (int f = 0; f < m.faces(); ++f) {
        ++faces[m.owner[f]];
        if (f < m.internal_faces()) ++faces[m.neighbour[f]];
    }
    int polyhedra = 0;
    for (const int n : faces) polyhedra += n > 6;
    CHECK(polyhedra > 50);  // coarse cells beside finer ones
    CHECK(m.largest_angle == doctest::Approx(30.07).epsilon(0.001));  // as checkMesh says

    // 8 x 8 x 10 cm around a tube of 26 mm to 45 mm.  Cells of 8 mm make of it an octagon or better, 10 % smaller at most,
    // and round the edge of its end.
    double volume = 0;
    for (int c = 0; c < m.cells(); ++c) volume += m.volume[c];
    const double box_volume = 0.08 * 0.08 * 0.1, tube = std::acos(-1.0) * 0.013 * 0.013 * 0.045;
    CHECK(std::abs(volume - (box_volume - tube)) < 0.15 * tube);
    CHECK(m.area_of(m.find_patch("top")) == doctest::Approx(0.08 * 0.08).epsilon(1e-6));  // 7 digits are in the file
    CHECK(m.area_of(m.find_patch("floor")) == doctest::Approx(0.08 * 0.08 - tube / 0.045).epsilon(0.01));
    for (int c = 0; c < m.cells(); ++c) CHECK(m.find_cell(m.centre[c]) == c);

    array<double> field(m.cells()), boundary(m.boundary_faces());
    const vector3 slope{1, -2, 3};
    for (int c = 0; c < m.cells(); ++c) field[c] = dot(slope, m.centre[c]);
    for (int b = 0; b < m.boundary_faces(); ++b) boundary[b] = dot(slope, m.face_centre[b + m.internal_faces()]);
    array<vector3> found(m.cells());
    gradient(m).compute<1>(field.data(), boundary.data(), found.data());
    for (const vector3& g : found) CHECK(norm(g - slope) < 1e-12);

    // Gas through a bed of 6 mm spheres, uneven from cell to cell, between cold walls.
    solver gas(m, std::make_shared<simple_gas>());
    gas.settings.gravity = {0, 0, 0};
    gas.set("floor", mass_flow_inlet(2e-3, {600}));
    gas.set("top", pressure_outlet(101325, {600}));
    gas.set("sides", wall(wall_heat{20, 300}));
    std::mt19937_64 random(3);
    for (int c = 0; c < m.cells(); ++c) {
        gas.bed.diameter[c] = 0.006;
        gas.bed.void_fraction[c] = 0.35 + 0.2 * static_cast<double>(random() >> 11) * 0x1p-53;
    }
    gas.initialise(600);
    const report r = gas.steady();
    CAPTURE(r.reason);
    MESSAGE(r.iterations << " iterations, pressure drop " << gas.mean_pressure("floor") - 101325 << " Pa");
    CHECK(r.converged);
    CHECK(r.mass.error < 1e-10);
    CHECK(r.enthalpy.error < 1e-10);
    for (int c = 0; c < m.cells(); ++c) {
        CHECK(gas.gas.temperature[c] > 300);
        CHECK(gas.gas.temperature[c] < 600.1);  // what crosses leaning faces is not bounded: 1e-4 of the range
    }
}
