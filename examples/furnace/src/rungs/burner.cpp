// SPDX-License-Identifier: MIT
#include "burner.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <hearth/closure/gunn.hpp>
#include <hearth/gas/generate.hpp>
#include <hearth/gas/mesh_traits.hpp>
#include <hearth/gas/solver.hpp>
#include <hearth/voidage/filtered_fraction.hpp>

#include "../mixture.hpp"
#include "../reaction.hpp"
#include "places.hpp"

namespace hearth::furnace::rungs {
namespace {

using combustion::per_species;

/// Spheres that settled between upright planes, levelled at the slab's height.
places pack(const burner& s, const watcher& watch) {
    dem::bed_settings of;
    of.body.youngs_modulus = 1e7;
    of.contact.damping = dem::damping_of_restitution(0.5);
    of.step = 4e-5 * s.diameter / 0.018;
    dem::bed b(of);
    const auto side = [&](const dem::vector3& point, const dem::vector3& normal) {
        b.add_wall(wall_of(of, dem::shape::plane(point, normal), 0, of.contact.friction));
    };
    side({0, 0, 0}, {0, 0, 1});
    side({0, 0, 0}, {1, 0, 0});
    side({s.depth, 0, 0}, {-1, 0, 0});
    side({0, 0, 0}, {0, 1, 0});
    side({0, s.width, 0}, {0, -1, 0});
    const double spacing = 1.12 * s.diameter;
    const auto nx = static_cast<int>(s.depth / spacing), ny = static_cast<int>(s.width / spacing);
    const auto nz = static_cast<int>(0.66 * s.height * s.depth * s.width / (nx * ny * pi / 6 * std::pow(s.diameter, 3))) + 1;
    std::vector<dem::particle> all;
    for (int k = 0; k < nx * ny * nz; ++k) {
        const int x = k % nx, y = k / nx % ny, z = k / (nx * ny);
        const auto shifted = [&](int at, int count, double length, int seed) {  // off the lattice by up to 5 % of a diameter
            const double shift = 0.1 * (std::fmod((k + 1) * 0.61803398875 * seed, 1.0) - 0.5) * s.diameter;
            return (at + 0.5) * length / count + shift;
        };
        dem::particle p;
        p.position = {shifted(x, nx, s.depth, 1), shifted(y, ny, s.width, 2), (z + 0.6) * spacing};
        p.radius = 0.5 * s.diameter;
        p.density = s.density;
        all.push_back(p);
    }
    b.insert(all);
    settle(b, 40000, [&](double share) { watch(0.2 * share, "the bed settles"); });
    places found{{}, 0.5 * s.diameter};
    for (dem::index i = 0; i < b.size(); ++i) {
        if (b.spheres()[i].centre.z + 0.5 * s.diameter < s.height) found.centre.push_back(b.spheres()[i].centre);
    }
    return found;
}

/// The gas in the slab, with two layers of free cells above the bed.
struct slab {
    burner scene;
    std::shared_ptr<const reacting_mixture> mixture;
    gas::mesh mesh;
    gas::solver solver;
    reaction burning;
    double fuel_in = 0, carbon_in = 0;  ///< [mol/s]

    slab(const burner& s, const places& spheres)
        : scene(s),
          mixture(std::make_shared<reacting_mixture>(air(), premix(s.equivalence_ratio))),
          mesh(gas::box(gas::graded(s.depth, count(s.depth)), gas::graded(s.width, count(s.width)),
                        gas::graded(s.height + 2 * s.cell, count(s.height) + 2))),
          solver(mesh, mixture, settings_of(s)),
          burning(chemistry_of(s)) {
        for (const char* side : {"x_min", "x_max", "y_min", "y_max"}) solver.set(side, gas::slip());
        solver.set("z_max", gas::pressure_outlet(s.pressure, {s.burner_temperature, mixture->carried(0, s.burner_temperature, false)}));
        std::vector<double> solid(static_cast<std::size_t>(mesh.cells()));
        filtered_solid_fraction(mesh, spheres, solid);
        for (int c = 0; c < mesh.cells(); ++c) {
            solver.bed.void_fraction[c] = 1 - solid[static_cast<std::size_t>(c)];
            solver.bed.diameter[c] = s.diameter;
        }
        const per_species fresh = premix(s.equivalence_ratio);
        fuel_in = s.burner_flow * fresh[combustion::CH4];
        carbon_in = fuel_in;
        const double density = s.pressure / (combustion::gas_constant * s.burner_temperature * combustion::sum(fresh));
        const double speed = s.burner_flow / (density * pi / 4 * s.burner_diameter * s.burner_diameter);
        const int at = mesh.find_cell({0.4 * s.cell, 0.5 * s.width, s.burner_height});
        if (at < 0) throw bad_scene("burner.height_m is " + format(s.burner_height) + ", where no cell lies");
        solver.add({at, s.burner_flow, {speed, 0, 0}, {s.burner_temperature, mixture->carried(1, s.burner_temperature, false)}});
    }
    int count(double length) const { return std::max(2, static_cast<int>(std::lround(length / scene.cell))); }
    static gas::solver_settings settings_of(const burner& s) {
        gas::solver_settings of;
        of.reference_pressure = s.pressure;
        of.turbulence = false;  // free cells only collect what leaves the bed
        of.energy_relaxation = 1;
        of.scalars.relative = of.flow.pressure.relative = 1e-6;
        return of;
    }
    static settings chemistry_of(const burner& s) {
        settings of;  // what reaction reads of a furnace: nothing is lit, the hot bed does it
        of.burners.height = s.burner_height;
        of.time.start = start_from::one_dimensional;
        return of;
    }

    /// The steady gas at a temperature of the bed, from unburnt air; returns whether it came to rest.
    bool settle_at(double bed_temperature, const std::function<void(int)>& tell) {
        solver.set("z_min", gas::mass_flow_inlet(scene.air_flux * scene.depth * scene.width, {bed_temperature, mixture->carried(0, bed_temperature, false)}));
        solver.initialise(bed_temperature, mixture->carried(0, bed_temperature, false));
        solver.bed.heat_conductance.assign(mesh.cells(), 0.0);
        solver.bed.heat_source.assign(mesh.cells(), 0.0);
        for (int k = 0; k < scene.iterations; ++k) {
            for (int c = 0; c < mesh.cells(); ++c) {
                const double e = solver.bed.void_fraction[c], solid = 1 - e;
                if (solid < 1e-3) continue;
                const double flux = solver.gas.density[c] * norm(solver.gas.flow.velocity[c]), viscosity = solver.gas.viscosity[c];
                const double conductivity = solver.gas.conductivity[c];
                const double prandtl = viscosity * solver.gas.specific_heat[c] / conductivity;
                const double nusselt = closure::gunn::nusselt(std::max(e, 0.35), flux * scene.diameter / viscosity, prandtl);
                const double exchange = nusselt * conductivity / scene.diameter * 6 * solid / scene.diameter * mesh.volume[c];
                solver.bed.heat_conductance[c] = exchange;
                solver.bed.heat_source[c] = exchange * bed_temperature;
            }
            burning.update(solver, *mixture);
            const gas::report r = solver.iterate();
            tell(k);
            if (r.broken) throw std::runtime_error("the gas of the slab broke: " + r.reason);
            if (k > 20 && r.temperature_change < 0.5 && r.species_change < 1e-4 && r.flow.velocity_change < 1e-3) return true;
        }
        return false;
    }

    struct outcome {
        double fuel_left = 0, burn_out = 0;     ///< of the methane; of the heat of combustion [-]
        double carbon_monoxide = 0;             ///< mole fraction at the top [-]
        double hottest = 0;                     ///< of the gas [K]
        double carbon_error = 0, hydrogen_error = 0, oxygen_error = 0;  ///< out over in, less 1 [-]
    };
    outcome look(double bed_temperature) const {
        using namespace combustion;
        outcome o;
        per_species out{};
        const gas::patch& top = mesh.find_patch("z_max");
        for (int f = top.first; f < top.first + top.count; ++f) {
            const int c = mesh.owner[f];
            const per_species n = mixture->composition(solver.gas.temperature[c], &solver.gas.mass_fraction[reacting_mixture::carried_count * c]);
            for (std::size_t k = 0; k < species_count; ++k) out[k] += solver.gas.flow.mass_flux[f] * n[k];
        }
        const per_species fresh = premix(scene.equivalence_ratio), below = air();
        per_species in{};
        for (std::size_t k = 0; k < species_count; ++k) {
            in[k] = scene.burner_flow * fresh[k] + scene.air_flux * scene.depth * scene.width * below[k];
        }
        const per_element elements_in = element_amounts(in), elements_out = element_amounts(out);
        const auto error = [&](std::size_t e) { return elements_out[e] / elements_in[e] - 1; };
        o.carbon_error = error(carbon);
        o.hydrogen_error = error(hydrogen);
        o.oxygen_error = error(oxygen);
        o.fuel_left = out[CH4] / in[CH4];
        // Heats of combustion at 298 K [kJ/mol]: CH4 802.3, CO 283.0, H2 241.8 (water as vapour).
        o.burn_out = 1 - (802.3 * out[CH4] + 283.0 * out[CO] + 241.8 * out[H2]) / (802.3 * in[CH4]);
        o.carbon_monoxide = out[CO] / sum(out);
        o.hottest = bed_temperature;
        for (int c = 0; c < mesh.cells(); ++c) o.hottest = std::max(o.hottest, solver.gas.temperature[c]);
        return o;
    }
};

double cells_of(const burner& s) { return s.depth * s.width * (s.height + 2 * s.cell) / std::pow(s.cell, 3); }

}  // namespace

void check(const burner& scene) {
    if (scene.burner_height > scene.height) {
        throw bad_scene("burner.height_m is " + format(scene.burner_height) + ", allowed: below the slab's top, " + format(scene.height));
    }
}

rung_plan foresee(const burner& scene) {
    rung_plan p;
    const double n = 0.6 * scene.depth * scene.width * scene.height / (pi / 6 * std::pow(scene.diameter, 3));
    p.builds = "about " + format(std::round(n / 100) * 100) + " spheres by DEM, " + format(std::round(cells_of(scene) / 100) * 100) +
               " cells with seven species, " + std::to_string(scene.temperatures.size()) + " temperatures of the bed";
    p.memory = 40e6 + 1.5e3 * cells_of(scene);
    p.seconds = 4e-3 * n + 15e-6 * cells_of(scene) * scene.iterations * static_cast<double>(scene.temperatures.size());
    p.left_out = {{"motion", "the bed is frozen", "DEM after settling"},
                  {"energy of the particles, radiation, conduction", "the bed keeps its temperature", "all links between particles"},
                  {"Time Scale Splitting", "nothing stores heat", "time steps"},
                  {"k-epsilon", "in a bed the drag holds all friction", "two equations"}};
    return p;
}

rung_result run(const burner& s, const watcher& watch) {
    rung_result r;
    const places spheres = pack(s, watch);
    slab gas_in(s, spheres);
    curves over_bed{"burn_out.csv", {{"bed_temperature_K", s.temperatures}, {"burn_out", {}}, {"methane_left", {}}, {"carbon_monoxide", {}},
                                     {"hottest_gas_K", {}}, {"time_s", {}}}};
    double elements = 0, limit = 0, done = 0;
    int unsettled = 0;
    slab::outcome last;
    for (const double kelvin : s.temperatures) {
        const double began = cpu_seconds();
        const bool rests = gas_in.settle_at(kelvin, [&](int k) {
            watch(0.2 + 0.8 * (done + static_cast<double>(k) / s.iterations) / static_cast<double>(s.temperatures.size()), "bed at " + format(kelvin) + " K");
        });
        ++done;
        unsettled += rests ? 0 : 1;
        last = gas_in.look(kelvin);
        elements = std::max({elements, std::abs(last.carbon_error), std::abs(last.hydrogen_error), std::abs(last.oxygen_error)});
        if (limit == 0 && last.burn_out > 0.5) limit = kelvin;
        std::size_t column = 1;
        for (const double value : {last.burn_out, last.fuel_left, last.carbon_monoxide, last.hottest, cpu_seconds() - began}) {
            over_bed.columns[column++].second.push_back(value);
        }
    }
    r.tables.push_back(over_bed);
    // The plane of the burner at the last temperature, for the picture.
    curves plane{"plane.csv", {{"x_m", {}}, {"z_m", {}}, {"gas_temperature_K", {}}, {"methane_mass_fraction", {}}, {"void_fraction", {}},
                               {"velocity_x_m_per_s", {}}, {"velocity_z_m_per_s", {}}}};
    for (int c = 0; c < gas_in.mesh.cells(); ++c) {
        const gas::vector3 x = gas_in.mesh.centre[c];
        if (x.y < 0.5 * s.width - 0.6 * s.cell || x.y > 0.5 * s.width + 0.4 * s.cell) continue;
        const double* y = &gas_in.solver.gas.mass_fraction[reacting_mixture::carried_count * c];
        const per_species n = gas_in.mixture->composition(gas_in.solver.gas.temperature[c], y);
        const gas::vector3 u = gas_in.solver.gas.flow.velocity[c];
        std::size_t column = 0;
        for (const double value : {x.x, x.z, gas_in.solver.gas.temperature[c], n[combustion::CH4] * combustion::molar_mass[combustion::CH4],
                                   gas_in.solver.bed.void_fraction[c], u.x, u.z}) {
            plane.columns[column++].second.push_back(value);
        }
    }
    r.tables.push_back(plane);

    r.findings = {
        {"flame_limit_K", "flame limit: coolest bed in which half burns", "", limit, "K"},
        {"burn_out_first", "burn-out of the heat at " + format(s.temperatures.front()) + " K", "", over_bed.columns[1].second.front(), "-"},
        {"burn_out_last", "burn-out of the heat at " + format(s.temperatures.back()) + " K", "1", last.burn_out, "-", "%.6f"},
        {"methane_left", "methane left at " + format(s.temperatures.back()) + " K", "0", last.fuel_left, "-", "%.1e"},
        {"carbon_monoxide_mole_fraction", "carbon monoxide at the top there", "", last.carbon_monoxide, "-", "%.1e"},
        {"hottest_gas_K", "hottest gas there", "", last.hottest, "K"},
        {"element_imbalance", "C, H, O out over in, less 1: largest", "0", elements, "-", "%.1e"},
        {"unfinished_reactions", "cells whose reaction was not finished", "0", static_cast<double>(gas_in.burning.unfinished), "-", "%.0f"},
        {"spheres", "spheres", "", static_cast<double>(spheres.centre.size()), "-", "%.0f"}};
    if (unsettled > 0) {
        r.warnings.push_back("at " + std::to_string(unsettled) + " temperatures the gas did not come to rest in " + std::to_string(s.iterations) +
                             " iterations (mesh.iterations)");
    }
    watch(1, "done");
    return r;
}

}  // namespace hearth::furnace::rungs
