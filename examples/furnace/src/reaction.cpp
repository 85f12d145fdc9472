// SPDX-License-Identifier: MIT
#include "reaction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <hearth/combustion/mixing.hpp>

namespace hearth::furnace {

namespace {
constexpr double igniter_reach = 0.3;   // above and below the burners, as far as a start heats the gas [m]
constexpr double igniter_until = 1200;  // of the stones [K]
}  // namespace

reaction::reaction(const settings& scene)
    : bed_mixes_(scene.physics.mixing == gas_mixing::bed),
      igniter_(scene.time.start == start_from::cold ? scene.gas.ignition_temperature : 0),
      igniter_height_(scene.burners.height) {
    mechanism_.regularisation = std::max(mechanism_.regularisation, accuracy_.absolute);
}

void reaction::update(gas::solver& solver, const reacting_mixture& mixture) {
    using namespace combustion;
    const gas::mesh& m = solver.grid();
    const auto& gas = solver.gas;
    const int cells = m.owned_cells(), width = reacting_mixture::carried_count;
    const std::size_t numbers = static_cast<std::size_t>(width) * static_cast<std::size_t>(m.cells());
    auto &conversion = solver.sources.conversion, &converted = solver.sources.converted;
    conversion.assign(static_cast<int>(numbers), 0.0);
    converted.assign(static_cast<int>(numbers), 0.0);
    std::vector<double> leaving(static_cast<std::size_t>(m.cells()), 0.0);  // [kg/s]
    for (int f = 0; f < m.faces(); ++f) {
        const double flux = gas.flow.mass_flux[f];
        if (flux > 0)
            leaving[static_cast<std::size_t>(m.owner[f])] += flux;
        else if (f < m.internal_faces())
            leaving[static_cast<std::size_t>(m.neighbour[f])] -= flux;
    }
    reacting = 0;
    for (int c = 0; c < cells; ++c) {
        const double out = leaving[static_cast<std::size_t>(c)];
        double t = gas.temperature[c];
        if (igniter_ > t && std::abs(m.centre[c].z - igniter_height_) < igniter_reach &&
            solver.bed.heat_source[c] < igniter_until * solver.bed.heat_conductance[c]) {
            t = igniter_;
        }
        if (t < lowest_temperature || !(out > 0)) continue;
        const double* y = &gas.mass_fraction[width * c];
        const per_species n = mixture.composition(t, y);
        const double trace = accuracy_.absolute * sum(n);
        const bool fuel = n[CH4] + n[CO] + n[H2] > trace;
        if (!fuel && (t < dissociates_from || n[CO2] + n[H2O] < trace)) continue;
        ++reacting;
        const double void_fraction = solver.bed.void_fraction[c], pressure = solver.absolute_pressure(c);
        const double held = gas.density[c] * void_fraction * m.volume[c];  // [kg]
        const double rate = out / share_of_renewal;                        // [kg/s]
        double duration = held / rate;
        if (bed_mixes_) {
            const double mixing = mixing_model::bed_time(1 - void_fraction, solver.bed.diameter[c],
                                                         norm(gas.flow.velocity[c]) / void_fraction);
            duration *= reacting_fraction(chemical_time(mechanism_, t, pressure, mole_fractions(n)), mixing);
        }
        reactor vessel(mechanism_, n, t, pressure);
        extents e{};
        if (!integrate(vessel, e, duration, accuracy_).finished) {
            if (unfinished++ == 0) first_unfinished = c;
            continue;
        }
        const per_species after = vessel.amount(e);
        for (const auto& [number, species] :
             {std::pair{reacting_mixture::carbon_monoxide, CO}, std::pair{reacting_mixture::carbon_dioxide, CO2},
              std::pair{reacting_mixture::water, H2O}}) {
            const int at = width * c + static_cast<int>(number);
            conversion[at] = rate;
            converted[at] = after[species] * molar_mass[species];
        }
    }
}

}  // namespace hearth::furnace
