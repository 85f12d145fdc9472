// SPDX-License-Identifier: MIT
#include "plates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gas_film.hpp>
#include <hearth/closure/wall_view.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/dem/thermal_bed.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>

#include "grains.hpp"
#include "rung_of.hpp"

namespace hearth::furnace::rungs {
namespace {

/// Air that rests in the bed, the same at every sphere.
struct resting_air {
    std::int32_t spheres;
    double void_fraction, conductivity;
};

}  // namespace
}  // namespace hearth::furnace::rungs

template <>
struct hearth::particle_traits<hearth::furnace::rungs::resting_air> {
    using index = std::int32_t;
    using scalar = double;
    using gas = hearth::furnace::rungs::resting_air;
    static index particle_count(const gas& g) { return g.spheres; }
    static scalar get(quantity::void_fraction, const gas& g, index) { return g.void_fraction; }
    static scalar get(quantity::gas_conductivity, const gas& g, index) { return g.conductivity; }
};

namespace hearth::furnace::rungs {
namespace {

constexpr int lower = 0, tube = 1, upper = 2;  // patches

/// Air as in Yagi and Kunii's paper, each 200 C from 0 C [W/(m K)].
double air_conductivity(double kelvin) {
    constexpr std::array<double, 7> table{.0211, .0338, .0447, .0534, .0602, .0655, .0696};  // [kcal/(m h C)]
    const double at = std::clamp((kelvin - 273.15) / 200, 0.0, 5.999);
    const auto k = static_cast<std::size_t>(at);
    return 1.163 * (table[k] + (at - static_cast<double>(k)) * (table[k + 1] - table[k]));
}

/// Their Eq. 15 for a resting gas, phi = 0.034 for void fractions near 0.40.
double yagi_kunii(const plates& s, double kelvin, double beta, double void_fraction) {
    const double gas = air_conductivity(kelvin), p = s.emissivity, e = void_fraction;
    const double black = 4 * constants<double>::stefan_boltzmann() * std::pow(kelvin, 3);
    const double surface = black * p / (2 - p), across = black / (1 + e / (2 * (1 - e)) * (1 - p) / p);
    return gas * (beta * (1 - e) / (gas / s.conductivity + 1 / (1 / 0.034 + s.diameter * surface / gas)) +
                  e * beta * s.diameter * across / gas);
}

/// The bed at rest between its plates.
struct packed {
    dem::bed spheres;
    double radius, height = 0, solid = 0;  ///< of the vessel [m]; solid fraction of the core [-]
    dem::zone core{};                      ///< farther than 2.5 diameters from all walls

    packed(const plates& s, const watcher& watch) : spheres(settings(s)), radius(s.radius_in_diameters * s.diameter) {
        const double d = s.diameter;
        const dem::bed_settings& of = spheres.settings();
        spheres.add_wall(wall_of(of, dem::shape::plane({0, 0, 0}, {0, 0, 1}), lower, 0));
        spheres.add_wall(wall_of(of, dem::shape::cylinder({0, 0, -1}, {0, 0, 10}, radius), tube, 0));
        dem::feed::settings from;
        from.where = {{0, 0, 0}, radius, s.height_in_diameters * d};
        from.density = s.density;
        from.seed = s.seed;
        from.velocity = {0, 0, -0.5};
        dem::feed(from, dem::size_distribution({{d, 1}})).fill(spheres);
        settle(spheres, 40000, [&](double share) { watch(0.4 * share, "the bed settles"); });
        double top = 0;
        for (dem::index i = 0; i < spheres.size(); ++i) top = std::max(top, spheres.spheres()[i].centre.z + d / 2);
        height = top + 0.01 * d;
        const int lid = spheres.add_wall(wall_of(of, dem::shape::plane({0, 0, height}, {0, 0, -1}), upper, 0));
        constexpr double pace = 0.05;  // [m/s]
        spheres.set_motion(lid, {{0, 0, -pace}, {}, {}});
        while (spheres.force_on_wall(lid).z < s.load * pi * radius * radius) {
            spheres.advance(50);
            height -= 50 * of.step * pace;
            watch(0.45, "the upper plate comes down");
        }
        spheres.set_motion(lid, {});
        settle(spheres, 10000, [&](double) { watch(0.5, "the bed settles"); });
        core = {{0, 0, 2.5 * d}, radius - 2.5 * d, height - 5 * d};
        solid = solid_fraction(spheres, core);
    }
    static dem::bed_settings settings(const plates& s) {
        dem::bed_settings of;
        of.body = {s.softened_modulus, s.poisson_ratio};
        of.step = 3e-5 * std::sqrt(1e8 / s.softened_modulus * s.density / 7870) * s.diameter / 0.011;
        of.contact.friction = s.friction;
        of.contact.damping = 0.5;
        return of;
    }
};

/// Effective conductivities [W/(m K)].
struct conductivities {
    double contact = 0, film = 0, radiation = 0;  ///< in the core, by what carries the heat
    double between_plates = 0;  ///< over the whole height, with the resistance at the plates, as the paper has it
    double seconds = 0;         ///< of the processor
    double core() const { return contact + film + radiation; }
};

/// All exchange between spheres and with the plates.  The terms are the scene's type: what is not named is not compiled.
auto links_of(packed& made, const plates& s, double kelvin, double cutoff) {
    dem::bed& b = made.spheres;
    dem::thermal_bed warm(b, {500, s.conductivity, s.emissivity});
    const resting_air air{b.size(), 1 - made.solid, air_conductivity(kelvin)};
    const double fitted = std::clamp(made.solid, 0.57, 0.64);  // where the view factors were computed
    contact_materials materials;
    materials.particle = materials.wall = {s.modulus, s.poisson_ratio};
    materials.wall_conductivity = s.conductivity;
    radiation_params rays;
    rays.solid_fraction = made.solid;
    rays.emissivity = s.emissivity;
    rays.cutoff = cutoff;
    rays.open_from = 1;  // plates close it
    const double true_over_soft = std::pow(s.softened_modulus / s.modulus, 2.0 / 3);
    const scene heated{conduction{closure::zhang::constriction{}, materials}, film_conduction{closure::gas_film{}, true_over_soft},
                       radiation{closure::feng_han::monte_carlo_fit{fitted}, rays, closure::wall_view::bed(fitted)}};
    auto links = heated.links(warm, warm, air);
    b.for_each_near_wall(1.0, [&](dem::index i, int w, double distance) {  // films at the plates, which the term leaves out
        const double r = b.spheres()[i].radius, gap = distance - r;
        const closure::film_pair<double> at_wall{gap < 0 ? gap * true_over_soft : gap, r, r, s.conductivity, s.conductivity, air.conductivity,
                                                 air.void_fraction};
        if (const double film = closure::gas_film::wall_conductance(at_wall); film > 0) {
            links.walls.push_back({i, b.wall_at(w).patch, {film, 0.0}});
        }
    });
    links.walls.erase(std::remove_if(links.walls.begin(), links.walls.end(), [](const auto& w) { return w.patch == tube; }), links.walls.end());
    return links;
}

/// The steady bed: steps of the implicit network that are longer than any time of the bed.  The conductivity of the core is
/// its mean flux, the sum of heat times way over the volume, over the mean gradient there.
conductivities conduct(packed& made, const plates& s, double kelvin, double cutoff) {
    const double began = cpu_seconds(), hot = kelvin + 0.5 * s.temperature_difference, cold = kelvin - 0.5 * s.temperature_difference;
    dem::bed& b = made.spheres;
    const auto links = links_of(made, s, kelvin, cutoff);
    const auto count = static_cast<std::size_t>(b.size());
    std::vector<double> temperature(count), mass(count);
    std::vector<heat_bath<double>> baths(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto k = static_cast<dem::index>(i);
        mass[i] = b.mass(k);
        temperature[i] = hot - s.temperature_difference * b.spheres()[k].centre.z / made.height;
    }
    for (const auto& w : links.walls) baths[static_cast<std::size_t>(w.particle)].add(w.link, w.patch == lower ? hot : cold);
    const constant_specific_heat<> caloric{500};
    thermal_network network;
    std::vector<particle_step<double>> taken;
    for (int pass = 0; pass < 3; ++pass) {
        network.advance(links.pairs, baths, mass, [&](std::size_t) -> const constant_specific_heat<>& { return caloric; }, unsplit{}, 1e8,
                        temperature, taken);
    }

    conductivities found;
    for (const auto& w : links.walls) {
        if (w.patch != lower) continue;
        found.between_plates += w.link.heat(temperature[static_cast<std::size_t>(w.particle)], hot) * made.height /
                                (s.temperature_difference * pi * made.radius * made.radius);
    }
    std::vector<char> inside(count);
    double n = 0, sz = 0, st = 0, szz = 0, szt = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const dem::vector3 x = b.spheres()[static_cast<dem::index>(i)].centre;
        inside[i] = std::hypot(x.x, x.y) < made.core.radius && std::abs(x.z - 0.5 * made.height) < 0.5 * made.core.height;
        if (inside[i]) n += 1, sz += x.z, st += temperature[i], szz += x.z * x.z, szt += x.z * temperature[i];
    }
    const double gradient = (n * szt - sz * st) / (n * szz - sz * sz);
    // Of what the spheres of the core fill: how many centres the core's border cuts off does not matter then.
    const double volume = n * pi / 6 * std::pow(s.diameter, 3) / made.solid;
    double* const parts[] = {&found.contact, &found.film, &found.radiation};
    std::size_t at = 0;
    for (const link_part& part : links.parts) {
        for (; at < part.pairs; ++at) {
            const auto& pair = links.pairs[at];
            const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
            const double way = b.spheres()[pair.first].centre.z - b.spheres()[pair.second].centre.z;
            *parts[part.term] += 0.5 * (inside[i] + inside[j]) * pair.link.heat(temperature[i], temperature[j]) * way / (-volume * gradient);
        }
    }
    found.seconds = cpu_seconds() - began;
    return found;
}

double sphere_count(const plates& s) { return 3.6 * s.radius_in_diameters * s.radius_in_diameters * s.height_in_diameters * 0.3; }

}  // namespace

void check(const plates& scene) {
    if (scene.softened_modulus > scene.modulus) {
        throw bad_scene("particles.softened_modulus_Pa is " + format(scene.softened_modulus) + ", allowed: at most particles.modulus_Pa, " +
                        format(scene.modulus));
    }
}

rung_plan foresee(const plates& scene) {
    rung_plan p;
    const double n = sphere_count(scene);
    p.builds = "about " + format(std::round(n / 100) * 100) + " spheres by DEM, their network of contacts, films and radiation at " +
               std::to_string(scene.temperatures.size()) + " temperatures";
    p.memory = 30e6 + 8e3 * n;
    p.seconds = n * (1.5e-3 + 1e-4 * static_cast<double>(scene.temperatures.size() + scene.cutoffs.size()));
    p.left_out = {{"gas flow, species, combustion", "the gas rests", "all cells"},
                  {"motion after settling", "the bed is at rest", "DEM during the heating"},
                  {"heating up", "only the steady state is asked for", "time steps"}};
    return p;
}

rung_result run(const plates& s, const watcher& watch) {
    const double began = cpu_seconds();
    packed made(s, watch);
    const double packing_seconds = cpu_seconds() - began;
    rung_result r;
    const double e = 1 - made.solid;
    curves over_temperature{"conductivity.csv", {{"temperature_K", s.temperatures}}};
    for (const char* name : {"contact_W_per_mK", "gas_film_W_per_mK", "radiation_W_per_mK", "core_W_per_mK", "between_plates_W_per_mK",
                             "yagi_kunii_0.9_W_per_mK", "yagi_kunii_W_per_mK"}) {
        over_temperature.columns.push_back({name, {}});
    }
    double worst = 0;
    const double all = static_cast<double>(s.temperatures.size() + s.cutoffs.size());
    double done = 0;
    for (const double kelvin : s.temperatures) {
        watch(0.5 + 0.5 * done++ / all, format(kelvin) + " K");
        const conductivities k = conduct(made, s, kelvin, s.cutoff);
        const double low = yagi_kunii(s, kelvin, 0.9, 0.4), high = yagi_kunii(s, kelvin, 1, 0.4);
        std::size_t column = 1;
        for (const double value : {k.contact, k.film, k.radiation, k.core(), k.between_plates, low, high}) {
            over_temperature.columns[column++].second.push_back(value);
        }
        worst = std::max(worst, std::abs(k.core() / high - 1));
        r.findings.push_back({"conductivity_" + format(kelvin) + "_W_per_mK", "effective conductivity at " + format(kelvin) + " K",
                              [&] {
                                  char text[40];
                                  std::snprintf(text, sizeof text, "%.2f to %.2f (Eq. 15)", low, high);
                                  return std::string(text);
                              }(),
                              k.core(), "W/(m K)", "%.3f"});
    }
    r.tables.push_back(over_temperature);

    curves over_cutoff{"over_cutoff.csv", {{"cutoff_in_diameters", {}}, {"time_s", {}}, {"error", {}}}};
    std::vector<double> cutoffs = s.cutoffs;
    std::sort(cutoffs.rbegin(), cutoffs.rend());
    double exact = 0;
    for (const double cutoff : cutoffs) {
        watch(0.5 + 0.5 * done++ / all, "radiation to " + format(cutoff) + " diameters");
        const conductivities k = conduct(made, s, 1000, cutoff);
        if (!(exact > 0)) exact = k.radiation;
        over_cutoff.columns[0].second.push_back(cutoff);
        over_cutoff.columns[1].second.push_back(k.seconds);
        over_cutoff.columns[2].second.push_back(k.radiation / exact - 1);
    }
    r.tables.push_back(over_cutoff);

    const auto& parts = over_temperature.columns;
    const std::size_t last = s.temperatures.size() - 1;
    r.findings.push_back({"largest_departure_percent", "largest departure from Eq. 15, beta = 1", "0", 100 * worst, "%"});
    r.findings.push_back({"radiation_share_first_percent", "share of radiation at " + format(s.temperatures.front()) + " K", "",
                          100 * parts[3].second.front() / parts[4].second.front(), "%"});
    r.findings.push_back({"radiation_share_last_percent", "share of radiation at " + format(s.temperatures.back()) + " K", "",
                          100 * parts[3].second[last] / parts[4].second[last], "%"});
    r.findings.push_back({"void_fraction", "void fraction of the core", "0.40", e, "-"});
    r.findings.push_back({"spheres", "spheres", "", static_cast<double>(made.spheres.size()), "-", "%.0f"});
    r.findings.push_back({"packing_time_s", "processor time of the packing", "", packing_seconds, "s"});
    if (made.solid < 0.57 || made.solid > 0.64) r.warnings.push_back("the view factors are for solid fractions of 0.57 to 0.64");
    watch(1, "done");
    return r;
}

}  // namespace hearth::furnace::rungs
