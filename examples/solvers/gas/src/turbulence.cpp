// SPDX-License-Identifier: MIT
#include <hearth/gas/turbulence.hpp>

#include <algorithm>
#include <cmath>

namespace hearth::gas {

k_epsilon::k_epsilon(const mesh& m, const parallel& ranks, const constants& c)
    : mesh_(&m),
      ranks_(&ranks),
      c_(c),
      no_diffusion_(m.boundary_faces(), 0.0) {}

void k_epsilon::wall_treatment(const gas_fields& gas, const array<char>& free, flow_boundary& boundary,
                               double* production, double* fixed_dissipation) {
    const mesh& m = *mesh_;
    const double c4 = std::sqrt(std::sqrt(c_.c_mu));
    std::fill_n(fixed_dissipation, m.owned_cells(), 0.0);
    // Where y+ leaves the viscous sublayer: y = ln(E y) / kappa.
    double edge = 11;
    for (int i = 0; i < 20; ++i) edge = std::log(c_.roughness * edge) / c_.kappa;
    array<double> wall_area(m.owned_cells(), 0.0), wall_production(m.owned_cells(), 0.0);
    for (int f = m.internal_faces(); f < m.faces(); ++f) {
        const int b = f - m.internal_faces(), c = m.owner[f];
        if (boundary.type[b] != flow_boundary::kind::wall) continue;
        boundary.wall_viscosity[b] = free[c] ? gas.viscosity[c] : 0;
        if (!free[c]) continue;
        const double size = norm(m.area[f]), rho = gas.density[c], nu = gas.viscosity[c] / rho;
        const double y = size / m.conductance[f];
        const double friction = c4 * std::sqrt(gas.kinetic[c]), y_plus = friction * y / nu;
        double turbulent = 0;  // over the laminar viscosity
        if (y_plus > edge) turbulent = c_.kappa * y_plus / std::log(c_.roughness * y_plus) - 1;
        boundary.wall_viscosity[b] *= 1 + turbulent;
        const vector3 slip = gas.flow.velocity[c] - boundary.velocity[b];
        const vector3 n = 1 / size * m.area[f];
        const double shear = norm(slip - dot(slip, n) * n) / y;
        wall_area[c] += size;
        if (turbulent > 0) {
            fixed_dissipation[c] += size * friction * friction * friction / (c_.kappa * y);
            wall_production[c] += size * (1 + turbulent) * nu * shear * friction / (c_.kappa * y);
        } else {
            fixed_dissipation[c] += size * 2 * gas.kinetic[c] * nu / (y * y);  // of the sublayer
        }
    }
    for (int c = 0; c < m.owned_cells(); ++c) {
        if (!(wall_area[c] > 0)) continue;
        fixed_dissipation[c] /= wall_area[c];
        production[c] = wall_production[c] / wall_area[c];
    }
}

/// Makes the row of a cell say: the value is this.
void k_epsilon::fix(transport& t, int cell, double value) const {
    const pattern& p = *t.a.shape;
    for (int i = p.first[cell]; i < p.first[cell + 1]; ++i) t.a.entry[i] = 0;
    t.right[cell] = t.a.diagonal[cell] * value;
}

k_epsilon::iteration k_epsilon::iterate(gas_fields& gas, const bed_fields& bed, const array<char>& free,
                                        transport& scalars, const array<vector3>& velocity_gradient,
                                        flow_boundary& boundary, const array<double>& boundary_kinetic,
                                        const array<double>& boundary_dissipation, const gas_fields* before,
                                        double step) {
    const mesh& m = *mesh_;
    const int n = m.owned_cells();
    double *const production = scalars.spare(0), *const fixed_dissipation = scalars.spare(1),
           *const old_kinetic = scalars.spare(2);
    for (int c = 0; c < n; ++c) {
        const vector3* g = &velocity_gradient[3 * c];
        const double ie = 1 / bed.void_fraction[c];
        double twice = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) twice += (g[i][j] + g[j][i]) * g[i][j];
        production[c] = gas.eddy_viscosity[c] / gas.density[c] * twice * ie * ie;  // [m^2/s^3]
    }
    wall_treatment(gas, free, boundary, production, fixed_dissipation);
    std::copy_n(gas.kinetic.begin(), n, old_kinetic);
    double sums[4] = {0, 0, 0, 0};  // change of k, k, cells lifted, cells capped
    const solve_settings accuracy{0.05, 0, 20};
    for (const bool solve_k : {false, true}) {
        for (int c = 0; c < m.cells(); ++c)
            scalars.diffusivity[c] = bed.void_fraction[c] *
                              (gas.viscosity[c] + gas.eddy_viscosity[c] / (solve_k ? c_.sigma_k : c_.sigma_epsilon));
        auto& field = solve_k ? gas.kinetic : gas.dissipation;
        scalars.assemble(gas.flow.mass_flux, no_diffusion_);
        scalars.start(field.data(), solve_k ? boundary_kinetic : boundary_dissipation);
        for (int c = 0; c < n; ++c) {
            const double mass = bed.void_fraction[c] * gas.density[c] * m.volume[c];
            if (!free[c]) {
                const double w = norm(gas.flow.velocity[c]) / bed.void_fraction[c] * c_.bed_intensity;
                const double k = 1.5 * w * w + 1e-10, length = c_.bed_length * bed.diameter[c];
                scalars.a.diagonal[c] = std::max(scalars.a.diagonal[c], 1e-30);
                fix(scalars, c, solve_k ? k : std::pow(c_.c_mu, 0.75) * k * std::sqrt(k) / length);
                continue;
            }
            if (!solve_k && fixed_dissipation[c] > 0) {
                scalars.a.diagonal[c] = std::max(scalars.a.diagonal[c], 1e-30);
                fix(scalars, c, fixed_dissipation[c]);
                continue;
            }
            const double rate = gas.dissipation[c] / old_kinetic[c];  // of the new dissipation once that is solved [1/s]
            scalars.right[c] += mass * production[c] * (solve_k ? 1 : c_.c1 * rate);
            scalars.a.diagonal[c] += mass * rate * (solve_k ? 1 : c_.c2);
            if (step > 0) {
                const double storage = mass / step;
                scalars.a.diagonal[c] += storage;
                scalars.right[c] += storage * (solve_k ? before->kinetic[c] : before->dissipation[c]);
            }
            const double more = (1 - c_.relaxation) / c_.relaxation * scalars.a.diagonal[c];
            scalars.a.diagonal[c] += more;
            scalars.right[c] += more * field[c];
        }
        scalars.solve(field.data(), accuracy);
        for (int c = 0; c < m.cells(); ++c) {
            sums[2] += c < n && free[c] && field[c] < least;
            field[c] = std::max(field[c], least);
        }
    }
    for (int c = 0; c < n; ++c) {
        sums[0] += (gas.kinetic[c] - old_kinetic[c]) * (gas.kinetic[c] - old_kinetic[c]);
        sums[1] += gas.kinetic[c] * gas.kinetic[c];
    }
    for (int c = 0; c < m.cells(); ++c) {
        const double k = gas.kinetic[c], most = greatest_ratio * gas.viscosity[c];
        const double eddy = free[c] ? c_.c_mu * gas.density[c] * k * k / gas.dissipation[c] : 0;
        gas.eddy_viscosity[c] = std::min(eddy, most);
        sums[3] += c < n && eddy > most;
    }
    ranks_->sum(sums, 4);
    return {sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0, static_cast<std::int64_t>(sums[2]),
            static_cast<std::int64_t>(sums[3])};
}

}  // namespace hearth::gas
