// SPDX-License-Identifier: MIT
// What is read from a furnace: status, fields, profiles.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "parts.hpp"

namespace hearth::furnace {

std::size_t furnace::parts::hottest_stone() const {
    return static_cast<std::size_t>(std::max_element(fields.temperature.begin(), fields.temperature.end()) - fields.temperature.begin());
}

double furnace::parts::pressure_drop() const { return shaft.solver.mean_pressure("bottom") - scene.gas.pressure; }

double furnace::parts::mean_temperature(double z, double from, double to) const {
    const double radius = 0.5 * scene.shaft.diameter, half = std::max(0.15, coarse_graining * sauter_diameter(scene));
    double sum = 0, mass = 0;
    for (std::size_t i = 0; i < fields.temperature.size(); ++i) {
        const dem::vector3& x = bed->spheres()[i].centre;
        const double r = std::hypot(x.x, x.y) / radius;
        if (std::abs(x.z - z) > half || r < from || r > to) continue;
        sum += bed->masses()[i] * fields.temperature[i];
        mass += bed->masses()[i];
    }
    return mass > 0 ? sum / mass : std::numeric_limits<double>::quiet_NaN();
}

/// Of the wall time, that of DEM: measured with the coarse scene of the paper's furnace [-].
constexpr double fill_of_run = 0.3;

status furnace::now() const {
    const parts& p = *parts_;
    status s;
    s.now = p.now;
    s.fuel_power = p.shaft.fuel_power();
    if (p.now == phase::fill) {
        s.share_done = p.fill->share();
        s.share_of_run = fill_of_run * s.share_done;
        s.fill_level = p.fill->level();
        return s;
    }
    s.couplings = p.couplings;
    s.process_time = p.process_time;
    const int planned = p.scene.time.couplings;
    s.share_done = p.now == phase::converge ? static_cast<double>(p.couplings - planned) / planned : static_cast<double>(p.couplings) / planned;
    if (p.now == phase::report) s.share_done = 1;
    const double filled = p.packed_by_dem() ? fill_of_run : 0;
    s.share_of_run = std::min(1.0, filled + (1 - filled) * static_cast<double>(p.couplings) / planned);
    const std::size_t peak = p.hottest_stone();
    s.peak_particle_temperature = p.fields.temperature[peak];
    s.peak_height = p.bed->spheres()[peak].centre.z;
    if (p.now == phase::ignite) return s;
    const auto& t = p.shaft.solver.gas.temperature;
    s.maximum_gas_temperature = p.among.max(*std::max_element(t.begin(), t.end()));
    s.offgas_temperature = p.shaft.solver.mean_temperature(p.shaft.outlet());
    s.solids_outlet_temperature = p.outlet_temperature();
    s.pressure_drop = p.pressure_drop();
    constexpr double pi = 3.14159265358979323846;
    const double shaft = pi / 4 * p.scene.shaft.diameter * p.scene.shaft.diameter * p.scene.shaft.height;
    s.mean_void_fraction = 1 - p.mass_in_shaft() / p.scene.particles.density / shaft;
    if (p.couplings == 0) return s;
    s.wall_heat_loss = p.past.wall.back();
    s.gas_enthalpy_out = p.past.gas_out.back();
    s.particle_enthalpy_gain = p.past.stored.back();
    s.solids_enthalpy_out = p.past.solids_out.back();
    s.enthalpy_imbalance = -(s.gas_enthalpy_out + s.particle_enthalpy_gain + s.solids_enthalpy_out + s.wall_heat_loss);
    s.coupling_share = p.seconds.all > 0 ? (p.seconds.voidage + p.seconds.transfer) / p.seconds.all : 0;
    return s;
}

snapshot furnace::look() const {
    const parts& p = *parts_;
    snapshot s;
    s.process_time = p.process_time;
    const auto show = [&](const dem::vector3& x, double radius) {
        s.particle_position.push_back({x.x, x.y, x.z});
        s.particle_radius.push_back(radius);
    };
    if (p.now == phase::fill) {
        for (const dem::sphere& parcel : p.fill->parcels()) show(parcel.centre, parcel.radius);
        return s;
    }
    for (const dem::sphere& parcel : p.bed->spheres()) {
        dem::vector3 x = parcel.centre;
        if (x.z >= p.end_of_bed()) x.z += p.scene.shaft.hopper_height;
        show(x, parcel.radius);
    }
    s.particle_temperature = p.fields.temperature;
    for (std::size_t i = 0; i < s.particle_radius.size(); ++i) {
        constexpr double pi = 3.14159265358979323846;
        const double area = 4 * pi * s.particle_radius[i] * s.particle_radius[i] * p.coarse_graining;
        s.heat_transfer_coefficient.push_back(p.fields.conductance[i] / area);
    }
    if (p.now == phase::ignite) return s;
    const gas::mesh& m = p.shaft.grid();
    const auto& gas = p.shaft.solver.gas;
    snapshot own;
    for (int c = 0; c < m.owned_cells(); ++c) {
        own.cell_centre.push_back({m.centre[c].x, m.centre[c].y, m.centre[c].z});
        own.cell_volume.push_back(m.volume[c]);
        own.pressure.push_back(p.shaft.solver.absolute_pressure(c));
        const auto& u = gas.flow.velocity[c];
        own.superficial_velocity.push_back({u.x, u.y, u.z});
        const auto x = combustion::mole_fractions(p.shaft.composition(c));
        for (std::size_t k = 0; k < combustion::species_count; ++k) own.mole_fraction[combustion::species_names[k]].push_back(x[k]);
    }
    const auto all = [&](auto& field) { return p.shaft.of_all_cells(std::move(field)); };
    s.cell_centre = all(own.cell_centre);
    s.cell_volume = all(own.cell_volume);
    s.void_fraction = p.shaft.of_all_cells<double>(p.shaft.solver.bed.void_fraction);
    s.gas_temperature = p.shaft.of_all_cells<double>(gas.temperature);
    s.pressure = all(own.pressure);
    s.superficial_velocity = all(own.superficial_velocity);
    for (auto& [name, field] : own.mole_fraction) s.mole_fraction[name] = all(field);
    return s;
}

cell_shapes furnace::cells() const {
    const bool one = parts_->among.size() == 1;
    const gas::mesh whole = one ? gas::mesh() : parts_->shaft.whole_grid();
    const gas::mesh& m = one ? parts_->shaft.grid() : whole;
    cell_shapes shapes;
    for (const auto& x : m.shape.points) shapes.points.push_back({x.x, x.y, x.z});
    // Cells stand on a level face and end in another; their points go round the same way in both, above one another.
    shapes.cells.resize(static_cast<std::size_t>(m.cells()));
    std::vector<int> lower(shapes.cells.size(), -1), upper(shapes.cells.size(), -1);
    for (int f = 0; f < m.faces(); ++f) {
        if (std::abs(m.area[f].z) < 0.9 * norm(m.area[f])) continue;
        for (const int c : {m.owner[f], f < m.internal_faces() ? m.neighbour[f] : m.owner[f]}) {
            (m.face_centre[f].z < m.centre[c].z ? lower : upper)[static_cast<std::size_t>(c)] = f;
        }
    }
    for (std::size_t c = 0; c < shapes.cells.size(); ++c) {
        const auto corner = [&](int face, int k) { return m.shape.face_points[m.shape.face_first[face] + k]; };
        const bool turns = (m.area[lower[c]].z > 0);  // right-handed about +z, as VTK's hexahedron asks of its lower side
        for (int k = 0; k < 4; ++k) {
            const int below = corner(lower[c], turns ? k : 3 - k);
            shapes.cells[c][static_cast<std::size_t>(k)] = below;
            const auto& x = m.shape.points[below];
            int nearest = corner(upper[c], 0);
            const auto apart = [&](int point) { return std::hypot(m.shape.points[point].x - x.x, m.shape.points[point].y - x.y); };
            for (int q = 1; q < 4; ++q) {
                if (apart(corner(upper[c], q)) < apart(nearest)) nearest = corner(upper[c], q);
            }
            shapes.cells[c][static_cast<std::size_t>(k + 4)] = nearest;
        }
    }
    return shapes;
}

axial_profile furnace::axial(int slices) const {
    const parts& p = *parts_;
    axial_profile profile;
    if (p.now == phase::fill || p.now == phase::ignite || slices < 1) return profile;
    const auto n = static_cast<std::size_t>(slices);
    const double height = p.scene.shaft.height, dz = height / slices, radius = 0.5 * p.scene.shaft.diameter;
    const auto slice = [&](double z) { return static_cast<std::size_t>(std::clamp(z / dz, 0.0, slices - 1.0)); };
    const auto mean = [&](std::vector<double>& sum, const std::vector<double>& weight) {
        for (std::size_t k = 0; k < n; ++k) sum[k] = weight[k] > 0 ? sum[k] / weight[k] : std::numeric_limits<double>::quiet_NaN();
    };
    for (std::size_t k = 0; k < n; ++k) profile.height.push_back((static_cast<double>(k) + 0.5) * dz);
    for (auto* field : {&profile.particle_temperature, &profile.particle_temperature_centre, &profile.particle_temperature_wall,
                        &profile.gas_temperature, &profile.pressure, &profile.void_fraction, &profile.convection}) {
        field->assign(n, 0.0);
    }
    profile.wall.assign(n, 0.0);
    if (p.scene.physics.radiation) profile.radiation.assign(n, 0.0);
    if (p.scene.physics.conduction) profile.conduction.assign(n, 0.0);
    const std::pair<std::vector<double>*, const std::vector<double>*> mechanisms[] = {{&profile.convection, &p.fields.convected},
                                                                                      {&profile.radiation, &p.fields.radiated},
                                                                                      {&profile.conduction, &p.fields.conducted},
                                                                                      {&profile.wall, &p.fields.from_wall}};
    std::vector<double> all(n), centre(n), wall(n);
    for (std::size_t i = 0; i < p.fields.temperature.size(); ++i) {
        const dem::vector3& x = p.bed->spheres()[i].centre;
        if (x.z >= height) continue;
        const std::size_t k = slice(x.z);
        const double r = std::hypot(x.x, x.y), m = p.bed->masses()[i], t = p.fields.temperature[i];
        const auto add = [&](std::vector<double>& sum, std::vector<double>& weight) {
            sum[k] += m * t;
            weight[k] += m;
        };
        add(profile.particle_temperature, all);
        if (r < radius / 3) add(profile.particle_temperature_centre, centre);
        if (r > 0.85 * radius) add(profile.particle_temperature_wall, wall);
        for (const auto& [heat, of_parcels] : mechanisms) {
            if (!heat->empty()) (*heat)[k] += (*of_parcels)[i] / dz;
        }
    }
    mean(profile.particle_temperature, all);
    mean(profile.particle_temperature_centre, centre);
    mean(profile.particle_temperature_wall, wall);
    std::vector<double> volume(n), flow(n);
    for (int c = 0; c < p.shaft.grid().owned_cells(); ++c) {
        const gas::vector3& x = p.shaft.grid().centre[c];
        if (x.z >= height) continue;
        const std::size_t k = slice(x.z);
        const double v = p.shaft.grid().volume[c], up = std::max(1e-12, p.shaft.solver.gas.density[c] * p.shaft.solver.gas.flow.velocity[c].z) * v;
        profile.void_fraction[k] += v * p.shaft.solver.bed.void_fraction[c];
        profile.pressure[k] += v * p.shaft.solver.absolute_pressure(c);
        profile.gas_temperature[k] += up * p.shaft.solver.gas.temperature[c];
        volume[k] += v;
        flow[k] += up;
    }
    const auto of_all = [&](std::vector<double>& sums) { p.shaft.among().sum(sums.data(), static_cast<int>(sums.size())); };
    for (auto* sums : {&profile.void_fraction, &profile.pressure, &profile.gas_temperature, &volume, &flow}) of_all(*sums);
    mean(profile.void_fraction, volume);
    mean(profile.pressure, volume);
    mean(profile.gas_temperature, flow);
    return profile;
}

}  // namespace hearth::furnace
