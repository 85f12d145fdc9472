// SPDX-License-Identifier: MIT
#include <hearth/gas/solver.hpp>

#include <algorithm>
#include <cmath>

namespace hearth::gas {

namespace {

void require(bool good, const std::string& what) {
    if (!good) throw std::invalid_argument("hearth::gas: " + what);
}

}  // namespace

const parallel& solver::single_rank() {
    static const parallel one;
    return one;
}

solver::solver(const mesh& m, std::shared_ptr<const gas_model> model, solver_settings s, const parallel& ranks)
    : settings(std::move(s)),
      mesh_(&m),
      model_(std::move(model)),
      ranks_(&ranks),
      species_(model_->species_count()),
      pattern_(m),
      gradients_(m),
      work_(pattern_),
      flow_(m, pattern_, gradients_, ranks, work_),
      scalars_(m, pattern_, gradients_, ranks, work_),
      turbulence_(m, ranks, settings.turbulence_constants) {
    const int n = m.cells(), b = m.boundary_faces();
    require(species_ >= 1, "the gas model must have a species");
    require(settings.reference_pressure > 0, "reference_pressure must be > 0 [Pa]");
    require(settings.flow.relaxation > 0 && settings.flow.relaxation <= 1, "flow.relaxation must lie in (0, 1]");
    require(settings.energy_relaxation > 0 && settings.energy_relaxation <= 1, "energy_relaxation must lie in (0, 1]");
    bed.void_fraction.assign(n, 1.0);
    bed.diameter.assign(n, 0.01);
    bed.heat_conductance.assign(n, 0.0);
    bed.heat_source.assign(n, 0.0);
    sources.species.assign(n * species_, 0.0);
    sources.enthalpy.assign(n, 0.0);
    boundary_.type.assign(b, flow_boundary::kind::wall);
    for (auto* field : {&boundary_.mass_flux, &boundary_.pressure, &boundary_.wall_viscosity,
                        &scalar_boundary_.enthalpy, &scalar_boundary_.fixed, &scalar_boundary_.kinetic,
                        &scalar_boundary_.dissipation, &boundary_diffusion_, &face_conductance_, &face_source_})
        field->assign(b, 0.0);
    scalar_boundary_.temperature.assign(b, 300.0);
    boundary_.velocity.assign(b, {});
    boundary_fraction_.assign(species_, array<double>(b, 0.0));
    free_.assign(n, 1);
    medium_.exchange.assign(n, 0.0);
    medium_.mass_source.assign(n, 0.0);
}

void solver::set(const std::string& name, const patch_condition& c) {
    using kind = patch_condition::kind;
    const mesh& m = *mesh_;
    const patch& p = m.find_patch(name);
    const array<double>& y = c.gas.mass_fraction;
    if (c.type == kind::inlet || c.type == kind::outlet) {
        double sum = 0;
        for (const double v : y) sum += v;
        require(static_cast<int>(y.size()) == species_, "patch '" + name + "': " + std::to_string(y.size()) +
                                                           " mass fractions for " + std::to_string(species_) + " species");
        require(std::abs(sum - 1) < 1e-9, "patch '" + name + "': mass fractions add up to " + std::to_string(sum));
        require(c.gas.temperature > 0, "patch '" + name + "': temperature must be > 0 [K]");
    }
    const double area = ranks_->sum(m.area_of(p)), c34 = std::pow(settings.turbulence_constants.c_mu, 0.75);
    for (int f = p.first; f < p.first + p.count; ++f) {
        const int b = f - m.internal_faces();
        const vector3& x = m.face_centre[f];
        const double size = norm(m.area[f]);
        boundary_.velocity[b] = c.velocity;
        boundary_.mass_flux[b] = scalar_boundary_.fixed[b] = face_conductance_[b] = face_source_[b] = 0;
        if (c.type == kind::slip) {
            boundary_.type[b] = flow_boundary::kind::slip;
        } else if (c.type == kind::wall) {
            boundary_.type[b] = flow_boundary::kind::wall;
            if (c.heat) {
                const wall_heat heat = c.heat(x);
                face_conductance_[b] = heat.transmittance * size;
                face_source_[b] = heat.transmittance * size * heat.ambient;
            }
        } else {
            const double t = c.temperature ? c.temperature(x) : c.gas.temperature;
            scalar_boundary_.temperature[b] = t;
            scalar_boundary_.enthalpy[b] = model_->enthalpy(t, y.data());
            for (int k = 0; k < species_; ++k) boundary_fraction_[k][b] = y[k];
            const double density = model_->density(settings.reference_pressure, t, y.data());
            double speed = 1;
            if (c.type == kind::outlet) {
                boundary_.type[b] = flow_boundary::kind::outlet;
                boundary_.pressure[b] = (c.pressure_profile ? c.pressure_profile(x) : c.pressure) -
                                        settings.reference_pressure;
            } else {
                boundary_.type[b] = flow_boundary::kind::inlet;
                const vector3 w = c.profile ? c.profile(x) : -c.mass_flow / (area * size * density) * m.area[f];
                boundary_.velocity[b] = w;
                boundary_.mass_flux[b] = density * dot(w, m.area[f]);
                speed = norm(w);
            }
            const double fluctuation = c.gas.turbulence_intensity * speed;
            scalar_boundary_.kinetic[b] = 1.5 * fluctuation * fluctuation + 1e-10;
            scalar_boundary_.dissipation[b] = c34 * std::pow(scalar_boundary_.kinetic[b], 1.5) / c.gas.turbulence_length;
        }
        if (c.temperature && c.type != kind::outlet) {  // conducts to the given temperature as well
            scalar_boundary_.temperature[b] = c.temperature(x);
            scalar_boundary_.enthalpy[b] = model_->enthalpy(c.temperature(x), y.data());
            scalar_boundary_.fixed[b] = 1;
        }
    }
}

void solver::add(const nozzle& n) {
    require(n.cell >= 0 && n.cell < mesh_->owned_cells(), "nozzle: no cell " + std::to_string(n.cell));
    require(n.mass_flow >= 0, "nozzle: mass flow must be >= 0 [kg/s]");
    require(static_cast<int>(n.gas.mass_fraction.size()) == species_, "nozzle: wrong number of mass fractions");
    for (int k = 0; k < species_; ++k)
        sources.species[species_ * n.cell + k] += n.mass_flow * n.gas.mass_fraction[k];
    sources.enthalpy[n.cell] += n.mass_flow * model_->enthalpy(n.gas.temperature, n.gas.mass_fraction.data());
    if (sources.force.empty()) sources.force.assign(mesh_->cells(), {});
    sources.force[n.cell] += n.mass_flow * n.velocity;
}

void solver::initialise(double temperature, const array<double>& y) {
    require(static_cast<int>(y.size()) == species_, "initialise: wrong number of mass fractions");
    require(temperature > 0, "initialise: temperature must be > 0 [K]");
    const int n = mesh_->cells();
    gas.flow = flow_.make_state();
    gas.temperature.assign(n, temperature);
    gas.enthalpy.assign(n, model_->enthalpy(temperature, y.data()));
    gas.mass_fraction.clear();
    for (int c = 0; c < n; ++c) gas.mass_fraction.insert(gas.mass_fraction.end(), y.begin(), y.end());
    for (auto* field : {&gas.density, &gas.viscosity, &gas.conductivity, &gas.specific_heat, &gas.eddy_viscosity})
        field->assign(n, 0.0);
    gas.kinetic.assign(n, 1e-4);
    gas.dissipation.assign(n, 1e-2);
    old_void_.clear();
    update_properties();
}

void solver::check_bed() const {
    const int n = mesh_->owned_cells();
    const auto size_or_none = [n](const auto& field) { return field.empty() ? n : field.count(); };
    for (const int size : {bed.void_fraction.count(), bed.diameter.count(), bed.heat_conductance.count(),
                           bed.heat_source.count(), sources.enthalpy.count(), sources.species.count() / species_,
                           size_or_none(bed.particle_velocity), size_or_none(sources.force), size_or_none(bed.exchange)})
        require(size >= n, "a field of the bed or of the sources holds " + std::to_string(size) + " cells, expected " +
                               std::to_string(n));
    // Looked at in every iteration: only what is wrong is put into words.
    const auto refuse = [](const char* what, int c, const std::string& values, const char* allowed) {
        require(false, what + (" of cell " + std::to_string(c)) + " is " + values + ", allowed: " + allowed);
    };
    require(sources.conversion.count() == sources.converted.count() &&
                (sources.conversion.empty() || sources.conversion.count() >= n * species_),
            "sources.conversion and sources.converted hold " + std::to_string(sources.conversion.count()) + " and " +
                std::to_string(sources.converted.count()) + " numbers, expected none or " + std::to_string(n * species_));
    for (int c = 0; c < n; ++c) {
        const double e = bed.void_fraction[c], d = bed.diameter[c], conductance = bed.heat_conductance[c], source = bed.heat_source[c];
        if (!(e > 0 && e <= 1)) refuse("void fraction", c, std::to_string(e), "(0, 1]");
        if (!(d > 0)) refuse("particle diameter", c, std::to_string(d), "> 0 [m]");
        if (!(conductance >= 0 && std::isfinite(source)))
            refuse("heat exchange", c, std::to_string(conductance) + ", " + std::to_string(source), ">= 0 [W/K], finite [W]");
    }
}

/// Checks the bed and brings its ghosts up to date.  Throws on every rank where one rank's bed is wrong.
void solver::take_bed() {
    std::string wrong;
    try {
        check_bed();
    } catch (const std::invalid_argument& error) {
        wrong = error.what();
    }
    if (ranks_->max(wrong.empty() ? 0 : 1) > 0)
        throw std::invalid_argument(wrong.empty() ? "hearth::gas: another rank's bed is not allowed" : wrong);
    bed.void_fraction.resize(mesh_->cells());
    bed.diameter.resize(mesh_->cells());
    ranks_->gather(bed.void_fraction.data(), 1);
    ranks_->gather(bed.diameter.data(), 1);
    // on one rank with particles that move, on another without: both gather
    if (ranks_->max(bed.particle_velocity.empty() ? 0 : 1) > 0) {
        bed.particle_velocity.resize(mesh_->cells());
        ranks_->gather(&bed.particle_velocity[0].x, 3);
    }
}

double solver::mass_flow(const std::string& name) const {
    const patch& p = mesh_->find_patch(name);
    double sum = 0;
    for (int f = p.first; f < p.first + p.count; ++f) sum += gas.flow.mass_flux[f];
    return ranks_->sum(sum);
}

double solver::mean_temperature(const std::string& name) const {
    const patch& p = mesh_->find_patch(name);
    double sums[2] = {0, 0};
    for (int f = p.first; f < p.first + p.count; ++f) {
        const double out = std::max(0.0, gas.flow.mass_flux[f]);
        sums[0] += out * gas.temperature[mesh_->owner[f]];
        sums[1] += out;
    }
    ranks_->sum(sums, 2);
    return sums[0] / sums[1];
}

double solver::mean_pressure(const std::string& name) const {
    const patch& p = mesh_->find_patch(name);
    double sums[2] = {0, 0};
    for (int f = p.first; f < p.first + p.count; ++f) {
        const int c = mesh_->owner[f];
        const double size = norm(mesh_->area[f]);
        sums[0] += size * (absolute_pressure(c) + dot(gas.flow.pressure_gradient[c], mesh_->face_centre[f] - mesh_->centre[c]));
        sums[1] += size;
    }
    ranks_->sum(sums, 2);
    return sums[0] / sums[1];
}

}  // namespace hearth::gas
