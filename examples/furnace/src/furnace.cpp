// SPDX-License-Identifier: MIT
#include <hearth/furnace/furnace.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/gas/generate.hpp>
#include <hearth/gas/mesh_traits.hpp>
#include <hearth/gas/solver.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/gas_exchange.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/time/tssm.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/radiation.hpp>
#include <hearth/voidage/transfer_operator.hpp>

#include "burnt_gas.hpp"
#include "flat.hpp"
#include "gas_at_particles.hpp"
#include "plug_bed.hpp"

namespace hearth::furnace {
namespace {

constexpr double pi = 3.14159265358979323846;

gas::mesh make_mesh(const settings& scene) {
    gas::shaft shape;
    const double radius = 0.5 * scene.shaft.diameter, height = scene.shaft.height;
    shape.profile = {{0, radius}, {height, radius}};
    shape.axial_size = {{0, scene.mesh.axial_size_bottom}, {std::min(0.8, 0.5 * height), scene.mesh.axial_size}};
    const double burners = scene.burners.height;
    if (scene.burners.count > 0 && burners > 1.2 && burners + 0.3 < height) {
        shape.axial_size.push_back({burners - 0.3, scene.mesh.axial_size});
        shape.axial_size.push_back({burners, scene.mesh.axial_size_burners});
        shape.axial_size.push_back({burners + 0.3, scene.mesh.axial_size});
    }
    shape.axial_size.push_back({height, scene.mesh.axial_size});
    shape.cross_size = scene.shaft.diameter / scene.mesh.across;
    return gas::mesh(gas::renumbered(gas::make(shape)));
}

/// Amounts [mol/kg] of air and of the burners' gas before it burns.
combustion::per_species air() {
    combustion::per_species parts{};
    parts[combustion::O2] = 0.21;
    parts[combustion::N2] = 0.79;
    return combustion::amounts_from_moles(parts);
}
combustion::per_species premix(double equivalence_ratio) {
    combustion::per_species parts{};
    parts[combustion::CH4] = equivalence_ratio;
    parts[combustion::O2] = 2;
    parts[combustion::N2] = 2 * 0.79 / 0.21;
    return combustion::amounts_from_moles(parts);
}

using gas_convection = convection<closure::gunn, parabolic_particle>;
using particle_radiation = radiation<closure::feng_han::monte_carlo_fit, closure::wall_view::bed>;

}  // namespace

struct furnace::parts {
    explicit parts(const settings& given)
        : scene(given),
          profile(solve_shaft_profile(scene)),
          bed(scene),
          mesh(make_mesh(scene)),
          graph(mesh),
          locator(mesh, graph),
          transfer(locator, {scene.voidage.width_in_diameters * 2 * bed.parcel_radius(), scene.voidage.threshold, 1e-5}),
          model(std::make_shared<burnt_gas>(air(), premix(scene.burners.equivalence_ratio))),
          gas(mesh, model, gas_settings()),
          clock(scene.time.acceleration_factor),
          exchange_scene(gas_convection(closure::gunn{}), make_radiation()),
          ring_temperature(std::max<std::size_t>(1, static_cast<std::size_t>(scene.shaft.height / 0.1)), 300.0) {
        refuse_what_a_column_is_not();
        if (!profile.converged) throw bad_scene("the one-dimensional solution of this scene did not converge");
        if (scene.time.acceleration_factor == 0) {
            throw bad_scene("time.acceleration_factor = \"auto\" is for beds that DEM moves; a plug flows at any");
        }
        const double bed_mass = bed.mass() * static_cast<double>(bed.size());
        residence_time = scene.particles.mass_flow > 0 ? bed_mass / scene.particles.mass_flow : 3600.0;
        process_step = scene.time.residence_times * residence_time / scene.time.couplings;
        set_boundaries();
        start();
    }

    /// A column has no DEM, no resolved burners and burns where it mixes; a scene that asks for more is told.
    void refuse_what_a_column_is_not() const {
        const auto need = [](bool holds, const char* what) {
            if (!holds) throw bad_scene(what);
        };
        need(scene.bed.motion == bed_motion::plug, "bed.motion: this furnace moves its bed as a \"plug\" only");
        need(scene.physics.combustion == burning::mixed_is_burnt, "physics.combustion: this furnace burns as \"mixed_is_burnt\" only");
        need(scene.voidage.method == voidage_method::filtered, "voidage.method: this furnace uses \"filtered\" only");
        need(scene.burners.equivalence_ratio <= 1, "burners.equivalence_ratio: this furnace burns at most 1");
    }

    gas::solver_settings gas_settings() const {
        gas::solver_settings s;
        s.reference_pressure = scene.gas.pressure;
        s.turbulence = false;
        return s;
    }

    particle_radiation make_radiation() const {
        radiation_params p;
        p.solid_fraction = 1 - scene.bed.void_fraction;
        p.emissivity = scene.particles.emissivity;
        p.open_from = 0.99;  // top and bottom of the plug look at the bed that feeds and follows it
        const double in_range = closure::wall_view::bed::solid_fraction_range().clamp(p.solid_fraction);
        return particle_radiation(closure::feng_han::monte_carlo_fit{}, p, closure::wall_view::bed(in_range));
    }

    void set_boundaries() {
        const double normal_density = 101325 / (combustion::gas_constant * 273.15 * combustion::sum(air()));
        air_flow = scene.air.volume_flow * normal_density;
        gas.set("bottom", gas::mass_flow_inlet(air_flow, {scene.air.temperature, {1, 0}}));
        gas.set("top", gas::pressure_outlet(scene.gas.pressure, {scene.air.temperature, {1, 0}}));
        set_burners(scene.burners.count > 0 ? scene.burners.mass_flow : 0.0);
    }

    /// The burners' gas goes into the wall cells around the circle, as a ring: a column does not resolve them.
    void set_burners(double mass_flow) {
        burner_flow = mass_flow;
        const combustion::per_species fuel = premix(scene.burners.equivalence_ratio);
        burner_enthalpy = combustion::combine(fuel).enthalpy(scene.burners.temperature);
        const double y[] = {0, 1};
        fuel_power = mass_flow * (combustion::combine(fuel).enthalpy(298.15) - combustion::combine(model->burnt(y)).enthalpy(298.15));
        const auto cells = static_cast<std::size_t>(mesh.cells());
        gas.sources.species.assign(2 * cells, 0.0);
        gas.sources.enthalpy.assign(cells, 0.0);
        gas.sources.force.assign(cells, {});
        if (!(mass_flow > 0)) return;
        std::vector<std::size_t> ring;
        double volume = 0;
        const double thick = std::max(scene.shaft.diameter / scene.mesh.across, scene.burners.diameter);
        for (std::size_t c = 0; c < cells; ++c) {
            const auto& x = mesh.centre[c];
            if (std::hypot(x.x, x.y) < 0.5 * scene.shaft.diameter - thick || std::abs(x.z - scene.burners.height) > 0.05) continue;
            ring.push_back(c);
            volume += mesh.volume[c];
        }
        if (ring.empty()) throw bad_scene("mesh: no cell of the wall lies within 0.05 m of the burners' height");
        for (const std::size_t c : ring) {
            const double share = mass_flow * mesh.volume[c] / volume;
            gas.sources.species[2 * c + 1] = share;
            gas.sources.enthalpy[c] = share * burner_enthalpy;
        }
    }

    /// Everything from the one-dimensional solution, or cold with hot gas around the burners.
    void start() {
        const bool cold = scene.time.start == start_from::cold;
        const auto at = [&](const std::vector<double>& values, double z) {
            const double k = std::clamp(z / scene.shaft.height * static_cast<double>(values.size()) - 0.5, 0.0,
                                        static_cast<double>(values.size() - 1));
            const auto low = static_cast<std::size_t>(k);
            const auto high = std::min(low + 1, values.size() - 1);
            return values[low] + (k - static_cast<double>(low)) * (values[high] - values[low]);
        };
        for (std::size_t i = 0; i < bed.size(); ++i) {
            bed.temperatures()[i] = cold ? scene.particles.feed_temperature : at(profile.particle_temperature, bed.positions()[i][2]);
        }
        gas.initialise(scene.air.temperature, {1, 0});
        const double burnt_share = burner_flow / std::max(burner_flow + air_flow, 1e-300);
        for (int c = 0; c < mesh.cells(); ++c) {
            const auto k = static_cast<std::size_t>(c);
            const double z = mesh.centre[k].z;
            const bool ignited = std::abs(z - scene.burners.height) < 0.3;
            const double t = cold ? (ignited ? scene.gas.ignition_temperature : scene.air.temperature) : at(profile.gas_temperature, z);
            const double share = z > scene.burners.height ? burnt_share : 0.0;
            gas.gas.mass_fraction[2 * k] = 1 - share;
            gas.gas.mass_fraction[2 * k + 1] = share;
            gas.gas.temperature[k] = t;
            gas.gas.enthalpy[k] = model->enthalpy(t, &gas.gas.mass_fraction[2 * k]);
        }
        gas.update_properties();
        place_bed();
        gas.level_zero();
        bed_enthalpy = bed.enthalpy();
    }

    void place_bed() {
        const clock_guard timing(coupling_seconds);
        std::vector<double> solid(static_cast<std::size_t>(mesh.cells()));
        transfer.distribute(parcels{bed}, solid);
        for (std::size_t c = 0; c < solid.size(); ++c) gas.bed.void_fraction[c] = 1 - solid[c];
        gas.bed.diameter.assign(solid.size(), 2 * bed.stone_radius());
        gas.bed.particle_velocity.assign(solid.size(), {0, 0, -bed.speed()});
    }

    /// Everything that a step takes from the one before: saving and restoring both walk this list.
    /// part(name, array of doubles, vectors or numbers; or a number)
    template <class Part>
    void each_part(Part&& part) {
        part("steps", steps);
        part("burner_flow", burner_flow);
        part("bed/position", bed.positions());
        part("bed/temperature", bed.temperatures());
        part("bed/enthalpy", bed_enthalpy);
        part("bed/stored", stored);
        part("bed/storage", storage);
        part("bed/passed_mass", passed.mass);
        part("bed/passed_enthalpy", passed.enthalpy_out);
        part("bed/outlet_temperature", passed.outlet_temperature);
        part("wall/ring_temperature", ring_temperature);
        part("wall/loss", wall_loss);
        part("gas/temperature", gas.gas.temperature);
        part("gas/enthalpy", gas.gas.enthalpy);
        part("gas/mass_fraction", gas.gas.mass_fraction);
        part("gas/density", gas.gas.density);
        part("gas/viscosity", gas.gas.viscosity);
        part("gas/conductivity", gas.gas.conductivity);
        part("gas/specific_heat", gas.gas.specific_heat);
        part("gas/kinetic", gas.gas.kinetic);
        part("gas/dissipation", gas.gas.dissipation);
        part("gas/eddy_viscosity", gas.gas.eddy_viscosity);
        part("gas/pressure", gas.gas.flow.pressure);
        part("gas/velocity", gas.gas.flow.velocity);
        part("gas/mass_flux", gas.gas.flow.mass_flux);
        part("gas/pressure_gradient", gas.gas.flow.pressure_gradient);
        part("gas/enthalpy_in", gas_report.enthalpy.in);
        part("gas/enthalpy_out", gas_report.enthalpy.out);
        gas.each_memory([&](const char* name, auto& value) { part(std::string("gas/") + name, value); });
        part("seconds", seconds);
        part("coupling_seconds", coupling_seconds);
    }

    void restore(const saved_state& saved) {
        const auto find = [&](const std::string& name, std::size_t size) -> const std::vector<double>& {
            const auto found = saved.find(name);
            if (found == saved.end()) throw bad_scene("the state lacks " + name);
            if (size != 0 && found->second.size() != size) {
                throw bad_scene("the state has " + std::to_string(found->second.size()) + " numbers of " + name + ", expected: " +
                                std::to_string(size));
            }
            return found->second;
        };
        each_part([&](const std::string& name, auto& value) { find(name, flat_size(value)); });
        const double flow = burner_flow;
        each_part([&](const std::string& name, auto& value) { from_flat(find(name, 0), value); });
        if (burner_flow != flow) set_burners(burner_flow);
        const double spent = coupling_seconds;
        place_bed();
        coupling_seconds = spent;
    }

    void step() {
        const auto begin = std::chrono::steady_clock::now();
        gas.forget_levels();  // so that a step depends on what each_part lists alone
        passed = bed.sink(process_step);
        place_bed();
        const double model_step = process_step / clock.factor(0);
        const auto caloric_of = [](std::size_t) { return spinel{}; };
        const std::vector<double> mass(bed.size(), bed.mass());
        std::vector<particle_step<double>> taken;

        gather_gas();
        std::vector<double> conductance;
        exchange_scene.gas_conductances(stones{bed, scene.time.acceleration_factor}, seen, conductance, clock);
        for (double& k : conductance) k *= bed.stones_per_parcel();
        std::vector<double> guess = seen.temperature;
        for (int pass = 0; pass < 4; ++pass) {
            exchange.prepare(conductance, guess, mass, caloric_of, clock, model_step, bed.temperatures());
            scatter(exchange.coefficient(), gas.bed.heat_conductance);
            scatter(exchange.source(), gas.bed.heat_source);
            for (int inner = 0; inner < (pass == 0 ? 6 : 3); ++inner) gas_report = gas.iterate();
            {
                const clock_guard timing(coupling_seconds);
                transfer.gather(gas.gas.temperature, guess);
            }
            if (exchange.overshoots(guess, mass, caloric_of, clock, bed.temperatures()) == 0) break;
        }
        exchange.finish(guess, mass, caloric_of, clock, bed.temperatures(), taken);
        radiate(mass, caloric_of, model_step);

        const double now = bed.enthalpy();
        stored = (now - bed_enthalpy + passed.enthalpy_out) / process_step;
        storage = (now - bed_enthalpy) / process_step;
        bed_enthalpy = now;
        ++steps;
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

    /// Radiation between parcels and with the wall, whose rings pass on what they get to the ambient.
    template <class CaloricOf>
    void radiate(const std::vector<double>& mass, const CaloricOf& caloric_of, double model_step) {
        wall_loss = 0;
        if (!scene.physics.radiation) return;
        const bed_neighbours neighbours{bed, ring_temperature};
        auto links = exchange_scene.links(parcels{bed}, neighbours, seen);
        // Parcels of k stones' width see each other through k times fewer layers than the stones that they stand for.
        for (auto& pair : links.pairs) pair.link.radiation /= bed.coarse_graining();
        std::vector<double> through(ring_temperature.size(), 0.0), pull(ring_temperature.size(), 0.0);
        for (const auto& wall : links.walls) {
            const auto ring = static_cast<std::size_t>(wall.patch);
            const double t = bed.temperatures()[static_cast<std::size_t>(wall.particle)];
            const double h = wall.link.secant(t, ring_temperature[ring]);
            through[ring] += h;
            pull[ring] += h * t;
        }
        const double area = pi * scene.shaft.diameter * scene.shaft.height / static_cast<double>(ring_temperature.size());
        std::vector<double> outside(ring_temperature.size(), 0.0), ambient(ring_temperature.size(), 320.0);
        for (std::size_t r = 0; r < ring_temperature.size(); ++r) {
            const double z = (static_cast<double>(r) + 0.5) * scene.shaft.height / static_cast<double>(ring_temperature.size());
            for (const wall_zone& zone : scene.shaft.zones) {
                if (z < zone.from || z >= zone.to) continue;
                outside[r] = zone.transmittance * area;
                ambient[r] = zone.ambient_temperature;
            }
            if (through[r] + outside[r] > 0) {
                ring_temperature[r] = (pull[r] + outside[r] * ambient[r]) / (through[r] + outside[r]);
            }
        }
        std::vector<heat_bath<double>> baths(bed.size());
        for (const auto& wall : links.walls) {
            baths[static_cast<std::size_t>(wall.particle)].add(wall.link, ring_temperature[static_cast<std::size_t>(wall.patch)]);
        }
        std::vector<particle_step<double>> taken;
        network.advance(links.pairs, baths, mass, caloric_of, clock, model_step, bed.temperatures(), taken);
        for (const auto& particle : taken) wall_loss -= (particle.conducted + particle.radiated) / process_step;
    }

    void gather_gas() {
        const clock_guard timing(coupling_seconds);
        seen.gather(gas, transfer, bed.size());
    }

    void scatter(const std::vector<double>& particles, std::vector<double>& cells) {
        const clock_guard timing(coupling_seconds);
        cells.resize(static_cast<std::size_t>(mesh.cells()));
        transfer.scatter(particles, cells);
    }

    /// Adds the time of a block to a sum.
    class clock_guard {
      public:
        explicit clock_guard(double& sum) : sum_(sum), begin_(std::chrono::steady_clock::now()) {}
        ~clock_guard() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
        clock_guard(const clock_guard&) = delete;
        clock_guard& operator=(const clock_guard&) = delete;

      private:
        double& sum_;
        std::chrono::steady_clock::time_point begin_;
    };

    settings scene;
    shaft_profile profile;
    plug_bed bed;
    gas::mesh mesh;
    cell_graph<> graph;
    cell_locator<gas::mesh> locator;
    transfer_operator<gas::mesh> transfer;
    std::shared_ptr<burnt_gas> model;
    gas::solver gas;
    tssm clock;
    hearth::scene<gas_convection, particle_radiation> exchange_scene;
    gas_exchange exchange;
    thermal_network network;
    gas_at_particles seen;
    std::vector<double> ring_temperature;  // [K]
    gas::report gas_report;
    plug_bed::passage passed;
    double residence_time = 0, process_step = 0, air_flow = 0, burner_flow = 0, burner_enthalpy = 0, fuel_power = 0;
    double bed_enthalpy = 0, stored = 0, storage = 0, wall_loss = 0, seconds = 0, coupling_seconds = 0;
    int steps = 0;
};

furnace::furnace(const settings& scene) : parts_(std::make_unique<parts>(scene)) {}
furnace::~furnace() = default;
furnace::furnace(furnace&&) noexcept = default;

void furnace::step() { parts_->step(); }
phase furnace::current() const { return parts_->steps < parts_->scene.time.couplings ? phase::couple : phase::report; }
const settings& furnace::scene() const { return parts_->scene; }
int furnace::steps_done() const { return parts_->steps; }
int furnace::steps_planned() const { return parts_->scene.time.couplings; }
const shaft_profile& furnace::profile() const { return parts_->profile; }
void furnace::set_burner_flow(double mass_flow) { parts_->set_burners(mass_flow); }

saved_state furnace::save() const {
    saved_state saved;
    parts_->each_part([&](const std::string& name, auto& value) { saved[name] = to_flat(value); });
    return saved;
}

void furnace::restore(const saved_state& saved) { parts_->restore(saved); }

status furnace::now() const {
    const parts& p = *parts_;
    status s;
    s.now = current();
    s.couplings = p.steps;
    s.share_done = s.share_of_run = static_cast<double>(p.steps) / p.scene.time.couplings;
    s.process_time = p.process_step * p.steps;
    const auto& t = p.bed.temperatures();
    const auto peak = std::max_element(t.begin(), t.end());
    s.peak_particle_temperature = *peak;
    s.peak_height = p.bed.positions()[static_cast<std::size_t>(peak - t.begin())][2];
    s.maximum_gas_temperature = *std::max_element(p.gas.gas.temperature.begin(), p.gas.gas.temperature.end());
    s.offgas_temperature = p.gas.mean_temperature("top");
    s.solids_outlet_temperature = p.passed.outlet_temperature;
    s.pressure_drop = p.gas.mean_pressure("bottom") - p.scene.gas.pressure;
    double voids = 0, volume = 0;
    for (int c = 0; c < p.mesh.cells(); ++c) {
        voids += p.gas.bed.void_fraction[static_cast<std::size_t>(c)] * p.mesh.volume[static_cast<std::size_t>(c)];
        volume += p.mesh.volume[static_cast<std::size_t>(c)];
    }
    s.mean_void_fraction = voids / volume;
    s.fuel_power = p.fuel_power;
    s.wall_heat_loss = p.wall_loss;
    s.gas_enthalpy_out = p.gas_report.enthalpy.out - p.gas_report.enthalpy.in - p.burner_flow * p.burner_enthalpy;
    s.particle_enthalpy_gain = p.storage;
    s.solids_enthalpy_out = p.stored - p.storage;
    s.enthalpy_imbalance = -(s.gas_enthalpy_out + p.stored + s.wall_heat_loss);
    s.coupling_share = p.seconds > 0 ? p.coupling_seconds / p.seconds : 0;
    return s;
}

snapshot furnace::look() const {
    const parts& p = *parts_;
    snapshot s;
    s.process_time = p.process_step * p.steps;
    s.particle_position = p.bed.positions();
    s.particle_temperature = p.bed.temperatures();
    for (const auto& x : p.mesh.centre) s.cell_centre.push_back({x.x, x.y, x.z});
    s.void_fraction = p.gas.bed.void_fraction;
    s.gas_temperature = p.gas.gas.temperature;
    for (int c = 0; c < p.mesh.cells(); ++c) s.pressure.push_back(p.gas.absolute_pressure(c));
    return s;
}

}  // namespace hearth::furnace
