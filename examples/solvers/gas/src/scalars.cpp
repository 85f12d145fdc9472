// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <hearth/gas/solver.hpp>

namespace hearth::gas {

void solver::update_diffusivity() {
    const mesh& m = *mesh_;
    for (int c = 0; c < m.cells(); ++c) {
        double laminar = bed.void_fraction[c] * gas.conductivity[c] / gas.specific_heat[c];
        if (free_[c]) laminar += bed.void_fraction[c] * gas.eddy_viscosity[c] / settings.turbulent_prandtl;
        else laminar += settings.dispersion * gas.density[c] * norm(gas.flow.velocity[c]) * bed.diameter[c];
        scalars_.diffusivity[c] = laminar;
    }
    for (int f = m.internal_faces(); f < m.faces(); ++f) {
        const int b = f - m.internal_faces();
        boundary_diffusion_[b] = scalar_boundary_.fixed[b] > 0 ? scalars_.diffusivity[m.owner[f]] * m.conductance[f] : 0;
    }
}

void solver::solve_enthalpy(report& r, const gas_fields* before, double dt, double storage) {
    const mesh& m = *mesh_;
    const int n = m.owned_cells();
    update_diffusivity();
    scalars_.assemble(gas.flow.mass_flux, boundary_diffusion_);
    scalars_.start(gas.enthalpy.data(), scalar_boundary_.enthalpy);
    const double relax = settings.energy_relaxation;
    if (r.species_change > 0)  // the temperature that the present enthalpy has in the new mixture
        for (int c = 0; c < n; ++c)
            gas.temperature[c] = model_->temperature(gas.enthalpy[c], composition(c), gas.temperature[c]);
    // particles and walls: conductance * T - source, T linear in h about the present state
    const auto exchange = [&](int c, double conductance, double source) {
        const double per_heat = 1 / gas.specific_heat[c];
        scalars_.a.diagonal[c] += conductance * per_heat;
        scalars_.right[c] += source - conductance * (gas.temperature[c] - gas.enthalpy[c] * per_heat);
    };
    for (int b = 0; b < m.boundary_faces(); ++b)
        exchange(m.owner[b + m.internal_faces()], face_conductance_[b], face_source_[b]);
    for (int c = 0; c < n; ++c) {
        double& diagonal = scalars_.a.diagonal[c];
        double& right = scalars_.right[c];
        right += sources.enthalpy[c];
        const double mass = medium_.mass_source[c];
        if (mass > 0) diagonal += mass;
        else right -= mass * gas.enthalpy[c];
        exchange(c, bed.heat_conductance[c], bed.heat_source[c]);
        if (dt > 0) {
            const double rate = storage * m.volume[c] / dt;
            const double kept = rate * old_void_[c] * before->density[c];
            diagonal += kept;
            right += kept * before->enthalpy[c];
            if (settings.pressure_work)
                right += rate * bed.void_fraction[c] * (gas.flow.pressure[c] - before->flow.pressure[c]);
        }
        if (!(diagonal > 0)) {  // nothing moves, stores or leads heat here: the value stays
            diagonal = 1;
            right = gas.enthalpy[c];
        }
        diagonal /= relax;
        right += (1 - relax) * diagonal * gas.enthalpy[c];
    }
    double* const enthalpy = scalars_.spare(0);
    std::copy(gas.enthalpy.begin(), gas.enthalpy.end(), enthalpy);
    r.scalar_iterations += scalars_.solve(enthalpy, settings.scalars).iterations;
    double greatest = 0;
    r.temperature_limited = 0;
    for (int c = 0; c < m.cells(); ++c) {
        if (!std::isfinite(enthalpy[c])) {
            greatest = enthalpy[c];
            break;
        }
        gas.enthalpy[c] = enthalpy[c];
        const double t = gas.temperature[c];
        const double* y = composition(c);
        gas.temperature[c] = model_->temperature(gas.enthalpy[c], y, t);
        gas.specific_heat[c] = model_->specific_heat(gas.temperature[c], y);
        gas.viscosity[c] = model_->viscosity(gas.temperature[c], y);
        gas.conductivity[c] = model_->conductivity(gas.temperature[c], y);
        greatest = std::max(greatest, std::abs(gas.temperature[c] - t));
        r.temperature_limited += c < n && std::abs(model_->enthalpy(gas.temperature[c], y) - gas.enthalpy[c]) >
                                              1e-6 * gas.specific_heat[c] * gas.temperature[c];
    }
    r.temperature_change = ranks_->max(greatest);
    r.temperature_limited = static_cast<std::int64_t>(ranks_->sum(static_cast<double>(r.temperature_limited)));
}

void solver::solve_species(report& r, const gas_fields* before, double dt, double storage) {
    const mesh& m = *mesh_;
    const int n = m.owned_cells();
    update_diffusivity();
    // The same matrix for all; the last species, the bath gas, is what is left, so that the sum is 1.
    scalars_.assemble(gas.flow.mass_flux, boundary_diffusion_);
    const double relax = settings.energy_relaxation;
    for (int c = 0; c < n; ++c) {
        double& diagonal = scalars_.a.diagonal[c];
        diagonal += std::max(medium_.mass_source[c], 0.0);
        if (dt > 0) diagonal += storage * m.volume[c] / dt * old_void_[c] * before->density[c];
        if (!(diagonal > 0)) diagonal = 1e-30;
        diagonal /= relax;
    }
    const int width = species_;
    double greatest = 0;
    double* const fraction = scalars_.spare(0);
    const bool reacts = !sources.conversion.empty();
    double* const inert = scalars_.spare(1);  // the diagonal without reaction
    if (reacts) std::copy(scalars_.a.diagonal.begin(), scalars_.a.diagonal.begin() + n, inert);
    for (int k = 0; k + 1 < species_; ++k) {
        for (int c = 0; c < m.cells(); ++c) fraction[c] = gas.mass_fraction[width * c + k];
        scalars_.start(fraction, boundary_fraction_[k]);
        for (int c = 0; c < n; ++c) {
            double& right = scalars_.right[c];
            right += sources.species[width * c + k] - std::min(medium_.mass_source[c], 0.0) * fraction[c];
            if (dt > 0)
                right += storage * m.volume[c] / dt * old_void_[c] * before->density[c] *
                         before->mass_fraction[width * c + k];
            const double diagonal = reacts ? inert[c] : scalars_.a.diagonal[c];
            right += (1 - relax) * diagonal * fraction[c];
            if (diagonal <= 1e-30 / relax) right = diagonal * fraction[c];
            if (reacts) right += sources.conversion[width * c + k] * sources.converted[width * c + k];
        }
        for (int c = 0; reacts && c < n; ++c) scalars_.a.diagonal[c] = inert[c] + sources.conversion[width * c + k];
        r.scalar_iterations += scalars_.solve(fraction, settings.scalars).iterations;
        for (int c = 0; c < m.cells(); ++c) {
            double& y = gas.mass_fraction[width * c + k];
            greatest = std::max(greatest, std::abs(fraction[c] - y));
            y = fraction[c];
        }
    }
    for (int c = 0; c < m.cells(); ++c) {
        double rest = 1;
        for (int k = 0; k + 1 < species_; ++k) rest -= gas.mass_fraction[width * c + k];
        gas.mass_fraction[width * c + species_ - 1] = rest;
    }
    r.species_change = ranks_->max(greatest);
}

}  // namespace hearth::gas
