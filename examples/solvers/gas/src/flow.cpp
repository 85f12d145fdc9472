// SPDX-License-Identifier: MIT
#include <hearth/gas/flow.hpp>

#include <algorithm>
#include <cmath>

namespace hearth::gas {

namespace {

/// Part of the fitted slope on a face by the tangent of the angle of its lean: none below 17 degrees, all above 31.
double share_of_fit(double tangent) { return std::clamp((tangent - 0.3) / 0.3, 0.0, 1.0); }

}  // namespace

flow::flow(const mesh& m, const pattern& p, const gradient& g, const parallel& ranks, workspace& work)
    : mesh_(&m),
      pattern_(&p),
      gradients_(&g),
      ranks_(&ranks),
      work_(&work),
      pressure_solver_(ranks.make_preconditioner(p), ranks, work),
      source_(work.first),
      drive_(work.second),
      previous_(work.third),
      inverse_void_(work.scalar),
      boundary_velocity_(m.boundary_faces()),
      resistance_(m.cells()),
      relax_(m.cells()),
      outlet_conductance_(m.boundary_faces()) {}

flow_state flow::make_state() const {
    flow_state s;
    s.pressure.assign(mesh_->cells(), 0.0);
    s.velocity.assign(mesh_->cells(), {});
    s.mass_flux.assign(mesh_->faces(), 0.0);
    s.pressure_gradient.assign(mesh_->cells(), {});
    return s;
}

flow_report flow::iterate(flow_state& state, const flow_medium& medium, const flow_boundary& boundary,
                          const flow_history& history, const flow_settings& settings) {
    const mesh& m = *mesh_;
    const int n = m.owned_cells();
    flow_report report;
    for (int f = m.internal_faces(); f < m.faces(); ++f)
        if (boundary.type[f - m.internal_faces()] == flow_boundary::kind::inlet)
            state.mass_flux[f] = boundary.mass_flux[f - m.internal_faces()];
    assemble_momentum(state, medium, boundary, history, settings);
    predict(state, medium, history, settings);
    if (m.largest_angle > 0.01) find_pressure_slope(state, medium, boundary, settings);
    double sums[6] = {0, 0, 0, 0, 0, 0};
    for (int f = m.internal_faces(); f < m.faces(); ++f) sums[1] += 0.5 * std::abs(state.mass_flux[f]);
    for (int c = 0; c < n; ++c) sums[1] += 0.5 * std::abs(medium.mass_source[c]);
    assemble_pressure(state, medium, boundary, history);

    array<double>& residual = inverse_void_;  // free from here on
    work_->a.apply(state.pressure.data(), residual.data());
    for (int c = 0; c < n; ++c) sums[0] += std::abs(work_->right[c] - residual[c]);
    previous_pressure_.assign(state.pressure.begin(), state.pressure.begin() + n);
    report.pressure = pressure_solver_.solve(work_->a, work_->right.data(), state.pressure.data(), settings.pressure);
    correct(state, medium, history, settings.inertia);

    double low = 0, high = 0;
    for (int c = 0; c < n; ++c) {
        const vector3 change = state.velocity[c] - previous_[c];
        sums[2] += dot(change, change);
        sums[3] += dot(state.velocity[c], state.velocity[c]);
        const double step = state.pressure[c] - previous_pressure_[c];
        sums[4] += step * step;
        sums[5] += 1;
        low = std::min(low, state.pressure[c]);
        high = std::max(high, state.pressure[c]);
    }
    ranks_->sum(sums, 6);
    const double range = ranks_->max(high) + ranks_->max(-low);
    // gas slower than a nanometre per second rests: its changes are round-off
    sums[3] += 1e-18 * sums[5];
    const auto ratio = [](double a, double b) { return a > 0 ? (b > 0 ? a / b : 1.0) : a == 0 ? 0.0 : a; };
    report.mass_imbalance = ratio(sums[0], sums[1]);
    report.velocity_change = std::sqrt(ratio(sums[2], sums[3]));
    report.pressure_change = ratio(std::sqrt(sums[4] / sums[5]), range);
    return report;
}

/// Where the line between centres leans on the face, part of the pressure's slope comes from the last iteration.  The one
/// that satisfies momentum in each cell cancels the noise of uneven cells best, but feeds itself where the lean is strong.
/// There it is fitted to the pressures themselves, and so bounded by them.  Between two cells the pressure bends where the
/// resistance jumps, as the fluxes have it, and what gravity holds is taken off first: resting gas keeps its exact slope.
void flow::find_pressure_slope(const flow_state& state, const flow_medium& medium, const flow_boundary& boundary,
                               const flow_settings& settings) {
    const mesh& m = *mesh_;
    const int internal = m.internal_faces();
    if (slope_.empty()) slope_ = state.pressure_gradient;
    array<double>& to_boundary = outlet_conductance_;  // free until the pressure's equation is made
    for (int f = internal; f < m.faces(); ++f) {
        const int p = m.owner[f], b = f - internal;
        to_boundary[b] = boundary.type[b] == flow_boundary::kind::outlet ? boundary.pressure[b] - state.pressure[p]
                                                                         : dot(slope_[p], m.face_centre[f] - m.centre[p]);
    }
    slope_.assign(m.cells(), {});
    const double least = std::max(settings.resistance_floor, 1e-30);
    const auto resistance = [&](int c) {  // of the bed to the mass flux [1/s]
        const double e = medium.void_fraction[c];
        return (medium.exchange[c] / (e * e) + least) / medium.density[c];
    };
    for (int f = 0; f < internal; ++f) {
        const int p = m.owner[f], q = m.neighbour[f];
        const double near_p = 1 - m.owner_weight[f], near_q = m.owner_weight[f];
        const vector3 d = m.centre[q] - m.centre[p];
        const double held_p = medium.density[p] * dot(medium.gravity, d), held_q = medium.density[q] * dot(medium.gravity, d);
        const double hp = resistance(p), hq = resistance(q);
        const double rest = (state.pressure[q] - state.pressure[p] - near_p * held_p - near_q * held_q) / (near_p * hp + near_q * hq);
        const vector3 along = 1 / dot(d, d) * d;
        slope_[p] += (held_p + hp * rest) * along;
        slope_[q] += (held_q + hq * rest) * along;
    }
    for (int f = internal; f < m.faces(); ++f) {
        const vector3 d = m.face_centre[f] - m.centre[m.owner[f]];
        slope_[m.owner[f]] += to_boundary[f - internal] / dot(d, d) * d;
    }
    gradients_->solve(slope_.data());
    ranks_->gather(&slope_[0].x, 3);
}

/// Leaves the part of each flux that does not depend on the new pressure in the mass fluxes of the state.
void flow::assemble_pressure(flow_state& state, const flow_medium& medium, const flow_boundary& boundary,
                             const flow_history& history) {
    const mesh& m = *mesh_;
    matrix& equation = work_->a;
    array<double>& right = work_->right;
    const int internal = m.internal_faces(), n = m.owned_cells();
    const bool skewed = m.largest_angle > 0.01;
    equation.clear();
    for (int c = 0; c < n; ++c) {
        right[c] = medium.mass_source[c];
        if (!(history.step > 0)) continue;
        const double storage = history.storage * m.volume[c] / history.step, e = medium.void_fraction[c];
        const double give = storage * e * medium.compressibility[c];
        equation.diagonal[c] = give;
        right[c] += give * state.pressure[c] - storage * (e * medium.density[c] -
                                                           history.void_fraction[c] * history.density[c]);
    }
    bool level_is_set = history.step > 0 && history.storage > 0;
    if (level_is_set) {
        double give = 0;
        for (int c = 0; c < n; ++c) give += equation.diagonal[c];
        level_is_set = ranks_->sum(give) > 0;
    }
    const double per_step = history.step > 0 ? 1 / history.step : 0;
    // Integral of the momentum equation over the way from centre to centre: p's part of it, q's part of it.
    struct half { double stiffness, relax, old; vector3 drive; };
    const auto half_way = [&](int c, double part) {
        const double per_density = part / medium.density[c];
        return half{(resistance_[c] + relax_[c] + step_inertia(c, medium, history)) * per_density, relax_[c] * per_density,
                    part * per_step / medium.void_fraction[c], part * drive_[c]};
    };
    for (int f = 0; f < m.faces(); ++f) {
        const int p = m.owner[f];
        const int b = f - internal;
        if (b >= 0 && boundary.type[b] != flow_boundary::kind::outlet) {
            outlet_conductance_[b] = 0;
            state.mass_flux[f] = boundary.type[b] == flow_boundary::kind::inlet ? boundary.mass_flux[b] : 0;
            right[p] -= state.mass_flux[f];
            continue;
        }
        const double part = b >= 0 ? 1 : 1 - m.owner_weight[f];
        half h = half_way(p, part);
        vector3 slope = part * state.pressure_gradient[p], d = m.face_centre[f] - m.centre[p];
        if (b < 0) {
            const int q = m.neighbour[f];
            const half other = half_way(q, 1 - part);
            h.stiffness += other.stiffness;
            h.relax += other.relax;
            h.old += other.old;
            h.drive += other.drive;
            slope += (1 - part) * state.pressure_gradient[q];
            d = m.centre[q] - m.centre[p];
        }
        double push = dot(m.area[f], h.drive) + h.relax * state.mass_flux[f];
        if (history.step > 0) push += h.old * history.mass_flux[f];
        if (skewed) {
            const vector3 lean = m.area[f] - m.conductance[f] * d;
            const double fitted = share_of_fit(norm(lean) / norm(m.area[f]));
            if (fitted > 0) {
                const vector3 fit = b < 0 ? part * slope_[p] + (1 - part) * slope_[m.neighbour[f]] : slope_[p];
                slope = (1 - fitted) * slope + fitted * fit;
            }
            push -= dot(lean, slope);
        }
        const double conductance = m.conductance[f] / h.stiffness;
        double& flux = state.mass_flux[f];
        flux = push / h.stiffness;
        equation.diagonal[p] += conductance;
        if (b >= 0) {
            outlet_conductance_[b] = conductance;
            flux -= conductance * boundary.pressure[b];
            right[p] -= flux;
            level_is_set = true;
            continue;
        }
        const int q = m.neighbour[f];
        right[p] -= flux;
        equation.entry[pattern_->owner_entry[f]] = -conductance;
        if (q < n) {
            right[q] += flux;
            equation.diagonal[q] += conductance;
            equation.entry[pattern_->neighbour_entry[f]] = -conductance;
        }
    }
    if (!(ranks_->max(level_is_set ? 1.0 : 0.0) > 0) && (m.global.empty() || m.global[0] == 0))
        equation.diagonal[0] *= 2;  // nothing sets the level: the first cell keeps the reference
}

void flow::correct(flow_state& state, const flow_medium& medium, const flow_history& history, bool inertia) {
    const mesh& m = *mesh_;
    const array<double>& coupling = work_->a.entry;
    const int internal = m.internal_faces(), n = m.owned_cells();
    const bool skewed = m.largest_angle > 0.01;
    array<vector3>& momentum = source_;  // free from here on: void fraction * density * velocity, times volume
    std::fill(momentum.begin(), momentum.end(), vector3{});
    // volume * G = sum of F (x_f - x_P) is exact for a constant G; what a slope of w adds to F is taken off first, so that
    // it is exact for a linear w too (in cells whose opposite faces are alike the slope adds nothing)
    const auto rebuild = [&](int c, int f, double flux, double sign) {
        const vector3 d = m.face_centre[f] - m.centre[c];
        if (skewed && inertia) {
            const vector3* g = &work_->gradient[3 * c];
            flux -= medium.density[c] * dot(m.area[f], vector3{dot(g[0], d), dot(g[1], d), dot(g[2], d)});
        }
        momentum[c] += (sign * flux) * d;
    };
    for (int f = 0; f < m.faces(); ++f) {
        const int p = m.owner[f];
        double& flux = state.mass_flux[f];
        if (f < internal) {
            const int q = m.neighbour[f];
            flux -= coupling[pattern_->owner_entry[f]] * (state.pressure[p] - state.pressure[q]);
            rebuild(q, f, flux, -1);
        } else {
            flux += outlet_conductance_[f - internal] * state.pressure[p];
        }
        rebuild(p, f, flux, 1);
    }
    for (int c = 0; c < n; ++c) {
        const vector3 w = 1 / (m.volume[c] * medium.density[c]) * momentum[c];
        state.velocity[c] = w;
        const double kept = step_inertia(c, medium, history);
        vector3 rest = drive_[c] - (resistance_[c] + relax_[c] + kept) * w + relax_[c] * previous_[c];
        if (kept > 0) rest += kept * medium.void_fraction[c] / history.void_fraction[c] * history.velocity[c];
        vector3& slope = state.pressure_gradient[c];
        slope = skewed ? 0.5 * (slope + rest) : rest;
    }
    ranks_->gather(&state.velocity[0].x, 3);
    ranks_->gather(&state.pressure_gradient[0].x, 3);
}

}  // namespace hearth::gas
