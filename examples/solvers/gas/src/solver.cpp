// SPDX-License-Identifier: MIT
#include <hearth/gas/solver.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hearth::gas {

void solver::update_properties() {
    for (int c = 0; c < mesh_->cells(); ++c) {
        const double* y = composition(c);
        gas.temperature[c] = model_->temperature(gas.enthalpy[c], y, gas.temperature[c]);
        gas.viscosity[c] = model_->viscosity(gas.temperature[c], y);
        gas.conductivity[c] = model_->conductivity(gas.temperature[c], y);
        gas.specific_heat[c] = model_->specific_heat(gas.temperature[c], y);
    }
    update_density();
}

/// The iteration may pass through pressures below vacuum; the density stays that of a tenth of the reference.
double solver::density_pressure(int cell) const { return std::max(absolute_pressure(cell), 0.1 * settings.reference_pressure); }

/// Returns the number of cells of all ranks whose pressure was too low.
std::int64_t solver::update_density() {
    double floored = 0;
    for (int c = 0; c < mesh_->cells(); ++c) {
        const double p = density_pressure(c);
        floored += c < mesh_->owned_cells() && absolute_pressure(c) < p;
        gas.density[c] = model_->density(p, gas.temperature[c], composition(c));
        if (c < medium_.compressibility.count()) medium_.compressibility[c] = model_->compressibility(p, gas.density[c]);
    }
    return static_cast<std::int64_t>(ranks_->sum(floored));
}

void solver::update_medium() {
    const mesh& m = *mesh_;
    medium_.density = gas.density;
    medium_.void_fraction = bed.void_fraction;
    medium_.particle_velocity = bed.particle_velocity;
    medium_.momentum_source = sources.force;
    medium_.gravity = settings.gravity;
    array<double>& viscosity = work_.diffusivity;
    medium_.viscosity = viscosity;
    for (int c = 0; c < m.cells(); ++c) {
        const double e = bed.void_fraction[c];
        free_[c] = 1 - e <= settings.bed_threshold;
        viscosity[c] = free_[c] ? gas.viscosity[c] + gas.eddy_viscosity[c] : 0;
        if (c >= m.owned_cells()) continue;
        double mass = 0;
        for (int k = 0; k < species_; ++k) mass += sources.species[species_ * c + k];
        medium_.mass_source[c] = mass;
        if (!bed.exchange.empty()) {
            medium_.exchange[c] = bed.exchange[c];
            continue;
        }
        vector3 slip = 1 / e * gas.flow.velocity[c];
        if (!bed.particle_velocity.empty()) slip -= bed.particle_velocity[c];
        medium_.exchange[c] =
            free_[c] ? 0 : settings.drag({e, norm(slip), gas.density[c], gas.viscosity[c], bed.diameter[c]});
    }
    ranks_->gather(medium_.exchange.data(), 1);
    for (int f = m.internal_faces(); f < m.faces(); ++f) {
        const int b = f - m.internal_faces(), c = m.owner[f];
        if (boundary_.type[b] == flow_boundary::kind::slip || (settings.turbulence &&
            boundary_.type[b] == flow_boundary::kind::wall && free_[c])) continue;  // the wall function's
        boundary_.wall_viscosity[b] = medium_.viscosity[c];
    }
}

void solver::inner_iteration(report& r, const flow_history& history, const gas_fields* before) {
    ++r.iterations;
    update_medium();
    flow_settings fs = settings.flow;
    fs.resistance_floor = std::max(fs.resistance_floor, through_flow_rate());
    if (before) stored_density_ = gas.flow.pressure;
    r.flow = flow_.iterate(gas.flow, medium_, boundary_, history, fs);
    if (before)
        for (int c = 0; c < mesh_->cells(); ++c)
            stored_density_[c] = gas.density[c] + medium_.compressibility[c] * (gas.flow.pressure[c] - stored_density_[c]);
    if (settings.turbulence) {
        const auto turbulence = turbulence_.iterate(gas, bed, free_, scalars_, flow_.velocity_gradient(), boundary_,
                                                    scalar_boundary_.kinetic, scalar_boundary_.dissipation, before,
                                                    history.step);
        r.turbulence_change = turbulence.change;
        r.turbulence_floored = turbulence.floored;
        r.eddy_viscosity_capped = turbulence.capped;
    }
    r.scalar_iterations = 0;
    r.species_change = r.temperature_change = 0;
    if (settings.species && species_ > 1) solve_species(r, before, history.step, history.storage);
    if (settings.energy) solve_enthalpy(r, before, history.step, history.storage);
    r.pressure_floored = update_density();
}

/// Mass that comes in per time and volume [kg/(m^3 s)]: what inertia resists with over one passage.
double solver::through_flow_rate() const {
    double sums[2] = {0, 0};
    for (int b = 0; b < mesh_->boundary_faces(); ++b)
        sums[0] += std::max({0.0, -boundary_.mass_flux[b], -gas.flow.mass_flux[b + mesh_->internal_faces()]});
    for (int c = 0; c < mesh_->owned_cells(); ++c) {
        sums[0] += std::max(medium_.mass_source[c], 0.0);
        sums[1] += mesh_->volume[c];
    }
    ranks_->sum(sums, 2);
    return sums[0] / sums[1];
}

bool solver::is_settled(report& r) const {
    double finite[2] = {std::isfinite(r.flow.velocity_change + r.flow.pressure.last + r.turbulence_change) ? 0.0 : 1.0,
                        std::isfinite(r.temperature_change) ? 0.0 : 1.0};
    ranks_->sum(finite, 2);
    if (finite[0] + finite[1] > 0) {
        r.reason = finite[0] > 0 ? "the flow is not finite any more" : "the enthalpy is not finite any more";
        r.broken = true;
        return true;
    }
    const double t = settings.tolerance;
    r.reason.clear();
    const auto wait = [&r](const char* what, double value) {
        if (!r.reason.empty()) return;
        std::ostringstream text;
        text << what << " still changes by " << value;
        r.reason = text.str();
    };
    if (r.flow.velocity_change > t) wait("the velocity, relatively,", r.flow.velocity_change);
    if (r.flow.pressure_change > t) wait("the pressure, relatively,", r.flow.pressure_change);
    if (r.temperature_change > 1000 * t) wait("the temperature [K]", r.temperature_change);
    if (r.species_change > t) wait("a mass fraction", r.species_change);
    if (settings.turbulence && r.turbulence_change > 10 * t) wait("k, relatively,", r.turbulence_change);
    r.converged = r.reason.empty();
    return r.converged;
}

void solver::confirm(report& r) const {
    if (!r.converged || r.mass.error < 1e-8) return;
    r.converged = false;
    r.reason = "the balance of mass misses " + std::to_string(r.mass.error) + " of the flow: round-off of far larger terms";
}

report solver::level_zero(int iterations) {
    take_bed();
    report r;
    flow_settings fs = settings.flow;
    fs.inertia = false;
    fs.pressure.relative = std::min(fs.pressure.relative, 1e-4);
    for (r.iterations = 0; r.iterations < iterations; ++r.iterations) {
        update_medium();
        // Gas outside the bed needs some resistance: a thousandth of the bed's mean, or that of its inertia.
        double sums[2] = {0, 0};
        for (int c = 0; c < mesh_->owned_cells(); ++c)
            if (!free_[c]) {
                sums[0] += medium_.exchange[c] / (bed.void_fraction[c] * bed.void_fraction[c]);
                sums[1] += 1;
            }
        ranks_->sum(sums, 2);
        fs.resistance_floor = std::max({settings.flow.resistance_floor, through_flow_rate(), sums[1] > 0 ? 1e-3 * sums[0] / sums[1] : 0});
        r.flow = flow_.iterate(gas.flow, medium_, boundary_, {}, fs);
        r.pressure_floored = update_density();
        if (is_settled(r)) break;
    }
    check_balances(r, nullptr, 0, 0);
    return r;
}

void solver::start_from_rest() {
    double moving = 0;
    for (const double f : gas.flow.mass_flux) moving += f != 0;
    if (ranks_->sum(moving) == 0) level_zero(3);
}

report solver::iterate() {
    take_bed();
    report r;
    start_from_rest();
    inner_iteration(r, {}, nullptr);
    is_settled(r);
    check_balances(r, nullptr, 0, 0);
    return r;
}

report solver::iterate_scalars() {
    take_bed();
    report r;
    r.iterations = 1;
    if (settings.species && species_ > 1) solve_species(r, nullptr, 0, 0);
    if (settings.energy) solve_enthalpy(r, nullptr, 0, 0);
    update_density();
    is_settled(r);
    check_balances(r, nullptr, 0, 0);
    return r;
}

report solver::steady() {
    take_bed();
    report r;
    start_from_rest();
    while (r.iterations < settings.max_iterations) {
        inner_iteration(r, {}, nullptr);
        if (is_settled(r) && (r.iterations > 2 || !r.converged)) break;
    }
    // Tight last solves, so that the balances close to round-off.
    if (r.converged) {
        const solver_settings usual = settings;
        settings.flow.pressure = {1e-12, 0, 400};
        settings.scalars = {1e-12, 0, 1000};
        settings.energy_relaxation = 1;
        for (int i = 0; i < 3; ++i) inner_iteration(r, {}, nullptr);
        settings = usual;
    }
    check_balances(r, nullptr, 0, 0);
    confirm(r);
    return r;
}

report solver::step(double dt, double storage) {
    if (!(dt > 0) || !(storage >= 0)) throw std::invalid_argument("hearth::gas: step: dt must be > 0, storage >= 0");
    take_bed();
    if (old_void_.empty()) old_void_ = bed.void_fraction;
    if (medium_.compressibility.empty()) {
        medium_.compressibility.resize(mesh_->cells());
        for (int c = 0; c < mesh_->cells(); ++c) {
            const double p = density_pressure(c);
            medium_.compressibility[c] = model_->compressibility(p, model_->density(p, gas.temperature[c], composition(c)));
        }
    }
    const gas_fields before = gas;
    const flow_history history{dt, storage, before.density, old_void_, before.flow.mass_flux, before.flow.velocity};
    start_from_rest();
    report r;
    const solver_settings usual = settings;
    // each solve is tight enough for the balances of this very step
    settings.flow.pressure.relative = std::min(settings.flow.pressure.relative, 1e-3);
    settings.scalars.relative = std::min(settings.scalars.relative, 1e-6);
    while (r.iterations < settings.max_inner) {
        inner_iteration(r, history, &before);
        if (is_settled(r)) break;
    }
    settings.flow.pressure = {1e-13, 0, 400};
    settings.scalars = {1e-13, 0, 1000};
    settings.energy_relaxation = 1;
    if (r.converged) inner_iteration(r, history, &before);
    settings = usual;
    if (r.broken) {  // nothing broken is passed on
        gas = before;
        return r;
    }
    gas.density = stored_density_;  // differs from the equation of state by what the iteration left over
    check_balances(r, &before, dt, storage);
    confirm(r);
    old_void_ = bed.void_fraction;
    return r;
}

}  // namespace hearth::gas
