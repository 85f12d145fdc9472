// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <hearth/gas/solver.hpp>

namespace hearth::gas {

/// Sums of the very terms that the discrete equations hold; so what is missing is what the solves left undone.
void solver::check_balances(report& r, const gas_fields* before, double dt, double storage) const {
    const mesh& m = *mesh_;
    const int width = species_;
    array<balance> all(2 + width);  // mass, enthalpy, species
    array<double> supplied(2 + width), gathered(2 + width);  // sums of magnitudes
    const auto supply = [&](int k, double x) {
        all[k].source += x;
        supplied[k] += std::abs(x);
    };
    const auto store = [&](int k, double x) {
        all[k].stored += x;
        gathered[k] += std::abs(x);
    };
    double backflow = 0;
    for (int f = m.internal_faces(); f < m.faces(); ++f) {
        const int b = f - m.internal_faces(), c = m.owner[f];
        const double flux = gas.flow.mass_flux[f];
        backflow += boundary_.type[b] == flow_boundary::kind::outlet && flux < 0;
        const auto count = [&](balance& to, double inside, double outside) {
            const bool given = flux < 0 || leaves_with_given_value(flux, boundary_diffusion_[b]);
            const double out = flux * (given ? outside : inside) + boundary_diffusion_[b] * (inside - outside);
            (out > 0 ? to.out : to.in) += std::abs(out);
        };
        supply(1, face_source_[b] - face_conductance_[b] * gas.temperature[c]);
        count(all[0], 1, 1);
        count(all[1], gas.enthalpy[c], scalar_boundary_.enthalpy[b]);
        for (int k = 0; k < width; ++k)
            count(all[2 + k], gas.mass_fraction[width * c + k], boundary_fraction_[k][b]);
    }
    double inventory = 0;  // kg
    for (int c = 0; c < m.owned_cells(); ++c) {
        inventory += m.volume[c] * bed.void_fraction[c] * gas.density[c];
        supply(0, medium_.mass_source[c]);
        supply(1, sources.enthalpy[c] + bed.heat_source[c] - bed.heat_conductance[c] * gas.temperature[c]);
        for (int k = 0; k < width; ++k) {
            supply(2 + k, sources.species[width * c + k]);
            const int i = width * c + k;
            if (!sources.conversion.empty()) supply(2 + k, sources.conversion[i] * (sources.converted[i] - gas.mass_fraction[i]));
        }
        if (!before) continue;
        const double rate = storage * m.volume[c] / dt;
        const double now = rate * bed.void_fraction[c] * gas.density[c], then = rate * old_void_[c] * before->density[c];
        const double work = settings.pressure_work ? gas.flow.pressure[c] - before->flow.pressure[c] : 0;
        store(0, now - then);
        store(1, now * gas.enthalpy[c] - then * before->enthalpy[c] - rate * bed.void_fraction[c] * work);
        for (int k = 0; k < width; ++k)
            store(2 + k, now * gas.mass_fraction[width * c + k] - then * before->mass_fraction[width * c + k]);
    }
    inventory = ranks_->sum(inventory);
    for (int k = 0; k < 2 + width; ++k) {
        balance& x = all[k];
        double sums[6] = {x.in, x.out, x.source, x.stored, supplied[k], gathered[k]};
        ranks_->sum(sums, 6);
        const double turnover = std::max({sums[0], sums[1], sums[4], sums[5]});
        const double missing = sums[0] - sums[1] + sums[2] - sums[3];
        // Gas that exchanges less than 1e-12 of itself per second rests: what is missing is round-off.
        const bool rests = k != 1 && (k == 0 ? turnover : all[0].turnover) < 1e-12 * inventory;
        x = {sums[0], sums[1], sums[2], sums[3], turnover, turnover > 0 && !rests ? std::abs(missing) / turnover : 0};
    }
    r.backflow_faces = static_cast<std::int64_t>(ranks_->sum(backflow));
    r.mass = all[0];
    r.enthalpy = all[1];
    r.species.assign(all.begin() + 2, all.end());
}

}  // namespace hearth::gas
