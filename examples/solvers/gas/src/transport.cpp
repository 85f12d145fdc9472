// SPDX-License-Identifier: MIT
#include <hearth/gas/transport.hpp>

#include <algorithm>

namespace hearth::gas {

transport::transport(const mesh& m, const pattern& p, const gradient& g, const parallel& ranks, workspace& work)
    : diffusivity(work.diffusivity),
      a(work.a),
      right(work.right),
      mesh_(&m),
      pattern_(&p),
      gradients_(&g),
      ranks_(&ranks),
      work_(&work),
      solver_(ranks, work),
      values_(m.boundary_faces()) {}

/// Two resistances in a row, each over its cell's part of the way [kg/(m s)].
double transport::face_diffusivity(int f) const {
    const double here = diffusivity[mesh_->owner[f]], there = diffusivity[mesh_->neighbour[f]];
    const double part = 1 - mesh_->owner_weight[f];  // the owner's
    const double resistance = part * there + (1 - part) * here;
    return resistance > 0 ? here * there / resistance : 0;
}

void transport::assemble(const array<double>& mass_flux, const array<double>& boundary_diffusion) {
    const mesh& m = *mesh_;
    const int internal = m.internal_faces(), n = m.owned_cells();
    mass_flux_ = mass_flux.data();
    boundary_diffusion_ = boundary_diffusion.data();
    a.clear();
    for (int f = 0; f < internal; ++f) {
        const int p = m.owner[f], q = m.neighbour[f];
        const double conductance = face_diffusivity(f) * m.conductance[f], flux = mass_flux[f];
        const double into_p = conductance + std::max(-flux, 0.0), into_q = conductance + std::max(flux, 0.0);
        a.entry[pattern_->owner_entry[f]] = -into_p;
        a.diagonal[p] += into_p;
        if (q >= n) continue;
        a.entry[pattern_->neighbour_entry[f]] = -into_q;
        a.diagonal[q] += into_q;
    }
    for (int f = internal; f < m.faces(); ++f)
        a.diagonal[m.owner[f]] += boundary_diffusion[f - internal] + std::max(-mass_flux[f], 0.0);
}

void transport::start(const double* field, const array<double>& boundary_value) {
    array<vector3>& slope = work_->gradient;
    const mesh& m = *mesh_;
    const int internal = m.internal_faces(), n = m.owned_cells();
    for (int f = internal; f < m.faces(); ++f) {
        const int b = f - internal;
        const bool given = mass_flux_[f] < 0 || boundary_diffusion_[b] > 0;
        values_[b] = given ? boundary_value[b] : field[m.owner[f]];
    }
    gradients_->compute<1>(field, values_.data(), slope.data());
    ranks_->gather(&slope[0].x, 3);
    std::fill(right.begin(), right.end(), 0.0);
    const bool skewed = m.largest_angle > 0.01;
    for (int f = 0; f < internal; ++f) {
        const int p = m.owner[f], q = m.neighbour[f];
        const bool forward = mass_flux_[f] >= 0;
        const int up = forward ? p : q, down = forward ? q : p;
        const vector3 d = m.centre[down] - m.centre[up];
        const double share = forward ? 1 - m.owner_weight[f] : m.owner_weight[f];
        double flux = mass_flux_[f] * limited_correction(field[down] - field[up], dot(slope[up], d), share);
        if (skewed) {
            const vector3 skew = m.area[f] - (forward ? m.conductance[f] : -m.conductance[f]) * d;
            const vector3 g = m.owner_weight[f] * slope[p] + (1 - m.owner_weight[f]) * slope[q];
            flux -= face_diffusivity(f) * dot(g, skew);
        }
        right[p] -= flux;
        if (q < n) right[q] += flux;
    }
    for (int f = internal; f < m.faces(); ++f) {
        const int b = f - internal, p = m.owner[f];
        right[p] += (boundary_diffusion_[b] + std::max(-mass_flux_[f], 0.0)) * boundary_value[b];
        if (leaves_with_given_value(mass_flux_[f], boundary_diffusion_[b]))
            right[p] -= mass_flux_[f] * (boundary_value[b] - field[p]);
        if (skewed && boundary_diffusion_[b] > 0)
            right[p] += boundary_diffusion_[b] / m.conductance[f] *
                        dot(slope[p], m.area[f] - m.conductance[f] * (m.face_centre[f] - m.centre[p]));
    }
}

}  // namespace hearth::gas
