// SPDX-License-Identifier: MIT
#include "nitric_oxide.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <hearth/combustion/nitric_oxide.hpp>

namespace hearth::furnace {

namespace {
constexpr double least_temperature = 1400;  // below it makes none that counts [K]
}

std::vector<double> thermal_nitric_oxide_of(const shaft_gas& shaft) {
    const gas::mesh& m = shaft.grid();
    const auto& gas = shaft.solver.gas;
    const auto cells = static_cast<std::size_t>(m.cells());
    struct inflow {
        int from;
        double mass;  // [kg/s]
    };
    std::vector<std::vector<inflow>> inflows(cells);
    std::vector<double> out(cells, 0.0), no(cells, 0.0);
    for (int f = 0; f < m.internal_faces(); ++f) {
        const double flux = gas.flow.mass_flux[f];
        const int from = flux >= 0 ? m.owner[f] : m.neighbour[f], to = flux >= 0 ? m.neighbour[f] : m.owner[f];
        inflows[static_cast<std::size_t>(to)].push_back({from, std::abs(flux)});
        out[static_cast<std::size_t>(from)] += std::abs(flux);
    }
    for (int f = m.internal_faces(); f < m.faces(); ++f) out[static_cast<std::size_t>(m.owner[f])] += std::max(0.0, gas.flow.mass_flux[f]);
    const auto own = static_cast<std::size_t>(m.owned_cells());
    std::vector<int> upwards(own);  // gas rises, so few sweeps in this order settle it
    std::iota(upwards.begin(), upwards.end(), 0);
    std::sort(upwards.begin(), upwards.end(), [&](int a, int b) { return m.centre[a].z != m.centre[b].z ? m.centre[a].z < m.centre[b].z : a < b; });
    // The sweeps change NO alone, so what else the hot gas holds is found once.
    std::vector<combustion::per_species> hot(own);
    for (const int c : upwards) {
        if (gas.temperature[c] > least_temperature) hot[static_cast<std::size_t>(c)] = shaft.composition(c);
    }
    for (int sweep = 0; sweep < 30; ++sweep) {
        double change = 0, largest = 0;
        for (const int c : upwards) {
            const auto k = static_cast<std::size_t>(c);
            if (!(out[k] > 0)) continue;
            double brought = 0;
            for (const inflow& in : inflows[k]) brought += in.mass * no[static_cast<std::size_t>(in.from)];
            const double t = gas.temperature[c];
            double made = 0, slope = 0;  // [mol/s], [kg/s]
            if (t > least_temperature) {
                const combustion::per_species& n = hot[k];
                const double moles = combustion::sum(n), volume = m.volume[c] * shaft.solver.bed.void_fraction[c];
                const auto x = combustion::mole_fractions(n);
                const auto rate = [&](double amount) {
                    return volume * combustion::thermal_nitric_oxide::rate(t, shaft.solver.absolute_pressure(c), x, amount / moles);
                };
                const double step = 1e-3 * no[k] + 1e-9;
                made = rate(no[k]);
                slope = std::min(0.0, (rate(no[k] + step) - made) / step);  // decomposition, implicit
            }
            const double next = std::max(0.0, (brought + made - slope * no[k]) / (out[k] - slope));
            change = std::max(change, std::abs(next - no[k]));
            largest = std::max(largest, next);
            no[k] = next;
        }
        shaft.among().gather(no.data(), 1);
        if (shaft.among().max(change) <= 1e-4 * shaft.among().max(largest)) break;
    }
    return no;
}

}  // namespace hearth::furnace
