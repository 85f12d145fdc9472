// SPDX-License-Identifier: MIT
// One coupling of gas and bed, and what leads to the first.
#include <algorithm>
#include <cmath>

#include "acceleration.hpp"
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

constexpr double hot = 2130;  // product is dead burnt above [K]

}  // namespace

furnace::parts::parts(const settings& given, ranks given_ranks)
    : among(std::move(given_ranks)),
      scene((check(given), given)),
      measured(scene),
      profile(solve_shaft_profile(scene)),
      coarse_graining(scene.bed.coarse_graining),
      shaft(scene, scene.bed.coarse_graining * sauter_diameter(scene), among),
      rings(scene, scene.shaft.height, std::max(0.1, 1.5 * scene.bed.coarse_graining * sauter_diameter(scene))),
      share(among),
      clock((scene.time.acceleration_factor.value = acceleration_of(scene, profile))),
      gas_terms(gas_convection(closure::gunn{})),
      stone_terms(make_radiation(scene), make_conduction(scene)),
      network(network_params()),
      leap(scene) {
    if (!profile.converged) throw bad_scene("the one-dimensional solution of this scene did not converge");
    if (packed_by_dem()) fill.emplace(scene, among);
    else use_bed(scene.bed.packing == bed_packing::dense ? dense_bed(scene) : lattice_bed(scene));
}

void furnace::parts::use_bed(std::unique_ptr<dem::moving_bed> made) {
    bed = std::move(made);
    now = phase::ignite;
    // Parcels of a lattice are a little larger than asked, so that they hold all of the solid.
    bed_mass = mass_in_shaft();
    double surface = 0, volume = 0;
    for (const dem::sphere& s : bed->spheres()) {
        surface += s.radius * s.radius;
        volume += s.radius * s.radius * s.radius;
    }
    coarse_graining = 2 * volume / surface / sauter_diameter(scene);
    residence_time = scene.particles.mass_flow > 0 ? bed_mass / scene.particles.mass_flow : 3600.0;
    const auto* recorded = dynamic_cast<const dem::recorded_bed*>(bed.get());
    turn_length = recorded && scene.particles.mass_flow > 0 ? recorded->record().mass_of_turn() / scene.particles.mass_flow : 0;
    process_step = step_length();
    fields.start(static_cast<std::size_t>(bed->size()), scene.particles.feed_temperature);
}

void furnace::parts::fill_step() {
    const stopwatch timing(seconds.dem);
    fill->advance();
    if (!fill->done()) return;
    use_bed(fill->finished());
    fill.reset();
    fit_to_packing();
}

/// What compares with the bed, and what the bed's radiation is fitted to, has the void fraction that DEM made.
void furnace::parts::fit_to_packing() {
    constexpr double pi = 3.14159265358979323846;
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

double furnace::parts::mass_in_shaft() const {
    double sum = 0;
    for (std::size_t i = 0; i < bed->masses().size(); ++i) {
        if (bed->spheres()[i].centre.z < end_of_bed()) sum += bed->masses()[i];
    }
    return sum;
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

/// Of a recorded motion whole steps make a turn, or whole turns a step, so that means over turns do not feel that each
/// coupling sees another frame.
double furnace::parts::step_length() const {
    const int first = scene.time.couplings / 2;
    const double factor = scene.time.first_step_factor, steps = first * factor + (scene.time.couplings - first);
    const double asked = scene.time.residence_times * residence_time / steps * (couplings < first ? factor : 1);
    if (!(turn_length > 0)) return asked;
    return asked < turn_length ? turn_length / std::ceil(turn_length / asked - 1e-9) : turn_length * std::floor(asked / turn_length);
}

std::size_t furnace::parts::couplings_of_turn() const {
    return static_cast<std::size_t>(std::max(1L, std::lround(turn_length / process_step)));
}

void furnace::parts::couple() {
    process_step = step_length();
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
    leap.watch(cloud(), process_step);  // where the parcels are when they meet the gas, however far they sink afterwards
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
    const std::size_t hottest = hottest_stone();
    past.peak.push_back(fields.temperature[hottest]);
    past.peak_height.push_back(bed->spheres()[hottest].centre.z);
    past.centre.push_back(mean_temperature(past.peak_height.back(), 0, 0.2));
    past.pressure_drop.push_back(pressure_drop());
    past.gas_missing.push_back(gas_report.mass.in + gas_report.mass.source - gas_report.mass.out);
    past.solid_missing.push_back((fed_mass - passed_mass - (bed->total_mass() - mass_before)) / process_step);
    judge();
    if (now != phase::report && leap.due(couplings, window())) lead_to_steady();
}

/// Between two couplings: neither books nor balances see it.
void furnace::parts::lead_to_steady() {
    measured.burners.mass_flow = shaft.burner_flow();
    const steadying::leap by = leap.shift(measured, couplings_of_turn());
    if (by.halved) ++halved_leaps;
    if (by.shift.empty()) return;
    ++leaps;
    const double height = scene.shaft.height;
    const auto warm = [&](double& temperature, double z) {
        const double wanted = temperature + at_height(by.shift, z, height);
        temperature = std::clamp(by.bounded(temperature, wanted, at_height(by.slack, z, height)), 200.0, 3400.0);
        if (temperature != wanted) ++held;
    };
    for (std::size_t i = 0; i < fields.temperature.size(); ++i) {
        const double z = bed->spheres()[i].centre.z;
        if (z < height) warm(fields.temperature[i], z);
    }
    for (std::size_t r = 0; r < rings.size(); ++r) warm(rings.temperature()[r], rings.middle(r));
}

}  // namespace hearth::furnace
