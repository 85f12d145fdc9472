// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <hearth/gas/flow.hpp>

namespace hearth::gas {

namespace {

/// grad w . s
vector3 across(const vector3* g, const vector3& s) { return {dot(g[0], s), dot(g[1], s), dot(g[2], s)}; }

/// (grad w)^T . s
vector3 transposed(const vector3* g, const vector3& s) { return s.x * g[0] + s.y * g[1] + s.z * g[2]; }

}  // namespace

double flow::step_inertia(int c, const flow_medium& medium, const flow_history& history) {
    if (!(history.step > 0)) return 0;
    const double e = medium.void_fraction[c];
    return history.density[c] * history.void_fraction[c] / (e * e * history.step);
}

void flow::assemble_momentum(const flow_state& state, const flow_medium& medium, const flow_boundary& boundary,
                             const flow_history& history, const flow_settings& settings) {
    const mesh& m = *mesh_;
    const int n = m.owned_cells();
    matrix& momentum = work_->a;
    for (int c = 0; c < m.cells(); ++c) inverse_void_[c] = 1 / medium.void_fraction[c];
    std::fill(source_.begin(), source_.end(), vector3{});
    std::fill(resistance_.begin(), resistance_.end(), 0.0);
    momentum.clear();
    if (settings.inertia) add_convection_and_diffusion(state, medium, boundary);

    for (int c = 0; c < n; ++c) {
        const double v = m.volume[c], iv = inverse_void_[c];
        double& diagonal = momentum.diagonal[c];
        const double drag = medium.exchange[c] * iv * iv * v;
        const double own = drag + std::max(medium.mass_source[c], 0.0) * iv * iv;
        diagonal += own;
        resistance_[c] += own;
        source_[c] += v * medium.density[c] * medium.gravity;
        if (!medium.momentum_source.empty()) source_[c] += iv * medium.momentum_source[c];
        if (!medium.particle_velocity.empty())
            source_[c] += drag * medium.void_fraction[c] * medium.particle_velocity[c];
        if (!settings.inertia) resistance_[c] = diagonal = std::max(diagonal, settings.resistance_floor * v);
        relax_[c] = drag;  // against changes a quadratic law resists twice: Newton's step, be flow or pressure given
        if (!settings.inertia) continue;
        relax_[c] = std::max(relax_[c] + (1 - settings.relaxation) / settings.relaxation * (diagonal - drag),
                             settings.resistance_floor * v);
        diagonal += relax_[c] + v * step_inertia(c, medium, history);
    }
}

void flow::add_convection_and_diffusion(const flow_state& state, const flow_medium& medium,
                                        const flow_boundary& boundary) {
    const mesh& m = *mesh_;
    const int internal = m.internal_faces();
    matrix& momentum = work_->a;
    array<vector3>& slope = work_->gradient;
    using kind = flow_boundary::kind;
    for (int f = internal; f < m.faces(); ++f) {
        const int b = f - internal;
        const vector3& w = state.velocity[m.owner[f]];
        if (boundary.type[b] == kind::slip) {
            const vector3& s = m.area[f];
            boundary_velocity_[b] = w - dot(w, s) / dot(s, s) * s;
        } else {
            boundary_velocity_[b] = boundary.type[b] == kind::outlet ? w : boundary.velocity[b];
        }
    }
    gradients_->compute<3>(&state.velocity[0].x, &boundary_velocity_[0].x, slope.data());
    ranks_->gather(&slope[0].x, 9);

    for (int f = 0; f < internal; ++f) {
        const int p = m.owner[f], q = m.neighbour[f];
        const double flux = state.mass_flux[f], weight = m.owner_weight[f];
        const double ip = inverse_void_[p], iq = inverse_void_[q];
        const double inverse_void = weight * ip + (1 - weight) * iq;  // w is continuous: so u is at the face
        const double mu_p = medium.viscosity[p], mu_q = medium.viscosity[q];
        const double viscosity = mu_p > 0 && mu_q > 0 ? 2 * mu_p * mu_q / (mu_p + mu_q) : 0;
        const double diffusion = viscosity * m.conductance[f];
        const double into_p = std::max(-flux, 0.0) * inverse_void + diffusion;
        const double into_q = std::max(flux, 0.0) * inverse_void + diffusion;

        // what upwind and the line of centres leave out
        const bool forward = flux >= 0;
        const int up = forward ? p : q, down = forward ? q : p;
        const vector3 d = m.centre[down] - m.centre[up];
        const vector3* upwind = &slope[3 * up];
        const vector3 &w_up = state.velocity[up], &w_down = state.velocity[down];
        const double share = forward ? 1 - weight : weight;
        const vector3 more{limited_correction(w_down.x - w_up.x, dot(upwind[0], d), share),
                           limited_correction(w_down.y - w_up.y, dot(upwind[1], d), share),
                           limited_correction(w_down.z - w_up.z, dot(upwind[2], d), share)};
        vector3 force = -(flux * inverse_void) * more;  // on the owner
        if (viscosity > 0) {
            const vector3 &s = m.area[f], along = forward ? d : -d;
            vector3 g[3];
            for (int k = 0; k < 3; ++k) g[k] = weight * slope[3 * p + k] + (1 - weight) * slope[3 * q + k];
            force += viscosity * across(g, s - m.conductance[f] * along);
            // div(mu (grad w)^T) = (grad w)^T . grad mu but for grad div w, which Eq. 9 holds with a third of mu and which
            // only shifts the pressure by about mu div w: 1e-3 Pa
            const vector3 turned = transposed(g, s);
            source_[p] += ip * (viscosity - mu_p) * turned;
            if (q < m.owned_cells()) source_[q] -= iq * (viscosity - mu_q) * turned;
        }
        source_[p] += ip * force;
        momentum.diagonal[p] += into_p * ip;
        momentum.entry[pattern_->owner_entry[f]] = -into_p * ip;
        // w.grad u = div(F w / e_f) - (w / e_P) div F: upwind differences, and what a change of e does to w (Bernoulli)
        const double squeeze_p = flux * (inverse_void - ip) * ip, squeeze_q = -flux * (inverse_void - iq) * iq;
        resistance_[p] += squeeze_p;
        if (q < m.owned_cells()) {
            source_[q] -= iq * force;
            momentum.diagonal[q] += into_q * iq;
            momentum.entry[pattern_->neighbour_entry[f]] = -into_q * iq;
            resistance_[q] += squeeze_q;
        }
    }
    for (int f = internal; f < m.faces(); ++f) {
        const int p = m.owner[f], b = f - internal;
        if (boundary.type[b] == kind::slip) continue;
        const bool fixed = boundary.type[b] != kind::outlet;
        double into = std::max(-state.mass_flux[f], 0.0) * inverse_void_[p];
        if (fixed) into += boundary.wall_viscosity[b] * m.conductance[f];
        momentum.diagonal[p] += into * inverse_void_[p];
        // what comes back through an outlet was at rest outside; carried in with the cell's momentum it would grow
        vector3 force = fixed ? into * boundary_velocity_[b] : vector3{};
        if (boundary.type[b] == kind::inlet && state.mass_flux[f] > 0)  // suction with a given velocity
            force -= state.mass_flux[f] * inverse_void_[p] * (boundary_velocity_[b] - state.velocity[p]);
        if (fixed) {
            const vector3 d = m.face_centre[f] - m.centre[p];
            const vector3 along = across(&slope[3 * p], d);
            vector3 bend = across(&slope[3 * p], m.area[f]) - m.conductance[f] * along;
            // The difference over half a cell is that in its middle; the slope, mean of the differences to both sides, tells
            // how it changes up to the wall: two thirds on even cells.  A wall function has its own profile.
            if (boundary.wall_viscosity[b] == medium.viscosity[p])
                bend += (2.0 / 3.0 * m.conductance[f]) * (boundary_velocity_[b] - state.velocity[p] - along);
            force += boundary.wall_viscosity[b] * bend;
        }
        source_[p] += inverse_void_[p] * force;
    }
    for (int c = 0; c < m.owned_cells(); ++c) {
        // accelerating into a narrower void would take from the diagonal: then it is a force
        if (resistance_[c] < 0) {
            source_[c] -= resistance_[c] * state.velocity[c];
            resistance_[c] = 0;
        }
        momentum.diagonal[c] += resistance_[c];
    }
}

void flow::predict(flow_state& state, const flow_medium& medium, const flow_history& history,
                   const flow_settings& settings) {
    const mesh& m = *mesh_;
    const int n = m.owned_cells();
    const matrix& momentum = work_->a;
    std::copy(state.velocity.begin(), state.velocity.end(), previous_.begin());
    const auto before = [&](int c) {  // velocity of the step before, for the void fraction of now
        return medium.void_fraction[c] / history.void_fraction[c] * history.velocity[c];
    };
    if (settings.inertia) {
        array<vector3>& right = drive_;
        for (int c = 0; c < n; ++c) {
            right[c] = source_[c] - m.volume[c] * state.pressure_gradient[c] + relax_[c] * state.velocity[c];
            if (history.step > 0) right[c] += m.volume[c] * step_inertia(c, medium, history) * before(c);
        }
        for (int i = 0; i < settings.momentum_sweeps; ++i) {
            gauss_seidel<3>(momentum, &right[0].x, &state.velocity[0].x, i % 2 == 1);
            ranks_->gather(&state.velocity[0].x, 3);
        }
    }
    // What drives each cell with its own share of the couplings taken off (SIMPLEC), per volume from here on.
    for (int c = 0; c < n; ++c) {
        const double v = m.volume[c];
        const double coupling = settings.inertia ? momentum.diagonal[c] - resistance_[c] - relax_[c] -
                                                       v * step_inertia(c, medium, history)
                                                 : 0;
        vector3 force = source_[c] - coupling * state.velocity[c];
        for (int i = pattern_->first[c]; i < pattern_->first[c + 1]; ++i)
            force -= momentum.entry[i] * state.velocity[pattern_->column[i]];
        drive_[c] = 1 / v * force;
        resistance_[c] *= 1 / v;
        relax_[c] *= 1 / v;
    }
    ranks_->gather(&drive_[0].x, 3);
    for (auto* field : {&resistance_, &relax_}) ranks_->gather(field->data(), 1);
}

}  // namespace hearth::gas
