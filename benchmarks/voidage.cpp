// SPDX-License-Identifier: MIT
// Solid fraction of a random bed of spheres, ours and what others do, on five kinds of mesh.
//
// error: rms difference [-] from the exact indicator of the spheres under a Gaussian of half a diameter, reflected at
// the walls, over about 1000 cells of the mesh, weighted with their volumes.  d_dx: diameter over the cube root of the
// mean volume of the cells.  Methods that resolve the spheres aim at another field and are far from this one at d_dx >
// 1: that is the point, see filtered_fraction.hpp.
//
// On the lattice also error_ball: the same against a top-hat of equal variance, two diameters and more from the walls,
// which flatters no method; ball_from_gauss: how far these two exact fields are from each other there; and the
// permeability (see support/darcy.hpp; fractions outside 0.05 to 0.99 count as these) over that of the mean fraction
// and over that of the exact field.
#include "rivals/voidage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <benchmark/benchmark.h>

#include <hearth/core/lattice.hpp>
#include <hearth/voidage/filtered_fraction.hpp>
#include <hearth/voidage/kernel_smoother.hpp>
#include <hearth/voidage/vfs.hpp>

#include "support/beds.hpp"
#include "support/box_mesh.hpp"
#include "support/counters.hpp"
#include "support/darcy.hpp"
#include "support/polyhedra.hpp"

namespace {

using namespace hearth::test;
using hearth::point;

constexpr double side = 8;

const packing& bed() {
    static const packing made = make_packing({0.55, {side, side, side}, 0, {false, false, false}, 401});
    return made;
}

hearth::lattice make_mesh(const hearth::lattice*, double d_dx) { return lattice_over(bed(), d_dx); }

struct graded_mesh : box_mesh {
    using box_mesh::box_mesh;
};
/// The last cell of an axis is four times as long as the first: volumes over a factor of 64.
graded_mesh make_mesh(const graded_mesh*, double d_dx) {
    const int n = static_cast<int>(side * d_dx);
    const double ratio = std::pow(4.0, 1.0 / (n - 1));
    return {{graded_planes(side, n, ratio), graded_planes(side, n, ratio), graded_planes(side, n, ratio)},
            {false, false, false}};
}

struct split_mesh : box_mesh {
    using box_mesh::box_mesh;
};
/// Every third block of boxes is split into eights: polyhedra with up to 24 faces beside them.
split_mesh make_mesh(const split_mesh*, double d_dx) {
    const int n = std::max(2, static_cast<int>(std::lround(side * d_dx / std::cbrt(1 + 7.0 / 3))));
    const auto planes = graded_planes(side, n, 1);
    return {{planes, planes, planes}, {false, false, false}, [](int i, int j, int k) {
                return (i / 2 + j / 2 + k / 2) % 3 == 0;
            }};
}

struct tetrahedra : polyhedral_mesh {
    using polyhedral_mesh::polyhedral_mesh;
};
tetrahedra make_mesh(const tetrahedra*, double d_dx) {  // twelve to a cube
    return {tetrahedra::cells::tetrahedra, side,
            std::max(1, static_cast<int>(std::lround(side * d_dx / std::cbrt(12))))};
}

struct polyhedra : polyhedral_mesh {
    using polyhedral_mesh::polyhedral_mesh;
};
polyhedra make_mesh(const polyhedra*, double d_dx) {  // two to a cube
    return {polyhedra::cells::polyhedra, side, std::max(1, static_cast<int>(std::lround(side * d_dx / std::cbrt(2))))};
}

template <class Mesh>
inline constexpr bool is_lattice_v = std::is_same_v<Mesh, hearth::lattice>;
template <class Mesh>
inline constexpr bool has_pieces_v = std::is_base_of_v<polyhedral_mesh, Mesh>;

/// Mean of an exact field over a cell.
template <class Mesh, class Truth>
double mean_over(const Mesh& mesh, int cell, const Truth& truth) {
    if constexpr (has_pieces_v<Mesh>) {
        double sum = 0, volume = 0;
        for (const auto& part : mesh.pieces[static_cast<std::size_t>(cell)]) {
            sum += part.volume * truth.at(part.centroid);
            volume += part.volume;
        }
        return sum / volume;
    } else {
        const point extent = hearth::mesh_traits<Mesh>::extent(mesh, cell);
        return truth.mean(hearth::mesh_traits<Mesh>::centre(mesh, cell), extent, points_for(extent[0]));
    }
}

}  // namespace

template <>
struct hearth::mesh_traits<graded_mesh> : hearth::mesh_traits<box_mesh> {};
template <>
struct hearth::mesh_traits<split_mesh> : hearth::mesh_traits<box_mesh> {};
template <>
struct hearth::mesh_traits<tetrahedra> : hearth::mesh_traits<polyhedral_mesh> {};
template <>
struct hearth::mesh_traits<polyhedra> : hearth::mesh_traits<polyhedral_mesh> {};

namespace {

/// A mesh with all that methods may prepare once, and the truth in some of its cells.
template <class Mesh>
struct prepared {
    explicit prepared(double d_dx)
        : mesh(make_mesh(static_cast<const Mesh*>(nullptr), d_dx)), graph(mesh), locator(mesh, graph) {
        const auto gauss = gauss_truth(bed());
        stride = std::max(1, graph.cell_count() / 1000) | 1;
        for (int c = 0; c < graph.cell_count(); c += stride) exact.push_back(mean_over(mesh, c, gauss));
        if constexpr (is_lattice_v<Mesh>) {
            const auto ball = ball_truth(bed());
            for (int c = 0; c < graph.cell_count(); c += stride) in_balls.push_back(mean_over(mesh, c, ball));
            std::vector<double> everywhere;
            for (int c = 0; c < graph.cell_count(); ++c) {
                everywhere.push_back(d_dx > 4 ? gauss.at(hearth::mesh_traits<Mesh>::centre(mesh, c))
                                              : mean_over(mesh, c, gauss));
            }
            exact_permeability = relative_permeability(mesh, everywhere);
        }
    }
    double error(const std::vector<double>& field) const {
        double squares = 0, volumes = 0;
        for (std::size_t k = 0; k < exact.size(); ++k) {
            const int c = static_cast<int>(k) * stride;
            const double difference = field[static_cast<std::size_t>(c)] - exact[k];
            squares += difference * difference * graph.volume(c);
            volumes += graph.volume(c);
        }
        return std::sqrt(squares / volumes);
    }
    static const prepared& at(double d_dx) {
        static std::map<double, std::unique_ptr<prepared>> made;
        auto& one = made[d_dx];
        if (!one) one = std::make_unique<prepared>(d_dx);
        return *one;
    }

    Mesh mesh;
    hearth::cell_graph<> graph;
    hearth::cell_locator<Mesh> locator;
    int stride = 1;
    std::vector<double> exact, in_balls;  // of every stride-th cell
    double exact_permeability = 0;        // over that of the mean
};

constexpr double sigma = 0.5;

/// Runs method(prepared) -> field and compares.
template <class Mesh, class Method>
void compare(benchmark::State& state, double d_dx, const Method& method) {
    const auto& on = prepared<Mesh>::at(d_dx);
    std::vector<double> field;
    for (auto _ : state) {
        field = method(on);
        benchmark::DoNotOptimize(field.data());
    }
    bench::set_error(state, on.error(field));
    bench::set_items(state, static_cast<double>(bed().radii.size()));
    double volume = 0;
    for (int c = 0; c < on.graph.cell_count(); ++c) volume += field[static_cast<std::size_t>(c)] * on.graph.volume(c);
    state.counters["lost_volume"] = 1 - volume / bed().volume();
    if constexpr (is_lattice_v<Mesh>) {
        const auto difference = [&](const std::vector<double>& a) {
            return rms_difference(on.mesh, bed(), a, on.in_balls, on.stride, 2);
        };
        state.counters["error_ball"] = difference(every(field, on.stride));
        state.counters["ball_from_gauss"] = difference(on.exact);
        if (d_dx < 1 || (d_dx > 4 && *std::min_element(field.begin(), field.end()) < 0.05)) return;  // takes minutes
        for (double& fraction : field) fraction = std::clamp(fraction, 0.05, 0.99);
        const double permeability = relative_permeability(on.mesh, field);
        state.counters["permeability_over_mean"] = permeability;
        state.counters["permeability_over_exact"] = permeability / on.exact_permeability;
    }
}

template <class Prepared>
std::vector<double> smoothed(const Prepared& on, double threshold, hearth::vfs_variant variant) {
    std::vector<double> field(static_cast<std::size_t>(on.graph.cell_count()));
    hearth::deposit_solid_fraction(on.locator, bed(), field, hearth::deposit::centre{});
    const auto report = hearth::volume_fraction_smoother(on.graph, {threshold, variant}).smooth(field);
    benchmark::DoNotOptimize(report.sweeps);
    return field;
}

template <class Prepared, class Mesh>
std::vector<double> filtered(const Prepared& on, hearth::transfer_operator<Mesh>& transfer) {
    std::vector<double> field(static_cast<std::size_t>(on.graph.cell_count()));
    benchmark::DoNotOptimize(transfer.distribute(bed(), field).maximum);
    return field;
}

template <class Mesh>
void register_mesh(const std::string& family) {
    for (const double d_dx : {0.5, 1.0, 2.0, 4.0, 8.0}) {
        if (has_pieces_v<Mesh> && d_dx > 4) continue;  // making the mesh takes a gigabyte
        const std::string at = "/d_dx:" + std::to_string(d_dx).substr(0, d_dx < 1 ? 3 : 1);
        const auto add = [&](const std::string& method, const auto& run) {
            benchmark::RegisterBenchmark((family + "/" + method + at).c_str(), [=](benchmark::State& state) {
                compare<Mesh>(state, d_dx, run);
            })->Unit(benchmark::kMillisecond);
        };
        for (const double threshold : {0.9, 0.74}) {
            const std::string limit = threshold > 0.8 ? "/threshold 0.9" : "/threshold 0.74";
            add("centre, clamped" + limit, [=](const auto& on) {
                return rivals::clamped(on.locator, bed(), hearth::deposit::centre{}, threshold);
            });
            add("divided, clamped" + limit, [=](const auto& on) {
                return rivals::clamped(on.locator, bed(), hearth::deposit::divided{}, threshold);
            });
            add("VFS of the paper" + limit,
                [=](const auto& on) { return smoothed(on, threshold, hearth::vfs_variant::paper); });
            add("VFS completed" + limit,
                [=](const auto& on) { return smoothed(on, threshold, hearth::vfs_variant::completed); });
            // Set up with the mesh, as a host would that keeps it.
            auto transfer = std::make_shared<std::unique_ptr<hearth::transfer_operator<Mesh>>>();
            add("filtered" + limit, [=](const auto& on) {
                if (!*transfer) {
                    hearth::filtered_fraction_settings settings;
                    settings.threshold = threshold;
                    *transfer = std::make_unique<hearth::transfer_operator<Mesh>>(on.locator, settings);
                }
                return filtered(on, **transfer);
            });
        }
        add("Gauss", [](const auto& on) { return rivals::gauss(on.locator, bed(), sigma); });
        add("implicit diffusion", [](const auto& on) { return rivals::implicit_diffusion(on.locator, bed(), sigma); });
        if constexpr (!has_pieces_v<Mesh>)
            add("exact overlap", [](const auto& on) { return rivals::exact_overlap(on.locator, bed()); });
        add("ramp alone", [](const auto& on) {
            return rivals::clamped(on.locator, bed(), hearth::deposit::ramp{}, std::numeric_limits<double>::infinity());
        });
    }
}

/// The kernel smoother alone on six million cells; error: relative change of the volume.
template <class Mesh>
void smoother(benchmark::State& state, double width, double bytes_per_cell) {
    static const hearth::lattice shape{{{182, 182, 182}, {1, 1, 1}, {false, false, false}, {0, 0, 0}}};
    static const Mesh mesh{shape};
    static const hearth::cell_graph<> graph(mesh);
    hearth::kernel_smoother<> kernel(graph, width);
    std::vector<double> field(static_cast<std::size_t>(graph.cell_count()));
    hearth_test::seeded random(1);
    for (double& value : field) value = random.uniform(0, 1);
    const auto total = [&] {
        long double sum = 0;
        for (const double value : field) sum += static_cast<long double>(value);
        return sum;
    };
    const long double before = total();
    for (auto _ : state) kernel.smooth(field);
    bench::set_error(state, static_cast<double>(std::abs(total() / before - 1)));
    bench::set_items(state, static_cast<double>(field.size()) * kernel.terms());
    bench::set_compulsory_bytes(state, bytes_per_cell * static_cast<double>(field.size()) * kernel.terms());
    state.counters["terms"] = kernel.terms();
}

/// The same lattice without saying so.
struct faces_only : hearth::lattice {};

/// Sources out and gas values back on the lattice; error: of sum f u = sum F U, relative to the sum of magnitudes.
void transfer_both_ways(benchmark::State& state, double d_dx) {
    const auto& on = prepared<hearth::lattice>::at(d_dx);
    hearth::transfer_operator<hearth::lattice> transfer(on.locator);
    const auto cells = static_cast<std::size_t>(on.graph.cell_count()), particles = bed().radii.size();
    std::vector<double> sources(particles), received(cells), gas(cells), seen(particles);
    transfer.distribute(bed(), received);
    hearth_test::seeded random(1);
    for (double& value : sources) value = random.uniform(-1, 1);
    for (double& value : gas) value = random.uniform(-1, 1);
    for (auto _ : state) {
        transfer.scatter(sources, received);
        transfer.gather(gas, seen);
    }
    double at_cells = 0, at_particles = 0, magnitude = 0;
    for (std::size_t c = 0; c < cells; ++c) at_cells += received[c] * gas[c];
    for (std::size_t p = 0; p < particles; ++p) {
        at_particles += sources[p] * seen[p];
        magnitude += std::abs(sources[p]);
    }
    bench::set_error(state, std::abs(at_cells - at_particles) / magnitude);
    bench::set_items(state, static_cast<double>(particles));
}

/// What particles see of a gas, six scalars and its velocity, gathered together or one after the other; error: largest
/// difference between the two, relative to the largest value.
template <class Mesh>
void gas_at_particles(benchmark::State& state, double d_dx, bool together) {
    const auto& on = prepared<Mesh>::at(d_dx);
    hearth::transfer_operator<Mesh> transfer(on.locator);
    const auto cells = static_cast<std::size_t>(on.graph.cell_count()), particles = bed().radii.size();
    std::vector<double> fraction(cells);
    transfer.distribute(bed(), fraction);
    hearth_test::seeded random(1);
    std::array<std::vector<double>, 6> gas;
    std::vector<std::array<double, 3>> velocity(cells);
    for (auto& field : gas) {
        for (std::size_t c = 0; c < cells; ++c) field.push_back(random.uniform(-1, 1));
    }
    for (auto& u : velocity) u = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    struct view {
        std::array<std::vector<double>, 6> scalars;
        std::vector<std::array<double, 3>> velocity;
    };
    const auto see = [&](view& at, bool at_once) {
        for (auto& field : at.scalars) field.resize(particles);
        at.velocity.resize(particles);
        if (at_once) {
            transfer.gather(std::tie(gas[0], gas[1], gas[2], gas[3], gas[4], gas[5], velocity),
                            std::tie(at.scalars[0], at.scalars[1], at.scalars[2], at.scalars[3], at.scalars[4], at.scalars[5],
                                     at.velocity));
            return;
        }
        for (std::size_t k = 0; k < gas.size(); ++k) transfer.gather(gas[k], at.scalars[k]);
        transfer.gather(velocity, at.velocity);
    };
    view seen, other;
    for (auto _ : state) see(seen, together);
    see(other, !together);
    double difference = 0;
    for (std::size_t p = 0; p < particles; ++p) {
        for (std::size_t k = 0; k < gas.size(); ++k)
            difference = std::max(difference, std::abs(seen.scalars[k][p] - other.scalars[k][p]));
        for (std::size_t a = 0; a < 3; ++a)
            difference = std::max(difference, std::abs(seen.velocity[p][a] - other.velocity[p][a]));
    }
    bench::set_error(state, difference);
    bench::set_items(state, static_cast<double>(particles));
}

}  // namespace

template <>
struct hearth::mesh_traits<faces_only> {
    using base = hearth::mesh_traits<hearth::lattice>;
    using index = base::index;
    using scalar = double;
    static index cell_count(const faces_only& m) { return base::cell_count(m); }
    static double volume(const faces_only& m, index c) { return base::volume(m, c); }
    template <class Visit>
    static void for_each_face(const faces_only& m, Visit&& visit) {
        base::for_each_face(m, visit);
    }
};

namespace {

const bool registered = [] {
    register_mesh<hearth::lattice>("solid fraction on a lattice");
    register_mesh<graded_mesh>("solid fraction on a graded mesh");
    register_mesh<split_mesh>("solid fraction on a mesh with hanging faces");
    register_mesh<polyhedra>("solid fraction on polyhedra");
    register_mesh<tetrahedra>("solid fraction on tetrahedra");
    for (const double d_dx : {1.0, 2.0, 4.0}) {
        benchmark::RegisterBenchmark(
            ("transfer both ways/stored footprints/d_dx:" + std::to_string(static_cast<int>(d_dx))).c_str(),
            transfer_both_ways, d_dx)
            ->Unit(benchmark::kMillisecond);
    }
    for (const bool together : {true, false}) {
        const std::string how = together ? "/together/d_dx:2" : "/one by one/d_dx:2";
        benchmark::RegisterBenchmark(("gas at particles on a lattice" + how).c_str(), gas_at_particles<hearth::lattice>, 2.0,
                                     together)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("gas at particles on a graded mesh" + how).c_str(), gas_at_particles<graded_mesh>, 2.0,
                                     together)
            ->Unit(benchmark::kMillisecond);
    }
    // What must move each term: three vectors read and one written; offsets, volumes, six neighbours and conductances.
    for (const double width : {0.9, 2.0}) {  // d/dx 1.8 and 4
        const std::string at = width < 1 ? "/d_dx:1.8" : "/d_dx:4";
        benchmark::RegisterBenchmark(("smoother on 6 million cells/lattice" + at).c_str(), smoother<hearth::lattice>,
                                     width, 32.0)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("smoother on 6 million cells/lists" + at).c_str(), smoother<faces_only>, width,
                                     92.0)
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();

}  // namespace
