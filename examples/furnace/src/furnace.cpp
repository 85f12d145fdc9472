// SPDX-License-Identifier: MIT
#include <hearth/furnace/furnace.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "driven_bed.hpp"
#include "flat.hpp"
#include "parts.hpp"
#include "redistribution.hpp"

namespace hearth::furnace {

template <class Part>
void furnace::parts::each_part(Part&& part) {
    const auto under = [&](const char* folder) {
        return [&part, folder](const char* name, auto& value) { part(std::string(folder) + "/" + name, value); };
    };
    part("couplings", couplings);
    part("leaps", leaps);
    part("halved_leaps", halved_leaps);
    part("held", held);
    part("process_time", process_time);
    part("bed_mass", bed_mass);
    part("coarse_graining", coarse_graining);
    part("residence_time", residence_time);
    part("process_step", process_step);
    part("wall_loss", wall_loss);
    part("stranded", stranded);
    part("clamped", clamped);
    part("product_hottest", product_hottest);
    part("product_hot_seconds", product_hot_seconds);
    part("rings", rings.temperature());
    fields.each(under("stones"));
    past.each(under("past"));
    auto& g = shaft.solver.gas;
    const auto gas_part = under("gas");
    gas_part("temperature", g.temperature);
    gas_part("enthalpy", g.enthalpy);
    gas_part("mass_fraction", g.mass_fraction);
    gas_part("density", g.density);
    gas_part("viscosity", g.viscosity);
    gas_part("conductivity", g.conductivity);
    gas_part("specific_heat", g.specific_heat);
    gas_part("kinetic", g.kinetic);
    gas_part("dissipation", g.dissipation);
    gas_part("eddy_viscosity", g.eddy_viscosity);
    gas_part("pressure", g.flow.pressure);
    gas_part("velocity", g.flow.velocity);
    gas_part("mass_flux", g.flow.mass_flux);
    gas_part("pressure_gradient", g.flow.pressure_gradient);
    gas_part("void_fraction", shaft.solver.bed.void_fraction);
    gas_part("heat_conductance", shaft.solver.bed.heat_conductance);
    gas_part("heat_source", shaft.solver.bed.heat_source);
    shaft.solver.each_memory(gas_part);
    leap.each(under("leap"));
    seconds.each(under("seconds"));
}

namespace {

bool lies_on_ranks(const std::string& name) { return name.compare(0, 4, "gas/") == 0 || name == "filling/state" || name == "motion/state"; }

/// What every rank has of an array that lies on ranks: its length and its numbers, rank by rank.
redistribution::parts parts_of(const std::string& name, const std::vector<double>& saved, std::size_t ranks) {
    redistribution::parts found;
    for (std::size_t at = 0; at < saved.size();) {
        const auto rest = static_cast<double>(saved.size() - at - 1);
        if (!(saved[at] >= 0 && saved[at] <= rest)) break;
        const auto from = saved.begin() + static_cast<std::ptrdiff_t>(at + 1), to = from + static_cast<std::ptrdiff_t>(saved[at]);
        found.emplace_back(from, to);
        at += 1 + found.back().size();
    }
    if (found.size() != ranks) throw bad_scene("the state has " + std::to_string(found.size()) + " parts of " + name + ", expected: " + std::to_string(ranks));
    return found;
}

}  // namespace

/// What all ranks know, the first one saves.
saved_state furnace::parts::save() {
    saved_state saved;
    saved["ranks"] = {static_cast<double>(among.size())};
    saved["phase"] = {static_cast<double>(now)};
    saved["burner_flow"] = {shaft.burner_flow()};
    if (now == phase::fill) {
        fill->save(saved);
    } else {
        if (const auto* recorded = dynamic_cast<const dem::recorded_bed*>(bed.get())) {
            saved["bed/recording"] = to_numbers(recorded->record().bytes());
        } else if (const auto* driven = dynamic_cast<const driven_bed*>(bed.get())) {
            driven->save(saved);
        } else {
            saved["bed/spheres"] = to_flat(bed->spheres());
            saved["bed/masses"] = bed->masses();
        }
        saved["bed/state"] = to_numbers(bed->state());
        const timings own = std::exchange(seconds, slowest());
        each_part([&](const std::string& name, auto& value) {
            std::vector<double>& numbers = saved[name] = to_flat(value);
            if (lies_on_ranks(name)) numbers.insert(numbers.begin(), static_cast<double>(numbers.size()));
        });
        seconds = own;
    }
    for (auto& [name, numbers] : saved) {
        if (among.rank() > 0 && !lies_on_ranks(name)) numbers.clear();
    }
    return saved;
}

void furnace::parts::restore(const saved_state& saved) {
    const auto find = [&](const std::string& name) -> const std::vector<double>& {
        const auto found = saved.find(name);
        if (found == saved.end()) throw bad_scene("the state lacks " + name);
        return found->second;
    };
    const auto then = static_cast<phase>(find("phase").at(0));
    if (then == phase::fill) {
        if (!fill) throw bad_scene("the state is that of a bed being filled; this furnace has one");
        fill->restore(saved);
        return;
    }
    static_cast<void>(find("burner_flow"));
    const double before = find("ranks").at(0);
    std::optional<redistribution> elsewhere;
    if (before != among.size()) elsewhere.emplace(shaft.whole_grid(), static_cast<int>(before), among.size(), among.rank());
    std::map<std::string, std::vector<double>> of_gas;
    each_part([&](const std::string& name, auto& value) {
        if (!lies_on_ranks(name)) return static_cast<void>(find(name));
        const redistribution::parts all = parts_of(name, find(name), static_cast<std::size_t>(before));
        std::vector<double>& here = of_gas[name];
        if (!elsewhere) here = all[static_cast<std::size_t>(among.rank())];
        else if (name == "gas/mass_flux") here = elsewhere->of_faces(all);
        else if (name == "gas/wall_viscosity") here = elsewhere->of_boundary(all);
        else here = elsewhere->of_cells(all);
        const bool fits = flat_size(value) == 0 || here.size() == flat_size(value);
        if (among.any(!fits)) {
            throw bad_scene("the state has " + std::to_string(here.size()) + " numbers of " + name + ", expected: " + std::to_string(flat_size(value)));
        }
    });
    std::unique_ptr<dem::moving_bed> made;
    if (scene.bed.motion == bed_motion::recorded) {
        auto record = std::make_shared<const dem::recording>(dem::recording::read(to_bytes(find("bed/recording"))));
        made = std::make_unique<dem::recorded_bed>(std::move(record), surroundings_of(scene), scene.particles.mass_flow);
    } else if (scene.bed.motion == bed_motion::dem) {
        made = driven_bed::read(scene, among, saved);
    } else {
        std::vector<dem::sphere> spheres;
        from_flat(find("bed/spheres"), spheres);
        made = bed_of(scene, std::move(spheres), find("bed/masses"));
    }
    made->restore(to_bytes(find("bed/state")));
    use_bed(std::move(made));
    fill.reset();
    shaft.set_burners(find("burner_flow").at(0));
    place_bed();  // makes the map; what the gas had of the bed is in the state, from within the last step
    each_part([&](const std::string& name, auto& value) { from_flat(lies_on_ranks(name) ? of_gas.at(name) : find(name), value); });
    if (packed_by_dem()) fit_to_packing();
    now = then;
    if (now != phase::ignite) judge();
}

furnace::furnace(const settings& scene, const ranks& among) : parts_(std::make_unique<parts>(scene, among)) {}
furnace::~furnace() = default;
furnace::furnace(furnace&&) noexcept = default;

void furnace::step() {
    parts& p = *parts_;
    if (p.now == phase::report) return;
    const stopwatch all(p.seconds.all), of_phase(p.seconds.phases[static_cast<std::size_t>(p.now)]);
    switch (p.now) {
        case phase::fill: return p.fill_step();
        case phase::ignite: return p.ignite();
        default: return p.couple();
    }
}

phase furnace::current() const { return parts_->now; }
const settings& furnace::scene() const { return parts_->scene; }
int furnace::steps_done() const { return parts_->couplings; }
int furnace::steps_planned() const { return parts_->scene.time.couplings; }
const shaft_profile& furnace::profile() const { return parts_->profile; }
void furnace::set_burner_flow(double mass_flow) { parts_->shaft.set_burners(mass_flow); }
saved_state furnace::save() const { return parts_->save(); }
void furnace::restore(const saved_state& saved) {
    try {
        parts_->restore(saved);
    } catch (const dem::state_error& error) {
        throw bad_scene(error.what());
    }
}

}  // namespace hearth::furnace
