// SPDX-License-Identifier: MIT
// What the bed is for the gas, and heat between the two, between stones, and with the wall.
#include <algorithm>
#include <cmath>

#include "parts.hpp"

namespace hearth::furnace {

namespace {

constexpr double ring_mass = 1e-6;  // of a ring of the wall, which stores nothing that counts [kg]

}  // namespace

void furnace::parts::place_bed() {
    const stopwatch timing(seconds.voidage);
    std::vector<double> solid(static_cast<std::size_t>(shaft.grid().cells()));
    const auto distribute = [&](auto& map) {
        if (scene.voidage.method == voidage_method::vfs) return map.distribute(cloud(), solid, deposit::centre{});
        return map.distribute(cloud(), solid);
    };
    distribute(shaft.transfer);
    const filtered_fraction_report report = distribute(shaft.fill);
    stranded = report.cap.stranded_volume;
    auto& fluid = shaft.solver.bed;
    for (std::size_t c = 0; c < solid.size(); ++c) fluid.void_fraction[c] = 1 - solid[c];
    fluid.diameter.assign(solid.size(), sauter_diameter(scene));
    const double speed = bed->mass_flow() * scene.shaft.height / bed_mass;
    fluid.particle_velocity.assign(solid.size(), {0, 0, -speed});
}

void furnace::parts::exchange_with_gas() {
    gas::solver& solver = shaft.solver;
    const std::size_t count = fields.temperature.size();
    const double model_step = process_step / clock.factor(0);
    const auto caloric_of = [](std::size_t) { return spinel{}; };
    const std::vector<double>& mass = bed->masses();
    {
        const stopwatch timing(seconds.transfer);
        seen.gather(solver, shaft.transfer, count);
    }
    const interval fitted = closure::gunn::void_fraction_range();
    for (std::size_t i = 0; i < count; ++i) {
        double& e = seen.void_fraction[i];
        if (fitted.contains(e)) continue;
        ++clamped;
        for (double& u : seen.velocity[i]) u *= e / fitted.clamp(e);  // the superficial velocity stays
        e = fitted.clamp(e);
    }
    {
        const stopwatch timing(seconds.convection);
        gas_terms.gas_conductances(stones{*bed, fields, coarse_graining, scene.time.acceleration_factor}, seen, fields.conductance, clock);
        const double stones_of_parcel = std::pow(coarse_graining, 3);
        for (double& k : fields.conductance) k *= stones_of_parcel;
    }
    // Heat over the step by the trapezoidal rule.  A stone that sinks by w in a step, along a profile with the slope g, then
    // carries the heat of the true one: an implicit step would be off by g w / 2, which spreads heat along the axis as if the
    // bed conducted (1900 W/(m^2 K) times w / 2: four times radiation at 0.17 m), an exponential one by g w x / 12 with
    // x = hA/C.  Beyond x = 2 the stone takes the temperature of the gas.  K = C x / (1 + x/2) is what the exchange makes of
    // hA' = C K / (C - K).
    std::vector<double> conductance(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double capacity = mass[i] * spinel::specific_heat(fields.temperature[i]) / process_step;
        const double units = fields.conductance[i] / capacity, ratio = std::min(units / (1 + 0.5 * units), 0.999);
        conductance[i] = capacity * ratio / (1 - ratio);
    }
    std::vector<double> guess = seen.temperature;
    for (int pass = 0; pass < 3; ++pass) {
        exchange.prepare(conductance, guess, mass, caloric_of, clock, model_step, fields.temperature);
        {
            const stopwatch timing(seconds.transfer);
            shaft.transfer.scatter(exchange.coefficient(), solver.bed.heat_conductance);
            shaft.transfer.scatter(exchange.source(), solver.bed.heat_source);
        }
        {
            const stopwatch timing(seconds.gas);
            // The flow follows the bed slowly: one iteration a coupling, but for the first, which comes from rest.
            const int flows = pass > 0 ? 0 : couplings == 0 ? 20 : 1;
            for (int inner = 0; inner < flows + (couplings == 0 ? 40 : 6); ++inner) {
                shaft.react();
                gas_report = inner < flows ? solver.iterate() : solver.iterate_scalars();
                if (gas_report.broken) throw std::runtime_error("hearth::furnace: gas: " + gas_report.reason);
                if (inner >= flows && gas_report.temperature_change < 0.2) break;
            }
        }
        {
            const stopwatch timing(seconds.transfer);
            shaft.transfer.gather(solver.gas.temperature, guess);
        }
        if (exchange.overshoots(guess, mass, caloric_of, clock, fields.temperature) == 0) break;
    }
    clamped += static_cast<double>(gas_report.temperature_limited);
    std::vector<particle_step<double>> taken;
    exchange.finish(guess, mass, caloric_of, clock, fields.temperature, taken);
    for (std::size_t i = 0; i < count; ++i) fields.convected[i] = taken[i].heat / process_step;
}

/// Radiation and conduction between parcels and with the wall, whose rings pass on what they get to the ambient.
void furnace::parts::exchange_with_neighbours() {
    wall_loss = 0;
    links.clear();
    if (!scene.physics.radiation && !scene.physics.conduction) return;
    {
        const stopwatch timing(seconds.links);
        stone_terms.links(cloud(), bed_neighbours{*bed, rings}, no_gas{}, links);
        std::size_t k = 0;
        for (const link_part& part : links.parts) {
            const bool radiates = part.term == 0;
            for (; k < part.pairs; ++k) {
                auto& link = links.pairs[k].link;
                // Parcels of k stones' width see each other through k times fewer layers than the stones that they stand for.
                if (radiates) link.radiation *= scene.physics.radiation ? 1 / coarse_graining : 0;
                else if (!scene.physics.conduction) link.conductance = 0;
            }
        }
        if (!scene.physics.radiation) links.walls.clear();
    }
    const stopwatch timing(seconds.radiation);
    // The rings are nodes of the network as the stones are: a wall that took its temperature from the stones of before would
    // lose a third too little, since it is 3 K colder than they are and they move by as much in a step.
    const std::size_t count = fields.temperature.size();
    std::vector<double> temperature = fields.temperature, mass = bed->masses();
    temperature.insert(temperature.end(), rings.temperature().begin(), rings.temperature().end());
    mass.resize(temperature.size(), ring_mass);
    std::vector<heat_bath<double>> baths(temperature.size());
    for (std::size_t r = 0; r < rings.size(); ++r) baths[count + r].add(conductive_link<double>{rings.conductance(r)}, rings.ambient(r));
    const std::size_t between_stones = links.pairs.size();
    for (const auto& wall : links.walls) links.pairs.push_back({wall.particle, static_cast<std::int32_t>(count) + wall.patch, wall.link});
    std::vector<particle_step<double>> taken;
    network.advance(links.pairs, baths, mass, [](std::size_t) { return spinel{}; }, clock, process_step / clock.factor(0), temperature, taken);
    links.pairs.resize(between_stones);
    for (std::size_t r = 0; r < rings.size(); ++r) wall_loss -= taken[count + r].conducted / process_step;
    rings.temperature().assign(temperature.begin() + static_cast<std::ptrdiff_t>(count), temperature.end());
    temperature.resize(count);
    fields.temperature = std::move(temperature);
}

}  // namespace hearth::furnace
