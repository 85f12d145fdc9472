// SPDX-License-Identifier: MIT
// The numbers that a run ends with, and what a scene will cost before it runs.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "acceleration.hpp"
#include "driven_bed.hpp"
#include "nitric_oxide.hpp"
#include "parts.hpp"

namespace hearth::furnace {

namespace {

/// Value below which a share of the sorted values lies.
std::optional<double> percentile(std::vector<double> values, double share) {
    if (values.empty()) return {};
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

std::optional<double> share_above(const std::vector<double>& values, double limit) {
    if (values.empty()) return {};
    return static_cast<double>(std::count_if(values.begin(), values.end(), [&](double v) { return v > limit; })) /
           static_cast<double>(values.size());
}

}  // namespace

summary furnace::summarise() const {
    constexpr double pi = 3.14159265358979323846;
    const parts& p = *parts_;
    summary s;
    const timings slowest = p.slowest();
    s.wall_time = slowest.all;
    rusage used{};
    if (getrusage(RUSAGE_SELF, &used) == 0) s.peak_memory = p.shaft.among().sum(1024.0 * static_cast<double>(used.ru_maxrss));
    for (std::size_t k = 0; k < slowest.phases.size(); ++k) s.phases.push_back({name(static_cast<phase>(k)), slowest.phases[k]});
    s.modules = {{"dem", slowest.dem}, {"motion", slowest.motion}, {"voidage", slowest.voidage}, {"transfer", slowest.transfer},
                 {"gas", slowest.gas}, {"convection", slowest.convection}, {"links", slowest.links}, {"radiation", slowest.radiation}};
    s.fuel_power = p.shaft.fuel_power();
    if (p.scene.particles.mass_flow > 0) s.specific_heat_consumption = *s.fuel_power / p.scene.particles.mass_flow * 1e-3;
    if (p.shaft.burner_flow() > 0) s.excess_air_ratio = p.shaft.excess_air_ratio();
    if (p.now == phase::fill) return s;
    s.bed_mass = p.mass_in_shaft();
    if (p.scene.particles.mass_flow > 0) s.residence_time = p.residence_time / 3600;
    if (p.now == phase::ignite) return s;

    const status now = this->now();
    s.mean_void_fraction = now.mean_void_fraction;
    s.maximum_temperature = std::max(now.peak_particle_temperature, now.maximum_gas_temperature);
    s.stranded_volume = p.stranded;
    s.clamped_evaluations = p.clamped;
    s.coupling_share = now.coupling_share;
    s.acceleration_factor = p.scene.time.acceleration_factor;
    s.converged = p.converged;

    const auto centre_minus_wall = [&](double z) -> std::optional<double> {
        const double difference = p.mean_temperature(z, 0, 0.3) - p.mean_temperature(z, 0.85, 2);
        if (std::isnan(difference) || z > p.scene.shaft.height) return {};
        return difference;
    };
    s.centre_minus_wall_at_1m = centre_minus_wall(1);
    s.centre_minus_wall_at_5m = centre_minus_wall(5);
    std::vector<double> h;
    for (std::size_t i = 0; i < p.fields.conductance.size(); ++i) {
        const dem::sphere& sphere = p.bed->spheres()[i];
        if (sphere.centre.z < 0.5 || sphere.centre.z > p.scene.burners.height - 0.2 || !(p.fields.conductance[i] > 0)) continue;
        h.push_back(p.fields.conductance[i] / (4 * pi * sphere.radius * sphere.radius * p.coarse_graining));
    }
    s.heat_transfer_coefficient_p05 = percentile(h, 0.05);
    s.heat_transfer_coefficient_p95 = percentile(h, 0.95);

    // What leaves, mixed: species by their cells, weighted by mass flow.
    const auto cells = static_cast<std::size_t>(p.shaft.grid().cells());
    const gas::patch& outlet = p.shaft.grid().find_patch(p.shaft.outlet());
    std::vector<double> amounts[combustion::species_count];
    for (auto& field : amounts) field.assign(cells, 0.0);
    for (int f = outlet.first; f < outlet.first + outlet.count; ++f) {
        const int c = p.shaft.grid().owner[f];
        const auto n = p.shaft.composition(c);
        for (std::size_t k = 0; k < combustion::species_count; ++k) amounts[k][static_cast<std::size_t>(c)] = n[k];
    }
    combustion::per_species leaving{};
    for (std::size_t k = 0; k < combustion::species_count; ++k) leaving[k] = p.shaft.outlet_mean(amounts[k]);
    const double moles = combustion::sum(leaving), dry = moles - leaving[combustion::H2O];
    if (dry > 0) {
        s.oxygen_dry_outlet = leaving[combustion::O2] / dry;
        s.carbon_monoxide_outlet = leaving[combustion::CO] / moles;
        s.methane_outlet = leaving[combustion::CH4] / moles;
        if (p.scene.physics.nitric_oxide) {
            // 46.0055 g/mol: emission limits count NO as NO2.  Oxygen of dry air: 21 %.
            const double fraction = p.shaft.outlet_mean(thermal_nitric_oxide_of(p.shaft)) / dry;
            const double normal_moles = 101325 / (combustion::gas_constant * 273.15);  // [mol/Nm^3]
            const double dilution = (0.21 - 0.11) / std::max(0.21 - *s.oxygen_dry_outlet, 1e-6);
            if (*s.oxygen_dry_outlet < 0.209) s.nitric_oxide_outlet = fraction * normal_moles * 46.0055e3 * dilution;
        }
    }
    if (p.couplings == 0) return s;

    s.peak_particle_temperature = recent_mean(p.past.peak, p.window());
    s.peak_height = recent_mean(p.past.peak_height, p.window());
    s.pressure_drop = recent_mean(p.past.pressure_drop, p.window());
    if (const double centre = recent_mean(p.past.centre, p.window()); !std::isnan(centre)) s.centre_temperature_at_peak = centre;
    s.steadying_leaps = p.leaps;
    s.steadying_leaps_halved = p.halved_leaps;
    s.steadying_held = static_cast<double>(p.held);
    if (p.halved_leaps > 0) {
        s.warnings.push_back(std::to_string(p.halved_leaps) + " leaps towards the steady state would have led beyond what can be steady, and were"
                             " halved or left out; a longer time.steadying_interval sees better where the bed goes");
    }
    const double cells_of_all = p.shaft.among().sum(static_cast<double>(p.shaft.grid().owned_cells()));
    const double allowed = p.couplings * (0.5e-6 * cells_of_all + 2e-6 * static_cast<double>(p.fields.temperature.size()));
    s.coupling_time_over_allowance = p.shaft.among().sum(p.seconds.voidage + p.seconds.transfer) / allowed;
    s.offgas_temperature = recent_mean(p.past.offgas, p.window());
    if (p.outlet_temperature() > 0) s.solids_outlet_temperature = p.outlet_temperature();
    s.wall_heat_loss = recent_mean(p.past.wall, p.window());
    s.enthalpy_imbalance = p.imbalance();
    s.enthalpy_audit = p.imbalance() - recent_mean(p.past.stored, p.window());
    s.gas_mass_imbalance = recent_mean(p.past.gas_missing, p.window());
    s.solid_mass_imbalance = recent_mean(p.past.solid_missing, p.past.solid_missing.size());
    s.element_imbalance = p.element_imbalance();
    s.product_share_above_2130_K = share_above(p.product_hottest, 2130);
    s.product_share_above_2320_K = share_above(p.product_hottest, 2320);
    s.median_time_above_2130_K = percentile(p.product_hot_seconds, 0.5);
    if (*s.maximum_temperature > 2327) {
        const auto tell = [&](const char* what, double temperature, std::int64_t cell, double z) {
            if (!(temperature > 2327)) return;
            std::ostringstream text;
            text << "hotter than the flame of cold gas, 2327 K: the hottest " << what << ", " << temperature << " K in cell " << cell << " at " << z
                 << " m; only gas that is hot before it burns makes it so";
            s.warnings.push_back(text.str());
        };
        struct hot_cell {
            double temperature, height;
            std::int64_t number, of_stone;
        };
        const gas::mesh& m = p.shaft.grid();
        const auto& t = p.shaft.solver.gas.temperature;
        const auto number = [&](int cell) { return cell < 0 ? std::int64_t{-1} : std::int64_t{mesh_traits<gas::mesh>::global_index(m, cell)}; };
        const auto c = static_cast<int>(std::max_element(t.begin(), t.begin() + m.owned_cells()) - t.begin());
        const dem::vector3& x = p.bed->spheres()[p.hottest_stone()].centre;
        const auto of_ranks = p.among.gather(std::vector<hot_cell>{{t[c], m.centre[c].z, number(c), number(m.find_cell({x.x, x.y, x.z}))}});
        hot_cell hottest = of_ranks.front();
        for (const hot_cell& here : of_ranks) {
            const std::int64_t of_stone = std::max(hottest.of_stone, here.of_stone);
            if (here.temperature > hottest.temperature) hottest = here;
            hottest.of_stone = of_stone;
        }
        tell("gas", hottest.temperature, hottest.number, hottest.height);
        tell("stone", now.peak_particle_temperature, hottest.of_stone, x.z);
    }
    if (const auto& chemistry = p.shaft.chemistry()) {
        struct unfinished {
            std::int64_t times, first;
            double height;
        };
        const gas::mesh& m = p.shaft.grid();
        const int c = std::max(0, static_cast<int>(chemistry->first_unfinished));
        std::int64_t times = 0;
        const unfinished* worst = nullptr;
        const auto of_ranks = p.among.gather(std::vector<unfinished>{{chemistry->unfinished, mesh_traits<gas::mesh>::global_index(m, c), m.centre[c].z}});
        for (const unfinished& here : of_ranks) {
            times += here.times;
            if (worst == nullptr || here.times > worst->times) worst = &here;
        }
        std::ostringstream text;
        text << "chemistry did not finish in a cell " << times << " times, first in cell " << worst->first << " at " << worst->height
             << " m; the gas there was left as it was";
        if (times > 0) s.warnings.push_back(text.str());
    }
    if (const std::string text = acceleration_warning(p.scene, p.scene.time.acceleration_factor); !text.empty()) s.warnings.push_back(text);
    if (const auto* driven = dynamic_cast<const driven_bed*>(p.bed.get())) {
        const double parcel = pi / 6 * std::pow(sizes_of(p.scene).largest(), 3) * p.scene.particles.density;
        std::ostringstream text;
        text << "the feed has found no room for " << driven->waiting()
             << " kg, and the bed has sunk by them; a smaller time.acceleration_factor feeds it slower";
        if (driven->waiting() > parcel + 0.01 * *s.bed_mass) s.warnings.push_back(text.str());
    }
    if (p.clamped > 0) s.warnings.push_back("closures were asked outside of the range they were fitted in, see clamped_evaluations");
    return s;
}

plan foresee(const settings& scene, int ranks) {
    check(scene);
    plan result;
    constexpr double pi = 3.14159265358979323846;
    const double height = scene.shaft.height, radius = 0.5 * scene.shaft.diameter, d = sauter_diameter(scene);
    const double solid = (1 - scene.bed.void_fraction) * pi * radius * radius * height;
    double stones_per_volume = 0;
    for (const size_class& size : scene.particles.sizes) stones_per_volume += size.mass_share / (pi / 6 * std::pow(size.diameter, 3));
    const double stone = scene.bed.packing == bed_packing::lattice ? pi / 6 * d * d * d : 1 / stones_per_volume;
    result.particles = static_cast<std::int64_t>(solid / stone);
    result.parcels = static_cast<std::int64_t>(solid / stone / std::pow(scene.bed.coarse_graining, 3));
    result.waiting = static_cast<std::int64_t>(static_cast<double>(result.parcels) * scene.shaft.hopper_fill / height);
    result.cells = cell_count_of(scene);
    result.couplings = scene.time.couplings;
    // Measured: 2.1 kB a cell, 2.2 kB a parcel, 1.7 kB for the neighbours that it radiates to and 1 kB for its recorded way,
    // 0.9 kB a parcel that waits; of each further rank 0.7 kB a cell and 0.6 kB a parcel;
    // 34 us a cell and 15 us a parcel in a coupling.
    const auto cells = static_cast<double>(result.cells), parcels = static_cast<double>(result.parcels);
    const double of_parcel = (scene.physics.radiation ? 3900 : 2200) + (scene.bed.motion == bed_motion::recorded ? 1050 : 0);
    result.memory = 5e7 + 2080 * cells + of_parcel * parcels + 870 * static_cast<double>(result.waiting) +
                    (ranks - 1) * (700 * cells + 600 * parcels);
    result.seconds = scene.time.couplings * (34e-6 * cells + 15e-6 * parcels);
    if (scene.bed.packing == bed_packing::dem) {
        const dem::material body{scene.bed.softened_modulus, scene.bed.poisson_ratio};
        const double step = 0.2 * dem::rayleigh_time(0.5 * d * scene.bed.coarse_graining, scene.particles.density, body);
        double time = std::sqrt(0.8 * height / 9.81) + 0.5;  // to fall and to rest
        if (scene.bed.motion == bed_motion::recorded) {
            const double speed = scene.particles.mass_flow * height / std::max(solid * scene.particles.density, 1e-300);
            time += (1.5 + scene.bed.recorded_diameters) * d * scene.bed.coarse_graining / (speed * scene.bed.recording_acceleration_factor);
        }
        if (scene.bed.motion == bed_motion::dem) {
            const double of_process = scene.time.residence_times * solid * scene.particles.density / scene.particles.mass_flow;
            const double acceleration = scene.time.acceleration_factor.automatic ? acceleration_of(scene, solve_shaft_profile(scene))
                                                                                 : scene.time.acceleration_factor.value;
            const double of_motion = of_process / (acceleration * std::sqrt(weight_of(scene)));
            result.motion_steps = of_motion / step / scene.time.couplings;
            time += of_motion;
        }
        result.seconds += 1e-7 * parcels * time / step;
    }
    const auto leaves = [&](bool out, const char* what, const char* because, const char* saves) {
        if (out) result.left_out.push_back({what, because, saves});
    };
    leaves(!scene.physics.radiation, "radiation", "physics.radiation", "nine tenths of the links between stones");
    leaves(!scene.physics.conduction, "conduction through contacts", "physics.conduction", "the list of contacts");
    leaves(scene.bed.packing != bed_packing::dem, "DEM", "bed.packing", "the fill phase");
    leaves(scene.bed.motion == bed_motion::plug, "shear of the bed, which sinks as a body", "bed.motion", "DEM while it sinks");
    leaves(scene.bed.motion == bed_motion::recorded, "motion beyond the stretch that is recorded", "bed.motion", "DEM after that stretch");
    leaves(scene.bed.motion == bed_motion::dem, "heat of the feed while it falls onto the bed, at Gamma 1", "bed.motion", "a clock for each parcel");
    leaves(scene.bed.motion == bed_motion::frozen, "motion of the bed", "bed.motion", "DEM after the filling");
    const burning how = scene.physics.combustion;
    leaves(how == burning::none, "combustion: the burners blow air", "physics.combustion", "all species");
    leaves(how == burning::mixed_is_burnt || how == burning::equilibrium, "finite-rate chemistry", "physics.combustion",
           "three of four transported species and their integration");
    leaves(how == burning::jones_lindstedt && scene.physics.mixing == gas_mixing::at_once, "the time in which gas mixes in the bed",
           "physics.mixing", "");
    leaves(true, "turbulence, in the free space above the bed", "this program", "two equations");
    leaves(!scene.physics.nitric_oxide, "thermal NO", "physics.nitric_oxide", "one sweep after the run");
    return result;
}

}  // namespace hearth::furnace
