// SPDX-License-Identifier: MIT
// What the bed is for the gas, and heat between the two.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "parts.hpp"
#include "wall_layer.hpp"

namespace hearth::furnace {

void furnace::parts::place_bed() {
    share.cut(bed->spheres(), rings, end_of_bed());
    const stopwatch timing(seconds.voidage);
    std::vector<double> solid(static_cast<std::size_t>(shaft.grid().cells()));
    const own_parcels own{*bed, share.mine(), top()};
    if (scene.voidage.method == voidage_method::vfs) shaft.transfer.distribute(own, solid, deposit::centre{});
    else shaft.transfer.distribute(own, solid);
    const filtered_fraction_report report = shaft.fill.distribute_like(shaft.transfer, solid);
    stranded = report.cap.stranded_volume;
    if (coarse_graining > 1 && scene.bed.packing != bed_packing::lattice) {
        narrow_wall_layer(shaft.grid(), 0.5 * scene.shaft.diameter, scene.shaft.height, coarse_graining, scene.mesh.across / 2, shaft.among(),
                          solid);
    }
    auto& fluid = shaft.solver.bed;
    for (int c = 0; c < shaft.grid().owned_cells(); ++c) fluid.void_fraction[c] = 1 - solid[static_cast<std::size_t>(c)];
    fluid.diameter.assign(solid.size(), sauter_diameter(scene));
    const double speed = bed->mass_flow() * scene.shaft.height / bed_mass;
    fluid.particle_velocity.assign(solid.size(), {0, 0, -speed});
}

void furnace::parts::exchange_with_gas() {
    gas::solver& solver = shaft.solver;
    const std::size_t count = share.mine().size();
    const double model_step = process_step / clock.factor(0);
    const auto caloric_of = [](std::size_t) { return spinel{}; };
    const std::vector<double> mass = share.pick(bed->masses());
    std::vector<double> temperature = share.pick(fields.temperature), film;
    {
        const stopwatch timing(seconds.transfer);
        seen.gather(solver, shaft.transfer, count);
    }
    const interval fitted = closure::gunn::void_fraction_range();
    double outside = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double& e = seen.void_fraction[i];
        if (fitted.contains(e)) continue;
        ++outside;
        for (double& u : seen.velocity[i]) u *= e / fitted.clamp(e);  // the superficial velocity stays
        e = fitted.clamp(e);
    }
    clamped += shaft.among().sum(outside);
    {
        const stopwatch timing(seconds.convection);
        gas_terms.gas_conductances(stones{*bed, fields, share.mine(), coarse_graining, scene.time.acceleration_factor}, seen, film, clock);
        const double stones_of_parcel = std::pow(coarse_graining, 3);
        for (double& k : film) k *= stones_of_parcel;
    }
    // Heat over the step by the trapezoidal rule.  A stone that sinks by w in a step, along a profile with the slope g, then
    // carries the heat of the true one: an implicit step would be off by g w / 2, which spreads heat along the axis as if the
    // bed conducted (1900 W/(m^2 K) times w / 2: four times radiation at 0.17 m), an exponential one by g w x / 12 with
    // x = hA/C.  Beyond x = 2 the stone takes the temperature of the gas.  K = C x / (1 + x/2) is what the exchange makes of
    // hA' = C K / (C - K).
    std::vector<double> conductance(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double capacity = mass[i] * spinel::specific_heat(temperature[i]) / process_step;
        const double units = film[i] / capacity, ratio = std::min(units / (1 + 0.5 * units), 0.999);
        conductance[i] = capacity * ratio / (1 - ratio);
    }
    std::vector<double> guess = seen.temperature;
    for (int pass = 0; pass < 3; ++pass) {
        exchange.prepare(conductance, guess, mass, caloric_of, clock, model_step, temperature);
        {
            const stopwatch timing(seconds.transfer);
            shaft.transfer.scatter(std::tie(exchange.coefficient(), exchange.source()), std::tie(solver.bed.heat_conductance, solver.bed.heat_source));
        }
        {
            const stopwatch timing(seconds.gas);
            // The flow follows the bed in three iterations a coupling, but for the first, which comes from rest.  Drag is a
            // Newton step from the last flow: where parcels have gone from a cell one step is not enough, and blows up.
            const int flows = pass > 0 ? 0 : couplings == 0 ? 20 : 3;
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
        if (!among.any(exchange.overshoots(guess, mass, caloric_of, clock, temperature) > 0)) break;
    }
    clamped += static_cast<double>(gas_report.temperature_limited);
    std::vector<particle_step<double>> taken;
    exchange.finish(guess, mass, caloric_of, clock, temperature, taken);
    std::vector<double> convected(count);
    for (std::size_t i = 0; i < count; ++i) convected[i] = taken[i].heat / process_step;
    share.gather(temperature, fields.temperature);
    share.gather(film, fields.conductance);
    share.gather(convected, fields.convected);
}

}  // namespace hearth::furnace
