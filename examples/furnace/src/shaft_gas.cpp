// SPDX-License-Identifier: MIT
#include "shaft_gas.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <hearth/gas/partition.hpp>

namespace hearth::furnace {

namespace {
constexpr double pi = 3.14159265358979323846;
}

namespace {
/// The paper's smoother has no kernel, and spreads heat as it spreads volume.
bool filtered(const settings& scene) { return scene.voidage.method == voidage_method::filtered; }
}  // namespace

gas::shaft shape_of(const settings& scene) {
    gas::shaft shape;
    const double radius = 0.5 * scene.shaft.diameter, height = scene.shaft.height, top = height + scene.shaft.hopper_height;
    shape.profile = {{0, radius}, {top, radius}};
    shape.axial_size = {{0, scene.mesh.axial_size_bottom},
                        {0.4 * std::min(2.0, height), scene.mesh.axial_size_bottom},
                        {0.6 * std::min(2.0, height), scene.mesh.axial_size}};
    const double burners = scene.burners.height;
    if (scene.burners.count > 0 && burners - 0.5 > shape.axial_size.back().z && burners + 0.5 < height) {
        shape.axial_size.push_back({burners - 0.5, scene.mesh.axial_size});
        shape.axial_size.push_back({burners - 0.15, scene.mesh.axial_size_burners});
        shape.axial_size.push_back({burners + 0.15, scene.mesh.axial_size_burners});
        shape.axial_size.push_back({burners + 0.5, scene.mesh.axial_size});
    }
    shape.axial_size.push_back({top, scene.mesh.axial_size});
    shape.cross_size = scene.shaft.diameter / scene.mesh.across;
    // Between the bed's surface and the hopper there is free space; the off-gas leaves it by a pipe in the side.
    shape.outlet = scene.shaft.hopper_height > 0;
    if (shape.outlet) {
        shape.profile.insert(shape.profile.begin() + 1, {height, radius});  // a level of the mesh at the surface
        shape.pipe = {std::min(scene.shaft.offgas_pipe_diameter, 0.9 * scene.shaft.hopper_height), height + 0.5 * scene.shaft.hopper_height};
    }
    return shape;
}

double at_height(const std::vector<double>& values, double z, double shaft_height) {
    const auto cells = static_cast<double>(values.size());
    const double k = std::clamp(z / shaft_height * cells - 0.5, 0.0, cells - 1);
    const auto low = static_cast<std::size_t>(k);
    const auto high = std::min(low + 1, values.size() - 1);
    return values[low] + (k - static_cast<double>(low)) * (values[high] - values[low]);
}

namespace {

gas::solver_settings solver_settings_of(const settings& scene) {
    gas::solver_settings s;
    s.reference_pressure = scene.gas.pressure;
    // Gas in the bed has lost its momentum after a diameter, and the free space above only collects what leaves it: there
    // gas feels a thousandth of what it feels in the bed.  With its inertia it grows unstable where parcels stick out.
    s.turbulence = false;
    s.flow.inertia = false;
    s.flow.resistance_floor = 5;
    s.energy_relaxation = 1;  // the bed holds temperatures
    s.scalars.relative = 1e-6;
    s.flow.pressure.relative = 1e-8;  // what mass misses, enthalpy and species miss as well
    return s;
}

gas::polyhedra made(const gas::shaft& shape) {
    try {
        return gas::make(shape);
    } catch (const std::invalid_argument& error) {
        throw bad_scene(std::string("mesh: ") + error.what());
    }
}

gas::mesh mesh_of(const settings& scene) { return gas::mesh(gas::renumbered(made(shape_of(scene)))); }

std::int64_t cells_of(const gas::polyhedra& shape) { return 1 + *std::max_element(shape.owner.begin(), shape.owner.end()); }

/// Heights of the levels between a shaft's layers of cells, rising [m].
std::set<double> levels_of(const gas::polyhedra& shape) {
    std::set<double> levels;
    for (const gas::vector3& x : shape.points) levels.insert(x.z);
    return levels;
}

gas::mesh share_of(gas::mesh whole, const ranks& among) {
    if (among.size() == 1) return whole;
    if (whole.cells() < among.size()) {
        throw bad_scene("mesh: " + std::to_string(whole.cells()) + " cells are fewer than " + std::to_string(among.size()) + " ranks");
    }
    return gas::mesh(whole, gas::partition(whole, among.size()), among.rank());
}

}  // namespace

std::int64_t cell_count_of(const settings& scene) {
    // All layers are alike.  So the generator makes the section with as few layers as bed and pipe ask for, and then all
    // layers, broken at the same heights, with the coarsest section that it knows.
    gas::shaft section = shape_of(scene), column = section;
    section.axial_size = {{0, section.profile.back().z}};
    const gas::polyhedra flat = made(section);
    const std::set<double> breaks = levels_of(flat);
    column.profile.clear();
    for (const double z : breaks) column.profile.push_back({z, 0.5 * scene.shaft.diameter});
    column.cross_size = scene.shaft.diameter;
    column.outlet = false;
    const auto layers = [](const std::set<double>& levels) { return static_cast<std::int64_t>(levels.size()) - 1; };
    return cells_of(flat) / layers(breaks) * layers(levels_of(made(column)));
}

shaft_gas::shaft_gas(const settings& scene, double parcel_diameter, const ranks& among)
    : scene_(scene),
      mesh_(share_of(mesh_of(scene), among)),
      among_(mesh_, among),
      order_(among.gather_on_first(std::vector<std::int64_t>(mesh_.global.begin(), mesh_.global.begin() + (among.size() > 1 ? mesh_.owned_cells() : 0)))),
      graph_(mesh_, among),
      locator_(mesh_, graph_),
      outlet_(scene.shaft.hopper_height > 0 ? "outlet" : "top"),
      fill(locator_, {filtered(scene) ? scene.voidage.width_in_diameters * parcel_diameter : 0.0, scene.voidage.threshold, 1e-5}),
      transfer(locator_, {filtered(scene) ? scene.voidage.exchange_width_in_diameters * parcel_diameter : 0.0,
                          filtered(scene) ? 1.0 : scene.voidage.threshold, 1e-5}),
      model(make_mixture(scene)),
      solver(mesh_, model, solver_settings_of(scene), among_) {
    const double normal_density = 101325 / (combustion::gas_constant * 273.15 * combustion::sum(air()));
    air_flow_ = scene.air.volume_flow * normal_density;
    if (scene.physics.combustion == burning::jones_lindstedt) chemistry_.emplace(scene);
    const gas::array<double> air_alone = model->carried(0, scene.air.temperature, false);
    solver.set("bottom", gas::mass_flow_inlet(air_flow_, {scene.air.temperature, air_alone}));
    solver.set(outlet_, gas::pressure_outlet(scene.gas.pressure, {scene.air.temperature, air_alone}));
    set_burners(scene.burners.count > 0 ? scene.burners.mass_flow : 0.0);
}

gas::mesh shaft_gas::whole_grid() const { return mesh_of(scene_); }

void shaft_gas::set_burners(double mass_flow) {
    if (!(mass_flow >= 0) || !std::isfinite(mass_flow)) {
        throw bad_scene("burners: the mass flow is " + std::to_string(mass_flow) + ", allowed: finite and >= 0 [kg/s]");
    }
    const auto cells = static_cast<std::size_t>(mesh_.cells());
    const gas::array<double> fresh = model->carried(1, scene_.burners.temperature, false);
    solver.sources.species.assign(static_cast<int>(fresh.size() * cells), 0.0);
    solver.sources.enthalpy.assign(cells, 0.0);
    solver.sources.force.assign(cells, {});
    burner_flow_ = mass_flow;
    if (!(mass_flow > 0)) return;
    const double enthalpy = model->cold_enthalpy(1, scene_.burners.temperature);
    const auto feed = [&](std::size_t c, double flow) {
        for (std::size_t k = 0; k < fresh.size(); ++k) solver.sources.species[fresh.size() * c + k] += flow * fresh[k];
        solver.sources.enthalpy[c] += flow * enthalpy;
    };
    if (scene_.burners.feed == burner_feed::section) {
        // As the one-dimensional model: over the whole section and 0.1 m of height; a cell gets its share of these.
        std::vector<double> share(cells), low(cells, 1e300), high(cells, -1e300);  // cells end at level faces
        for (int f = 0; f < mesh_.faces(); ++f) {
            const double z = mesh_.face_centre[f].z;
            for (const int c : {mesh_.owner[f], f < mesh_.internal_faces() ? mesh_.neighbour[f] : mesh_.owner[f]}) {
                const auto k = static_cast<std::size_t>(c);
                low[k] = std::min(low[k], z);
                high[k] = std::max(high[k], z);
            }
        }
        double all = 0;
        const auto own = static_cast<std::size_t>(mesh_.owned_cells());
        for (std::size_t c = 0; c < own; ++c) {
            const double within = std::min(high[c], scene_.burners.height + 0.05) - std::max(low[c], scene_.burners.height - 0.05);
            share[c] = std::max(0.0, within / (high[c] - low[c])) * mesh_.volume[c];
            all += share[c];
        }
        all = among_.sum(all);
        for (std::size_t c = 0; c < own; ++c) feed(c, mass_flow * share[c] / all);
        return;
    }
    // Flush with the wall, a jet of the burner's true momentum into the cell before its mouth.
    const double each = mass_flow / scene_.burners.count, radius = 0.5 * scene_.shaft.diameter;
    const double mouth = pi / 4 * scene_.burners.diameter * scene_.burners.diameter;
    const double density = scene_.gas.pressure /
                           (combustion::gas_constant * scene_.burners.temperature * combustion::sum(premix(fuel_ratio(scene_))));
    for (int b = 0; b < scene_.burners.count; ++b) {
        const double angle = 2 * pi * (b + 0.5) / scene_.burners.count;
        const gas::vector3 outwards{std::cos(angle), std::sin(angle), 0};
        gas::vector3 at = (radius - 0.25 * scene_.shaft.diameter / scene_.mesh.across) * outwards;
        at.z = scene_.burners.height;
        const int c = mesh_.find_cell(at);
        const double first = among_.max(c < 0 ? 0 : among_.ranks() - among_.rank());  // of ranks that meet there one has it
        if (first == 0) throw bad_scene("mesh: no cell lies at a burner's mouth");
        if (first != among_.ranks() - among_.rank()) continue;
        feed(static_cast<std::size_t>(c), each);
        solver.sources.force[c] += (-each * each / (density * mouth)) * outwards;
    }
}

double shaft_gas::excess_air_ratio() const {
    const combustion::per_species fed = premix(fuel_ratio(scene_));
    const double fuel = burner_flow_ * fed[combustion::CH4];
    const double oxygen = burner_flow_ * fed[combustion::O2] + air_flow_ * air()[combustion::O2];
    return fuel > 0 ? oxygen / (2 * fuel) : 0;
}

void shaft_gas::start(const shaft_profile& profile) {
    const bool cold = scene_.time.start == start_from::cold;
    solver.initialise(scene_.air.temperature, model->carried(0, scene_.air.temperature, false));
    const double burnt_share = burner_flow_ / std::max(burner_flow_ + air_flow_, 1e-300);
    for (int c = 0; c < mesh_.cells(); ++c) {
        const double z = mesh_.centre[c].z;
        const bool ignited = burner_flow_ > 0 && std::abs(z - scene_.burners.height) < 0.3;
        const double t = cold ? (ignited ? scene_.gas.ignition_temperature : scene_.air.temperature)
                              : at_height(profile.gas_temperature, z, scene_.shaft.height);
        const double share = z > scene_.burners.height ? burnt_share : 0.0;
        const gas::array<double> y = model->carried(share, t, !cold || ignited);
        std::copy(y.begin(), y.end(), solver.gas.mass_fraction.begin() + static_cast<std::ptrdiff_t>(y.size()) * c);
        solver.gas.temperature[c] = t;
        solver.gas.enthalpy[c] = model->enthalpy(t, carried(c));
    }
    solver.update_properties();
    solver.level_zero();
}

void shaft_gas::react() {
    if (chemistry_) chemistry_->update(solver, static_cast<const reacting_mixture&>(*model));
}

double shaft_gas::outlet_mean(const std::vector<double>& of_cells) const {
    const gas::patch& p = mesh_.find_patch(outlet_);
    double sums[2] = {0, 0};
    for (int f = p.first; f < p.first + p.count; ++f) {
        const double out = std::max(0.0, solver.gas.flow.mass_flux[f]);
        sums[0] += out * of_cells[static_cast<std::size_t>(mesh_.owner[f])];
        sums[1] += out;
    }
    among_.sum(sums, 2);
    return sums[1] > 0 ? sums[0] / sums[1] : 0;
}

}  // namespace hearth::furnace
