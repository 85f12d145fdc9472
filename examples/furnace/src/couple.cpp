// SPDX-License-Identifier: MIT
// One coupling of gas and bed, and what leads to the first.
#include <algorithm>
#include <cmath>

#include "parts.hpp"

namespace hearth::furnace {

namespace {

stone_radiation make_radiation(const settings& scene) {
    radiation_params p;
    p.solid_fraction = std::clamp(1 - scene.bed.void_fraction, 0.3, 0.7);
    p.emissivity = scene.particles.emissivity;
    p.open_from = 0.99;  // top and bottom look at the bed that feeds and follows
    const double in_range = closure::wall_view::bed::solid_fraction_range().clamp(p.solid_fraction);
    return stone_radiation(closure::feng_han::monte_carlo_fit{}, p, closure::wall_view::bed(in_range));
}

stone_conduction make_conduction(const settings& scene) {
    contact_materials m;
    m.particle = {scene.bed.modulus, scene.bed.poisson_ratio};
    m.wall = m.particle;
    return stone_conduction(closure::zhang::constriction{}, m);
}

thermal_network::params network_params() {
    thermal_network::params p;
    p.tolerance = 1e-10;  // of some 1e6 W/K times 2000 K: below 0.1 W
    return p;
}

constexpr double ring_mass = 1e-6;  // of a ring of the wall, which stores nothing that counts [kg]
constexpr double hot = 2130;  // product is dead burnt above [K]

}  // namespace

furnace::parts::parts(const settings& given)
    : scene((check(given), given)),
      profile(solve_shaft_profile(scene)),
      coarse_graining(scene.bed.coarse_graining),
      shaft(scene, scene.bed.coarse_graining * sauter_diameter(scene)),
      rings(scene, scene.shaft.height, std::max(0.1, 1.5 * scene.bed.coarse_graining * sauter_diameter(scene))),
      clock(scene.time.acceleration_factor),
      gas_terms(gas_convection(closure::gunn{})),
      stone_terms(make_radiation(scene), make_conduction(scene)),
      network(network_params()) {
    if (!profile.converged) throw bad_scene("the one-dimensional solution of this scene did not converge");
    if (packed_by_dem()) fill.emplace(scene);
    else use_bed(lattice_bed(scene));
}

void furnace::parts::use_bed(std::unique_ptr<dem::moving_bed> made) {
    bed = std::move(made);
    now = phase::ignite;
    // Parcels of a lattice are a little larger than asked, so that they hold all of the solid.
    bed_mass = bed->total_mass();
    double surface = 0, volume = 0;
    for (const dem::sphere& s : bed->spheres()) {
        surface += s.radius * s.radius;
        volume += s.radius * s.radius * s.radius;
    }
    coarse_graining = 2 * volume / surface / sauter_diameter(scene);
    residence_time = scene.particles.mass_flow > 0 ? bed_mass / scene.particles.mass_flow : 3600.0;
    process_step = scene.time.residence_times * residence_time / scene.time.couplings;
    fields.start(static_cast<std::size_t>(bed->size()), scene.particles.feed_temperature);
}

void furnace::parts::fill_step() {
    const stopwatch timing(seconds.dem);
    fill->advance(200);
    if (!fill->at_rest()) return;
    use_bed(fill->finished());
    fill.reset();
    fit_to_packing();
}

/// What compares with the bed, and what the bed's radiation is fitted to, has the void fraction that DEM made.
void furnace::parts::fit_to_packing() {
    constexpr double pi = 3.14159265358979323846;
    settings measured = scene;
    measured.bed.void_fraction = 1 - bed_mass / scene.particles.density / (pi / 4 * scene.shaft.diameter * scene.shaft.diameter * scene.shaft.height);
    profile = solve_shaft_profile(measured);
    stone_terms = hearth::scene(make_radiation(measured), make_conduction(measured));
}

void furnace::parts::ignite() {
    place_bed();  // before the gas starts: it flows through the bed, not through what the solver held before there was one
    shaft.start(profile);
    const bool cold = scene.time.start == start_from::cold;
    for (std::size_t i = 0; i < fields.temperature.size(); ++i) {
        const double z = bed->spheres()[i].centre.z;
        double t = at_height(profile.particle_temperature, z, scene.shaft.height);
        if (cold || z > scene.shaft.height) t = scene.particles.feed_temperature;
        fields.temperature[i] = fields.hottest[i] = t;
        fields.watched[i] = cold || z > scene.burners.height + 0.5 ? 1 : 0;
    }
    for (std::size_t r = 0; r < rings.size(); ++r) {
        const double z = (static_cast<double>(r) + 0.5) * scene.shaft.height / static_cast<double>(rings.size());
        rings.temperature()[r] = cold ? scene.particles.feed_temperature : at_height(profile.particle_temperature, z, scene.shaft.height);
    }
    now = phase::couple;
}

void furnace::parts::place_bed() {
    const stopwatch timing(seconds.voidage);
    std::vector<double> solid(static_cast<std::size_t>(shaft.grid().cells()));
    shaft.transfer.distribute(parcels{*bed, fields}, solid);
    const filtered_fraction_report report = shaft.fill.distribute(parcels{*bed, fields}, solid);
    stranded = report.cap.stranded_volume;
    auto& fluid = shaft.solver.bed;
    for (std::size_t c = 0; c < solid.size(); ++c) fluid.void_fraction[c] = 1 - solid[c];
    fluid.diameter.assign(solid.size(), sauter_diameter(scene));
    const double speed = bed->mass_flow() * scene.shaft.height / bed_mass;
    fluid.particle_velocity.assign(solid.size(), {0, 0, -speed});
}

double furnace::parts::bed_enthalpy() const {
    double sum = 0;
    for (std::size_t i = 0; i < fields.temperature.size(); ++i) sum += bed->masses()[i] * spinel::enthalpy(fields.temperature[i]);
    return sum;
}

void furnace::parts::move(double time) {
    const stopwatch timing(seconds.motion);
    const dem::passage passed = bed->advance(time);
    const double fed = spinel::enthalpy(scene.particles.feed_temperature);
    for (const dem::passage::leaver& gone : passed.left) {
        const auto from = static_cast<std::size_t>(gone.from);
        const bool seen_here = gone.from != dem::passage::fed;
        const double h = seen_here ? spinel::enthalpy(fields.temperature[from]) : fed;
        passed_enthalpy += gone.mass * h;
        passed_mass += gone.mass;
        if (seen_here && fields.watched[from] > 0) {
            product_hottest.push_back(fields.hottest[from]);
            product_hot_seconds.push_back(fields.hot_seconds[from]);
        }
    }
    passed_over_feed -= passed.mass_in * fed;
    fed_mass += passed.mass_in;
    fields.carry(passed, scene.particles.feed_temperature);
}

void furnace::parts::couple() {
    shaft.solver.forget_levels();  // so that a step depends on what each_part lists alone
    const double enthalpy_before = bed_enthalpy(), mass_before = bed->total_mass();
    fed_mass = passed_mass = passed_enthalpy = passed_over_feed = 0;
    move(0.5 * process_step);  // motion, exchange, motion: second order in the step
    place_bed();
    exchange_with_gas();
    exchange_with_neighbours();
    for (std::size_t i = 0; i < fields.temperature.size(); ++i) {
        fields.hottest[i] = std::max(fields.hottest[i], fields.temperature[i]);
        if (fields.temperature[i] > hot) fields.hot_seconds[i] += process_step;
    }
    move(0.5 * process_step);
    process_time += process_step;
    ++couplings;

    past.gas_out.push_back(gas_report.enthalpy.out - gas_report.enthalpy.in - shaft.burner_enthalpy());
    past.solids_out.push_back((passed_enthalpy + passed_over_feed) / process_step);
    past.product.push_back(passed_mass);
    past.product_enthalpy.push_back(passed_enthalpy);
    past.wall.push_back(wall_loss);
    past.stored.push_back((bed_enthalpy() - enthalpy_before) / process_step);
    past.offgas.push_back(shaft.solver.mean_temperature(shaft.outlet()));
    past.gas_missing.push_back(gas_report.mass.in + gas_report.mass.source - gas_report.mass.out);
    past.solid_missing.push_back((fed_mass - passed_mass - (bed->total_mass() - mass_before)) / process_step);
    judge();
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
    {
        const stopwatch timing(seconds.convection);
        gas_terms.gas_conductances(stones{*bed, fields, coarse_graining, scene.time.acceleration_factor}, seen, fields.conductance, clock);
        const double stones_of_parcel = std::pow(coarse_graining, 3);
        for (double& k : fields.conductance) k *= stones_of_parcel;
    }
    const interval fitted = closure::gunn::void_fraction_range();
    for (const double e : seen.void_fraction) clamped += fitted.contains(e) ? 0 : 1;

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
        stone_terms.links(parcels{*bed, fields}, bed_neighbours{*bed, rings}, no_gas{}, links);
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
