// SPDX-License-Identifier: MIT
#include "cold_bed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <hearth/closure/eisfeld_schnitzlein.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/gas/generate.hpp>
#include <hearth/gas/mesh_traits.hpp>
#include <hearth/gas/solver.hpp>
#include <hearth/voidage/filtered_fraction.hpp>
#include <hearth/voidage/vfs.hpp>

#include "places.hpp"

namespace hearth::furnace::rungs {
namespace {

enum class method { filtered, paper, completed, cut_off };
constexpr std::array<method, 4> methods{method::filtered, method::paper, method::completed, method::cut_off};
const char* name(method m) {
    constexpr const char* names[] = {"filtered", "vfs_paper", "vfs_completed", "cut_off"};
    return names[static_cast<std::size_t>(m)];
}

/// A bed that settled in its tube.
struct settled {
    places spheres;
    double top = 0;            ///< of the bed [m]
    double from, to;           ///< where neither floor nor surface shows [m]
    double void_fraction = 0;  ///< between these

    settled(const cold_bed& s, const watcher& watch) : spheres{{}, 0.5 * s.diameter} {
        const double radius = 0.5 * s.tube_to_particle * s.diameter, height = s.level + s.free;
        dem::bed_settings of;
        of.body.youngs_modulus = 1e7;  // softened: overlaps stay below 0.1 %
        of.contact.damping = dem::damping_of_restitution(0.6);
        of.step = 2e-5 * s.diameter / 0.014;
        dem::bed settling(of);
        settling.add_wall(wall_of(of, dem::shape::plane({0, 0, 0}, {0, 0, 1}), 0, of.contact.friction));
        settling.add_wall(wall_of(of, dem::shape::cylinder({0, 0, -1}, {0, 0, 20}, radius), 1, of.contact.friction));
        dem::feed::settings from_above;
        from_above.where = {{0, 0, 1.15 * s.level}, radius, 4 * s.diameter};
        from_above.density = s.density;
        from_above.mass_flow = 5;
        from_above.seed = s.seed;
        dem::feed source(from_above, dem::size_distribution({{s.diameter, 1}}));
        watch(0, "the bed is poured");
        dem::fill_to_level(settling, source, {{0, 0, 0}, radius, std::max(height, 1.5 * s.level)}, s.level, 400000);
        settle(settling, 50000, [&](double) { watch(0.02, "the bed settles"); });
        std::vector<dem::index> above;  // the surface is levelled
        for (dem::index i = 0; i < settling.size(); ++i) {
            if (settling.spheres()[i].centre.z + 0.5 * s.diameter > s.level) above.push_back(i);
        }
        settling.remove(above);
        settle(settling, 20000, [&](double) { watch(0.04, "the bed settles"); });
        top = dem::surface_level(settling, {{0, 0, 0}, radius, height});
        for (dem::index i = 0; i < settling.size(); ++i) spheres.centre.push_back(settling.spheres()[i].centre);
        from = 2.5 * s.diameter;
        to = top - 2.5 * s.diameter;
        void_fraction = 1 - solid_fraction(settling, {{0, 0, from}, radius, to - from});
    }
};

/// Solid fraction of every cell, and the share of the solid that it lost: what is above 0.99 no gas solver can take.
struct fraction {
    std::vector<double> of_cells;
    double lost = 0;
    double stranded = 0;  ///< solid above the smoother's threshold that found no room [m^3]
    double seconds = 0;   ///< of the processor
};
fraction solid_of(const gas::mesh& mesh, const places& spheres, method how) {
    const double began = cpu_seconds();
    fraction made{std::vector<double>(static_cast<std::size_t>(mesh.cells())), 0, 0, 0};
    if (how == method::filtered) {
        filtered_solid_fraction(mesh, spheres, made.of_cells);
    } else {
        const cell_graph<> graph(mesh);
        const cell_locator<gas::mesh> locator(mesh, graph);
        deposit_solid_fraction(locator, spheres, made.of_cells, deposit::centre{});
        if (how != method::cut_off) {
            const vfs_settings settings{0.9, how == method::paper ? vfs_variant::paper : vfs_variant::completed};
            made.stranded = volume_fraction_smoother(graph, settings).smooth(made.of_cells).stranded_volume;
        }
        for (double& f : made.of_cells) f = std::min(f, how == method::cut_off ? 0.9 : 0.99);
    }
    double held = 0;
    for (int c = 0; c < mesh.cells(); ++c) held += made.of_cells[static_cast<std::size_t>(c)] * mesh.volume[c];
    made.lost = 1 - held / (4.0 / 3 * pi * std::pow(spheres.radius, 3) * static_cast<double>(spheres.centre.size()));
    made.seconds = cpu_seconds() - began;
    return made;
}

/// Cold flow upwards through a bed, from one velocity to the next.
class wind {
  public:
    wind(const cold_bed& s, const gas::mesh& mesh, const std::vector<double>& solid) : scene_(s), solver_(mesh, model(s), settings(s)) {
        solver_.set("wall", gas::wall());
        solver_.set("top", gas::pressure_outlet(s.pressure));
        for (int c = 0; c < mesh.cells(); ++c) {
            solver_.bed.void_fraction[c] = 1 - solid[static_cast<std::size_t>(c)];
            solver_.bed.diameter[c] = s.diameter;
        }
        solver_.initialise(293);
    }
    struct drop {
        double whole = 0;     ///< over bed and free space [Pa]
        double gradient = 0;  ///< within the bed, by least squares [Pa/m]
        bool converged = false;
        int iterations = 0;
    };
    drop blow(double velocity, double from, double to) {
        const gas::mesh& mesh = solver_.grid();
        solver_.set("bottom", gas::mass_flow_inlet(scene_.gas_density * velocity * mesh.area_of(mesh.find_patch("bottom")), {293}));
        const gas::report r = solver_.steady();
        drop found{solver_.mean_pressure("bottom") - scene_.pressure, 0, r.converged, r.iterations};
        double volume = 0, z = 0, p = 0, zz = 0, zp = 0;
        for (int c = 0; c < mesh.cells(); ++c) {
            const double height = mesh.centre[c].z, v = mesh.volume[c], pressure = solver_.gas.flow.pressure[c];
            if (height < from || height > to) continue;
            volume += v, z += v * height, p += v * pressure, zz += v * height * height, zp += v * height * pressure;
        }
        found.gradient = -(zp - z * p / volume) / (zz - z * z / volume);
        return found;
    }

  private:
    static std::shared_ptr<const gas::gas_model> model(const cold_bed& s) {
        auto cold = std::make_shared<gas::simple_gas>();
        cold->constant_density = s.gas_density;
        cold->sutherland = 0;
        cold->viscosity_reference = s.viscosity;
        return cold;
    }
    static gas::solver_settings settings(const cold_bed& s) {
        gas::solver_settings of;
        of.gravity = {0, 0, 0};
        of.energy = of.species = false;
        of.turbulence = true;  // in the free space
        of.tolerance = 1e-3;   // the pressure drop then stands still to a tenth of a per cent
        of.max_iterations = s.iterations;
        return of;
    }
    cold_bed scene_;
    gas::solver solver_;
};

gas::mesh mesh_of(const cold_bed& s, double cells_per_diameter) {
    gas::shaft shape;
    const double radius = 0.5 * s.tube_to_particle * s.diameter, size = s.diameter / cells_per_diameter, height = s.level + s.free;
    shape.profile = {{0, radius}, {height, radius}};
    shape.axial_size = {{0, size}, {height, size}};
    shape.cross_size = size;
    return gas::mesh(gas::renumbered(gas::make(shape)));
}

double cells_of(const cold_bed& s, double k) {
    return pi / 4 * s.tube_to_particle * s.tube_to_particle * (s.level + s.free) / s.diameter * k * k * k;
}

double work(const cold_bed& s) {
    double sum = cells_of(s, s.cells_per_diameter) * static_cast<double>(s.velocities.size() * (s.compare_methods ? methods.size() : 1));
    for (const double k : s.compared_meshes) sum += cells_of(s, k) * (s.compare_methods ? 4 : 1);
    return sum;
}

}  // namespace

void check(const cold_bed& scene) {
    if (scene.level < 8 * scene.diameter) {
        throw bad_scene("bed.height_m is " + format(scene.level) + ", allowed: at least 8 diameters, " + format(8 * scene.diameter));
    }
}

rung_plan foresee(const cold_bed& scene) {
    rung_plan p;
    p.builds = "about " + format(std::round(cells_of(scene, scene.cells_per_diameter) / 100) * 100) + " cells, " +
               std::to_string(scene.velocities.size()) + " velocities, " + (scene.compare_methods ? "four ways" : "one way") +
               " to make the solid fraction";
    double finest = scene.cells_per_diameter;
    for (const double k : scene.compared_meshes) finest = std::max(finest, k);
    p.memory = 30e6 + 1.2e3 * cells_of(scene, finest);
    p.seconds = 3 + work(scene) * 80e-6;
    p.left_out = {{"all heat: temperatures of gas and particles", "kind = \"cold_bed\" is cold", "an equation, two fields"},
                  {"species, combustion", "the gas is air", "seven fields per cell"},
                  {"motion", "the bed has settled before the gas comes", "DEM during the flow"}};
    return p;
}

rung_result run(const cold_bed& s, const watcher& watch) {
    rung_result r;
    const double began = cpu_seconds();
    const settled bed(s, watch);
    const double packing_seconds = cpu_seconds() - began, length = bed.top;
    const auto law = [&](const auto& closure, double velocity) {
        const double e = bed.void_fraction;
        return closure::pressure_gradient(closure, closure::bed_flow<double>{e, velocity / e, s.gas_density, s.viscosity, s.diameter});
    };
    const closure::eisfeld_schnitzlein in_tube(s.tube_to_particle);

    double done = 0;
    const double all = work(s);
    const auto tell = [&](method how, double velocity, double k) {
        watch(0.05 + 0.95 * std::min(1.0, done / all), std::string(name(how)) + ", " + format(velocity) + " m/s, " + format(k) + " cells per diameter");
    };
    curves over_velocity{"pressure_drop.csv", {{"velocity_m_per_s", s.velocities}, {"ergun_Pa", {}}, {"eisfeld_schnitzlein_Pa", {}}}};
    for (const double u : s.velocities) {
        over_velocity.columns[1].second.push_back(law(closure::ergun{}, u) * length);
        over_velocity.columns[2].second.push_back(law(in_tube, u) * length);
    }
    const gas::mesh mesh = mesh_of(s, s.cells_per_diameter);
    int unsettled = 0;
    double worst = 0, worst_drop = 0, worst_ergun = 0;
    for (const method how : methods) {
        if (how != method::filtered && !s.compare_methods) continue;
        const fraction solid = solid_of(mesh, bed.spheres, how);
        wind flow(s, mesh, solid.of_cells);
        std::vector<double> whole, gradient;
        double ratio = 0;
        for (std::size_t k = 0; k < s.velocities.size(); ++k) {
            tell(how, s.velocities[k], s.cells_per_diameter);
            const wind::drop d = flow.blow(s.velocities[k], bed.from, bed.to);
            done += cells_of(s, s.cells_per_diameter);
            unsettled += d.converged ? 0 : 1;
            whole.push_back(d.whole);
            gradient.push_back(d.gradient);
            const double over = d.gradient / law(in_tube, s.velocities[k]);
            ratio += over / static_cast<double>(s.velocities.size());
            if (how != method::filtered) continue;
            worst = std::max(worst, std::abs(over - 1));
            worst_drop = std::max(worst_drop, std::abs(d.whole / over_velocity.columns[2].second[k] - 1));
            worst_ergun = std::max(worst_ergun, std::abs(d.gradient / law(closure::ergun{}, s.velocities[k]) - 1));
        }
        over_velocity.columns.push_back({std::string(name(how)) + "_Pa", whole});
        over_velocity.columns.push_back({std::string(name(how)) + "_gradient_Pa_per_m", gradient});
        const char* words[] = {"pressure gradient over Eisfeld-Schnitzlein", "  by the VFS of the paper", "  by the VFS completed", "  by cutting off at 0.9"};
        r.findings.push_back({std::string(name(how)) + "_over_reference", words[static_cast<std::size_t>(how)], "1 (scatter 0.11 to 0.16)", ratio, "-"});
        if (solid.stranded > 0) {
            r.findings.push_back({std::string(name(how)) + "_stranded_volume_m3", "    solid that finds no room", "0", solid.stranded, "m3"});
        }
        if (std::abs(solid.lost) > 1e-9) {
            r.findings.push_back({std::string(name(how)) + "_lost_solid_percent", "    solid that it loses", "0", 100 * solid.lost, "%"});
        }
    }
    r.tables.push_back(over_velocity);

    // Error against run time over cells and ways to make the fraction.
    const double middle = s.velocities[s.velocities.size() / 2];
    curves over_mesh{"over_mesh.csv", {{"cells_per_diameter", {}}}};
    for (const method how : methods) {
        if (how != method::filtered && !s.compare_methods) continue;
        for (const char* what : {"_over_reference", "_time_s", "_fraction_time_s"}) over_mesh.columns.push_back({name(how) + std::string(what), {}});
    }
    for (const double k : s.compared_meshes) {
        over_mesh.columns[0].second.push_back(k);
        const gas::mesh other = mesh_of(s, k);
        std::size_t column = 1;
        for (const method how : methods) {
            if (how != method::filtered && !s.compare_methods) continue;
            tell(how, middle, k);
            const double start = cpu_seconds();
            const fraction solid = solid_of(other, bed.spheres, how);
            const wind::drop d = wind(s, other, solid.of_cells).blow(middle, bed.from, bed.to);
            done += cells_of(s, k);
            unsettled += d.converged ? 0 : 1;
            over_mesh.columns[column++].second.push_back(d.gradient / law(in_tube, middle));
            over_mesh.columns[column++].second.push_back(cpu_seconds() - start);
            over_mesh.columns[column++].second.push_back(solid.seconds);
        }
    }
    r.tables.push_back(over_mesh);
    r.findings.push_back({"drop_departure_percent", "pressure drop off Eisfeld-Schnitzlein, filtered, largest", "0", 100 * worst_drop, "%"});
    r.findings.push_back({"gradient_departure_percent", "  gradient within the bed", "0", 100 * worst, "%"});
    r.findings.push_back({"ergun_departure_percent", "  gradient off Ergun, whose drag it is", "0", 100 * worst_ergun, "%"});
    r.findings.push_back({"pressure_drop_Pa", "pressure drop at " + format(s.velocities.back()) + " m/s, filtered fraction", "",
                          over_velocity.columns[3].second.back(), "Pa"});
    r.findings.push_back({"eisfeld_schnitzlein_Pa", "  Eisfeld and Schnitzlein", "", over_velocity.columns[2].second.back(), "Pa"});
    r.findings.push_back({"ergun_Pa", "  Ergun", "", over_velocity.columns[1].second.back(), "Pa"});
    r.findings.push_back({"void_fraction", "void fraction inside of the bed", "", bed.void_fraction, "-"});
    r.findings.push_back({"bed_height_m", "height of the bed, mean of its surface", format(s.level) + " (paper)", bed.top, "m"});
    r.findings.push_back({"spheres", "spheres", "", static_cast<double>(bed.spheres.centre.size()), "-", "%.0f"});
    r.findings.push_back({"packing_time_s", "processor time of the packing", "", packing_seconds, "s"});
    if (unsettled > 0) {
        r.warnings.push_back(std::to_string(unsettled) + " flows did not come to rest in " + std::to_string(s.iterations) +
                             " iterations (mesh.iterations)");
    }
    watch(1, "done");
    return r;
}

}  // namespace hearth::furnace::rungs
