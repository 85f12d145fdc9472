// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include <hearth/core/conformance.hpp>
#include <hearth/core/strided_cloud.hpp>

namespace {

/// A lattice whose traits lie, each in one way.
struct lying_mesh {
    hearth::lattice truth{{{4, 3, 2}, {1, 1, 1}, {false, false, false}, {0, 0, 0}}};
    enum { honest, lost_centre, flat, forgetful, no_area } lie = honest;
};

struct pair_list {
    std::vector<std::pair<int, int>> pairs;
    double force = 1;
};

bool says(const hearth::conformance_report& report, const std::string& part) {
    for (const std::string& failure : report.failures) {
        if (failure.find(part) != std::string::npos) return true;
    }
    return false;
}

}  // namespace

template <>
struct hearth::mesh_traits<lying_mesh> {
    using index = int;
    using scalar = double;
    using truth = mesh_traits<lattice>;
    static index cell_count(const lying_mesh& m) { return truth::cell_count(m.truth); }
    static scalar volume(const lying_mesh& m, index c) { return truth::volume(m.truth, c); }
    static point centre(const lying_mesh& m, index c) { return truth::centre(m.truth, c); }
    static index find_cell(const lying_mesh& m, const point& x) {
        const index c = truth::find_cell(m.truth, x);
        return m.lie == lying_mesh::lost_centre && c == 5 ? -1 : c;
    }
    static point extent(const lying_mesh& m, index) { return {1, 1, m.lie == lying_mesh::flat ? 0.0 : 1.0}; }
    template <class Visit>
    static void for_each_face(const lying_mesh& m, Visit&& visit) {
        truth::for_each_face(m.truth, [&](index a, index b, double area, double conductance) {
            visit(a, b, m.lie == lying_mesh::no_area ? std::nan("") : area, conductance);
        });
    }
    template <class Visit>
    static void for_each_neighbour(const lying_mesh& m, index c, Visit&& visit) {
        truth::for_each_face(m.truth, [&](index a, index b, double, double) {
            if (m.lie == lying_mesh::forgetful && a == 0) return;
            if (a == c) visit(b);
            if (b == c) visit(a);
        });
    }
};

template <>
struct hearth::contact_traits<pair_list> {
    template <class Visit>
    static void for_each_contact(const pair_list& list, Visit&& visit) {
        for (const auto& [i, j] : list.pairs) visit(i, j, contact{list.force, 0.0, {0, 0, 0}});
    }
};

TEST_CASE("conformance: honest traits pass, and the cost of an access is told") {
    const auto report = hearth::conformance(lying_mesh{});
    CHECK(report.passed());
    CHECK(report.checks > 24 * 3);
    CHECK(report.seconds_per_access > 0);
    CHECK(hearth::conformance(hearth::lattice{{{5, 1, 1}, {1, 2, 3}, {true, true, false}, {0, 0, 0}}}).passed());
}

TEST_CASE("conformance: each lie is told in a sentence") {
    lying_mesh mesh;
    mesh.lie = lying_mesh::lost_centre;
    CHECK(says(hearth::conformance(mesh), "find_cell does not find a cell at its own centre, at 5"));
    mesh.lie = lying_mesh::flat;
    const auto flat = hearth::conformance(mesh);
    CHECK(says(flat, "an extent of a cell is not finite and > 0"));
    CHECK(flat.failures.size() == 3);  // the same sentence for 24 cells is kept three times
    mesh.lie = lying_mesh::forgetful;
    CHECK(says(hearth::conformance(mesh), "for_each_neighbour and for_each_face list different neighbours"));
    mesh.lie = lying_mesh::no_area;
    CHECK(says(hearth::conformance(mesh), "the area of a face is not finite and > 0"));
    mesh = {};
    mesh.truth.spacing[0] = -1;
    CHECK(says(hearth::conformance(mesh), "volume of cell 0 is -1"));
}

TEST_CASE("conformance: particles and contacts") {
    std::vector<double> x{0, 0, 0, 1, 0, 0, 0, 2, 0}, radius{0.5, 0.5, 0.5}, temperature{300, 400, 500};
    std::vector<std::int64_t> ids{7, 8, 9};
    hearth::strided_cloud<double> cloud;
    cloud.count = 3;
    cloud.position = {x.data(), 3};
    cloud.radius = {radius.data(), 1};
    cloud.temperature = {temperature.data(), 1};
    cloud.ids = ids.data();
    CHECK(hearth::cloud_conformance(cloud).passed());
    radius[1] = 0;
    CHECK(says(hearth::cloud_conformance(cloud), "the radius of a particle is not finite and > 0, at 1"));
    radius[1] = 1;
    ids[2] = 7;
    CHECK(says(hearth::cloud_conformance(cloud), "two particles have one global index, at 7"));
    x[4] = std::nan("");
    CHECK(says(hearth::cloud_conformance(cloud), "the position of a particle is not finite, at 1"));

    CHECK(hearth::contact_conformance(pair_list{{{0, 1}, {1, 2}}}, 3).passed());
    CHECK(says(hearth::contact_conformance(pair_list{{{0, 1}, {1, 0}}}, 3), "a pair in contact is visited twice, at 0"));
    CHECK(says(hearth::contact_conformance(pair_list{{{1, 1}}}, 3), "a contact of no particle of this rank, at 1"));
    CHECK(says(hearth::contact_conformance(pair_list{{{0, 1}}, -1.0}, 3), "a normal force is not >= 0, at 0"));
}

TEST_CASE("strided cloud: reads and writes an array of structs in place") {
    struct atom { double x[3]; double radius, temperature, heat, force[3]; };
    std::vector<atom> atoms(3, atom{{1, 2, 3}, 0.5, 300, 1, {0, 0, 0}});
    atoms[2] = {{4, 5, 6}, 0.25, 900, 2, {1, 1, 1}};
    constexpr std::ptrdiff_t stride = sizeof(atom) / sizeof(double);
    hearth::strided_cloud<double> cloud;
    cloud.count = 3;
    cloud.position = {atoms[0].x, stride};
    cloud.radius = {&atoms[0].radius, stride};
    cloud.temperature = {&atoms[0].temperature, stride};
    cloud.heat_rate = {&atoms[0].heat, stride};
    cloud.force = {atoms[0].force, stride};
    using traits = hearth::particle_traits<hearth::strided_cloud<double>>;
    CHECK(traits::get(hearth::quantity::position{}, cloud, 2)[1] == 5);
    CHECK(traits::get(hearth::quantity::radius{}, cloud, 2) == 0.25);
    traits::add(hearth::quantity::heat_rate{}, cloud, 2, 10.0);
    traits::add(hearth::quantity::force{}, cloud, 2, std::vector<double>{1, 2, 3});
    traits::set(hearth::quantity::temperature{}, cloud, 1, 555.0);
    CHECK(atoms[2].heat == 12);
    CHECK(atoms[2].force[2] == 4);
    CHECK(atoms[1].temperature == 555);
    CHECK(traits::global_index(cloud, 1) == 1);
    static_assert(hearth::is_particle_cloud_v<hearth::strided_cloud<float>>);
    static_assert(!hearth::can_get_v<hearth::strided_cloud<double>, hearth::quantity::moisture>);
}
