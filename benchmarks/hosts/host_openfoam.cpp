// SPDX-License-Identifier: MIT
// What hearth costs on OpenFOAM's mesh and fields, beside the same numbers in plain arrays: 64000 cells, 4000 spheres.
// set-up: the graph and the locator, once per mesh.  step: void fraction, a vector to the cells, a vector to the
// spheres. The results are the same to the bit.
#include "fvCFD.H"

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <hearth/adapt/openfoam.hpp>
#include <hearth/core/strided_cloud.hpp>
#include <hearth/voidage/transfer_operator.hpp>

#include "hosts/beside.hpp"
#include "support/random.hpp"

namespace {

/// The mesh of blockMesh in the case of tests/hosts, with more cells.
const fvMesh& host_mesh() {
    static const std::unique_ptr<const Foam::Time> time = [] {
        const std::string folder = "openfoam_block";
        const std::string make = "rm -rf " + folder + " && cp -r " HEARTH_OPENFOAM_CASE " " + folder +
                                 " && sed -i 's/(16 14 18)/(40 40 40)/' " + folder +
                                 "/system/blockMeshDict && blockMesh -case " + folder + " >/dev/null";
        if (std::system(make.c_str()) != 0) std::abort();
        return std::make_unique<const Foam::Time>(Foam::Time::controlDictName, ".", folder);
    }();
    static const fvMesh mesh(IOobject(fvMesh::defaultRegion, time->timeName(), *time, IOobject::MUST_READ));
    return mesh;
}

/// All that the adapter tells, in arrays.
struct copied_mesh {
    struct face {
        int owner, neighbour;
        double area, conductance;
    };
    std::vector<double> volumes;
    std::vector<hearth::point> centres, extents;
    std::vector<face> faces;
    hearth::point period{};
};

hearth::point plain(const Foam::vector& v) { return {v.x(), v.y(), v.z()}; }

const copied_mesh& own_mesh() {
    static const copied_mesh made = [] {
        using traits = hearth::mesh_traits<fvMesh>;
        const fvMesh& host = host_mesh();
        copied_mesh mesh;
        for (int c = 0; c < traits::cell_count(host); ++c) {
            mesh.volumes.push_back(traits::volume(host, c));
            mesh.centres.push_back(plain(traits::centre(host, c)));
            mesh.extents.push_back(plain(traits::extent(host, c)));
        }
        traits::for_each_face(host, [&](int a, int b, double area, double g) {
            mesh.faces.push_back({a, b, area, g});
        });
        mesh.period = plain(traits::period(host));
        return mesh;
    }();
    return made;
}

}  // namespace

template <>
struct hearth::mesh_traits<copied_mesh> {
    using index = int;
    using scalar = double;
    static index cell_count(const copied_mesh& m) { return static_cast<int>(m.volumes.size()); }
    static double volume(const copied_mesh& m, index c) { return m.volumes[static_cast<std::size_t>(c)]; }
    static const point& centre(const copied_mesh& m, index c) { return m.centres[static_cast<std::size_t>(c)]; }
    static const point& extent(const copied_mesh& m, index c) { return m.extents[static_cast<std::size_t>(c)]; }
    static const point& period(const copied_mesh& m) { return m.period; }
    template <class Visit>
    static void for_each_face(const copied_mesh& m, Visit&& visit) {
        for (const auto& f : m.faces) visit(f.owner, f.neighbour, f.area, f.conductance);
    }
};

namespace {

template <class Mesh>
struct set_up {
    hearth::cell_graph<> graph;
    hearth::cell_locator<Mesh> locator;
    explicit set_up(const Mesh& mesh) : graph(mesh), locator(mesh, graph) {}
};

void openfoam_set_up(benchmark::State& state) {
    const fvMesh& host = host_mesh();
    const copied_mesh& own = own_mesh();
    bench::beside(
        state, [&] { benchmark::DoNotOptimize(std::make_unique<set_up<fvMesh>>(host)); },
        [&] { benchmark::DoNotOptimize(std::make_unique<set_up<copied_mesh>>(own)); });
}

void openfoam_step(benchmark::State& state) {
    const fvMesh& mesh = host_mesh();
    const set_up<fvMesh> host(mesh);
    const set_up<copied_mesh> own(own_mesh());
    hearth_test::seeded random(1912);
    std::vector<double> positions, radii;
    for (int i = 0; i < 4000; ++i) {
        for (int a = 0; a < 3; ++a) positions.push_back(random.uniform(0.0, 0.08));
        radii.push_back(random.uniform(0.0015, 0.003));
    }
    hearth::strided_cloud<> cloud;
    cloud.count = 4000;
    cloud.position = {positions.data(), 3};
    cloud.radius = {radii.data(), 1};

    hearth::transfer_operator<fvMesh> host_map(host.locator, {0.001, 0.9});
    hearth::transfer_operator<copied_mesh> own_map(own.locator, {0.001, 0.9});
    volScalarField solid(IOobject("solid", mesh.time().timeName(), mesh), mesh, dimensionedScalar(dimless, Zero));
    volVectorField force(IOobject("force", mesh.time().timeName(), mesh), mesh, dimensionedVector(dimless, Zero));
    std::vector<double> own_solid(own_mesh().volumes.size());
    std::vector<hearth::point> own_force(own_solid.size()), given(4000, {1, 2, 3}), seen(4000), own_seen(4000);
    bench::beside(
        state,
        [&] {
            host_map.distribute(cloud, solid);
            host_map.scatter(given, force);
            host_map.gather(force, seen);
        },
        [&] {
            own_map.distribute(cloud, own_solid);
            own_map.scatter(given, own_force);
            own_map.gather(own_force, own_seen);
        });
    bool same = true;
    forAll(solid, c) same = same && solid[c] == own_solid[static_cast<std::size_t>(c)];
    if (!same || seen != own_seen) state.SkipWithError("the results differ");
}

BENCHMARK(openfoam_set_up)
    ->Name("hosts/OpenFOAM/set-up")
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(openfoam_step)->Name("hosts/OpenFOAM/step")->UseManualTime()->Iterations(40)->Unit(benchmark::kMillisecond);

}  // namespace
