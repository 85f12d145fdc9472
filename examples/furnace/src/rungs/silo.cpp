// SPDX-License-Identifier: MIT
#include "silo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "grains.hpp"
#include "rung_of.hpp"

namespace hearth::furnace::rungs {
namespace {

constexpr int floor_wall = 0, tube_wall = 1;
constexpr double gravity = 9.81;

dem::bed_settings settings_of(const silo& s) {
    dem::bed_settings of;
    of.gravity = {0, 0, -gravity};
    of.body = {s.modulus, s.poisson_ratio};
    of.contact.friction = s.friction;
    of.contact.damping = dem::damping_of_restitution(s.restitution);
    of.step = 8e-5 * std::sqrt(3.77e7 / s.modulus) * s.smallest / 0.016;
    return of;
}

dem::feed feed_of(const silo& s, double bottom, double height, double flow) {
    dem::feed::settings f;
    f.where = {{0, 0, bottom}, 0.5 * s.diameter, height};
    f.density = s.density;
    f.mass_flow = flow;
    f.velocity = {0, 0, -1};
    f.seed = s.seed;
    using point = dem::size_distribution::point;
    return {f, dem::size_distribution(s.smallest < s.largest ? std::vector<point>{{s.smallest, 0}, {s.largest, 1}} : std::vector<point>{{s.largest, 1}})};
}

double mass_of(const dem::bed& b) {
    double sum = 0;
    for (dem::index i = 0; i < b.size(); ++i) sum += b.mass(i);
    return sum;
}

/// Janssen's length L from a stress = rho g L (1 - exp(-z/L)) under a head rho g z [m]; infinite where nothing is carried.
double janssen_length(double stress_over_head, double z) {
    double low = 1e-3 * z, high = 1e6 * z;  // (1 - exp(-z/L)) L/z rises with L
    for (int k = 0; k < 200; ++k) {
        const double middle = std::sqrt(low * high);
        (-std::expm1(-z / middle) * middle / z < stress_over_head ? low : high) = middle;
    }
    return low;
}

struct rings {
    std::array<double, 4> velocity{}, count{};
};

/// How fast what was there at the start has sunk, by rings of one width [m/s].
rings sunk(const dem::bed& b, const std::map<std::int64_t, dem::vector3>& before, double radius, double seconds) {
    rings r;
    for (dem::index i = 0; i < b.size(); ++i) {
        const auto at = before.find(b.ids()[i]);
        if (at == before.end()) continue;
        const auto ring = std::min<std::size_t>(3, static_cast<std::size_t>(4 * std::hypot(at->second.x, at->second.y) / radius));
        r.velocity[ring] += (at->second.z - b.spheres()[i].centre.z) / seconds;
        r.count[ring] += 1;
    }
    for (std::size_t k = 0; k < 4; ++k) r.velocity[k] = r.count[k] > 0 ? r.velocity[k] / r.count[k] : 0;
    return r;
}

double spheres_of(const silo& s) {
    const double d = 0.5 * (s.smallest + s.largest);
    return 0.58 * 1.5 * s.diameter * s.diameter * s.height / (d * d * d);
}

}  // namespace

void check(const silo& scene) {
    if (scene.largest < scene.smallest) {
        throw bad_scene("particles.largest_mm is " + format(scene.largest * 1e3) + ", allowed: at least particles.smallest_mm, " +
                        format(scene.smallest * 1e3));
    }
    if (scene.diameter < 5 * scene.largest) {
        throw bad_scene("silo.diameter_m is " + format(scene.diameter) + ", allowed: at least 5 diameters, " + format(5 * scene.largest));
    }
}

rung_plan foresee(const silo& scene) {
    rung_plan p;
    const double n = spheres_of(scene), step = settings_of(scene).step;
    p.builds = "about " + format(std::round(n / 100) * 100) + " spheres by DEM, " + format(scene.duration) + " s of feed and discharge";
    p.memory = 20e6 + 400 * n;
    p.seconds = n * ((scene.duration + 0.3 * scene.fillings * scene.height) / step + 5000 * scene.fillings) / 8e6;
    p.left_out = {{"gas, species, combustion", "kind = \"silo\" has no gas", "all cells"},
                  {"heat: the energy equation, radiation, conduction", "kind = \"silo\" is cold", "all links between particles"},
                  {"Time Scale Splitting", "the motion runs by its own clock", "nothing"}};
    return p;
}

rung_result run(const silo& s, const watcher& watch) {
    const dem::bed_settings of = settings_of(s);
    const double radius = 0.5 * s.diameter, area = pi * radius * radius;
    dem::bed b(of);
    b.add_wall(wall_of(of, dem::shape::plane({0, 0, 0}, {0, 0, 1}), 0, s.friction));
    b.add_wall(wall_of(of, dem::shape::cylinder({0, 0, -1}, {0, 0, 100}, radius), 1, s.friction));

    rung_result r;
    curves janssen{"janssen.csv", {{"level_m", {}}, {"head_Pa", {}}, {"floor_Pa", {}}, {"wall_share", {}}}};
    double balance = 0;
    for (int k = 1; k <= s.fillings; ++k) {
        const double level = s.height * k / s.fillings, share = 0.5 * (k - 1) / s.fillings;
        watch(share, "filled to " + format(level) + " m");
        dem::feed source = feed_of(s, level + 2 * s.largest, std::max(6 * s.largest, 0.5 * s.height / s.fillings), 0);
        dem::fill_to_level(b, source, {{0, 0, 0}, radius, level}, level, 200000);
        settle(b, 30000, [&](double) { watch(share + 0.3 / s.fillings, "settles at " + format(level) + " m"); });
        const double weight = mass_of(b) * gravity, on_floor = -b.force_on_wall(floor_wall).z, on_wall = -b.force_on_wall(tube_wall).z;
        balance = std::max(balance, std::abs((on_floor + on_wall) / weight - 1));
        janssen.columns[0].second.push_back(dem::surface_level(b, {{0, 0, 0}, radius, 1}));
        janssen.columns[1].second.push_back(weight / area);
        janssen.columns[2].second.push_back(on_floor / area);
        janssen.columns[3].second.push_back(on_wall / weight);
    }
    const double level = janssen.columns[0].second.back(), head = janssen.columns[1].second.back(), stress = janssen.columns[2].second.back();
    const double length = janssen_length(stress / head, level);
    curves law{"janssen_law.csv", {{"level_m", {}}, {"floor_Pa", {}}, {"head_Pa", {}}}};
    for (int k = 0; k <= 50; ++k) {
        const double z = level * k / 50;
        law.columns[0].second.push_back(z);
        law.columns[1].second.push_back(head / level * length * -std::expm1(-z / length));
        law.columns[2].second.push_back(head / level * z);
    }
    double off_law = 0;
    for (std::size_t k = 0; k + 1 < janssen.columns[0].second.size(); ++k) {
        const double z = janssen.columns[0].second[k];
        off_law = std::max(off_law, std::abs(janssen.columns[2].second[k] / (head / level * length * -std::expm1(-z / length)) - 1));
    }
    r.tables = {janssen, law};

    // Feed and discharge: the bed sinks past a quarter of its height before it is looked at, so that it has forgotten the fill.
    dem::feed source = feed_of(s, level + 1.5 * s.largest, 8 * s.largest, s.mass_flow);
    dem::outflow::settings out;
    out.floor = floor_wall;
    out.mass_flow = s.mass_flow;
    dem::outflow sink(out);
    const double filled = mass_of(b), began = b.time(), bulk = filled / (area * level);
    const double expected = s.mass_flow / (bulk * area);
    curves flow{"flow.csv", {{"time_s", {}}, {"held_kg", {}}, {"taken_kg", {}}, {"due_kg", {}}, {"level_m", {}}}};
    std::map<std::int64_t, dem::vector3> before;
    double looked_at = 0, worst_mass = 0, worst_due = 0;
    const int every = 50;
    const auto rounds = static_cast<long>(s.duration / (of.step * every));
    for (long k = 0; k < rounds; ++k) {
        source.update(b, every * of.step);
        sink.update(b, every * of.step);
        b.advance(every);
        const double time = b.time() - began;
        worst_mass = std::max(worst_mass, std::abs((sink.now().taken + sink.now().due) / (s.mass_flow * time) - 1));
        worst_due = std::max(worst_due, std::abs(sink.now().due));
        if (before.empty() && k >= rounds / 3) {
            looked_at = b.time();
            for (dem::index i = 0; i < b.size(); ++i) {
                const dem::vector3 x = b.spheres()[i].centre;
                if (x.z > 0.4 * level && x.z < 0.9 * level) before[b.ids()[i]] = x;
            }
        }
        if (k % std::max(1L, rounds / 100) != 0) continue;
        watch(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(rounds), format(std::round(10 * time) / 10) + " s of flow");
        flow.columns[0].second.push_back(time);
        flow.columns[1].second.push_back(mass_of(b));
        flow.columns[2].second.push_back(sink.now().taken);
        flow.columns[3].second.push_back(sink.now().due);
        flow.columns[4].second.push_back(dem::surface_level(b, {{0, 0, 0}, radius, 1}));
    }
    r.tables.push_back(flow);
    const rings sinking = sunk(b, before, radius, b.time() - looked_at);
    curves profile{"velocity.csv", {{"radius_m", {}}, {"velocity_m_per_s", {}}, {"plug_m_per_s", {}}}};
    double mean = 0, number = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        profile.columns[0].second.push_back((static_cast<double>(k) + 0.5) * radius / 4);
        profile.columns[1].second.push_back(sinking.velocity[k]);
        profile.columns[2].second.push_back(expected);
        mean += sinking.velocity[k] * sinking.count[k];
        number += sinking.count[k];
    }
    r.tables.push_back(profile);
    mean /= number;
    const double held = mass_of(b);

    r.findings = {
        {"floor_over_head", "floor's stress over the head of the filling", "", stress / head, "-"},
        {"janssen_coefficient", "Janssen's K from it, D/(4 mu L)", "0.3 to 1 (full friction)", s.friction > 0 ? s.diameter / (4 * s.friction * length) : 0, "-"},
        {"janssen_off_law_percent", "other levels off Janssen's law with it", "0", 100 * off_law, "%"},
        {"weight_imbalance_percent", "floor and wall off the weight", "0", 100 * balance, "%", "%.2g"},
        {"mass_imbalance_kg", "filled + fed - taken - held", "0", filled + source.now().brought - sink.now().taken - held, "kg", "%.1e"},
        {"flow_error", "taken and due over flow times time, less 1", "0", worst_mass, "-", "%.1e"},
        {"largest_due_kg", "most that was due and had not left", "", worst_due, "kg"},
        {"sinking_over_plug", "velocity of sinking over that of a plug", "1 (plug)", mean / expected, "-"},
        {"wall_over_centre", "  outermost ring over the innermost", "1 (plug)", sinking.velocity[3] / sinking.velocity[0], "-"},
        {"fed_over_flow", "fed over flow times time", "1", (source.now().brought + source.now().due) / (s.mass_flow * (b.time() - began)), "-"},
        {"bulk_density_kg_per_m3", "bulk density of the filling", "", bulk, "kg/m3"},
        {"spheres", "spheres", "", static_cast<double>(b.size()), "-", "%.0f"}};
    if (source.now().due > 0.05 * s.mass_flow) r.warnings.push_back("the feed has no room: " + format(source.now().due) + " kg are due (flow.mass_flow_kg_per_s)");
    watch(1, "done");
    return r;
}

}  // namespace hearth::furnace::rungs
