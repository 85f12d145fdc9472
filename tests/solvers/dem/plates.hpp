// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/grey_exchange.hpp>
#include <hearth/closure/hertz.hpp>
#include <hearth/closure/wall_view.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/dem/feed.hpp>
#include <hearth/dem/thermal_bed.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>

#include "solvers/dem/packed.hpp"
#include "support/warm_bed.hpp"

/// The bed of Yagi and Kunii 1957 (doi:10.1002/aic.690030317, Table 4): iron spheres of 11 mm, void fraction 0.40, in air.
namespace hearth_test {

namespace iron {
constexpr double diameter = 0.011, density = 7870, youngs_modulus = 2.0e11, poisson_ratio = 0.29;
constexpr double conductivity = 45 * 1.163;  ///< as in their table [W/(m K)]

/// Air as in their paper [W/(m K)].
inline double gas_conductivity(double kelvin) {
    constexpr std::array<double, 7> table{.0211, .0338, .0447, .0534, .0602, .0655, .0696};  // each 200 C from 0 C
    const double at = std::clamp((kelvin - 273.15) / 200, 0.0, 5.999);
    const auto k = static_cast<std::size_t>(at);
    return 1.163 * (table[k] + (at - static_cast<double>(k)) * (table[k + 1] - table[k]));
}

/// Their Eq. 15 for a resting gas: k_e/k_g = beta (1 - e) / (k_g/k_s + 1/(1/phi + D h_rs/k_g)) + e beta D h_rv/k_g with
/// phi = 0.034, e = 0.40.  emissivity: p of the paper.
inline double yagi_kunii(double kelvin, double beta, double emissivity, double void_fraction = 0.40) {
    const double gas = gas_conductivity(kelvin), cube = 0.1952 * 1.163 * std::pow(kelvin / 100, 3);
    const double surface = cube * emissivity / (2 - emissivity);
    const double across_void = cube / (1 + void_fraction * (1 - emissivity) / (2 * (1 - void_fraction) * emissivity));
    return gas * (beta * (1 - void_fraction) / (gas / conductivity + 1 / (1 / 0.034 + diameter * surface / gas)) +
                  void_fraction * beta * diameter * across_void / gas);
}
}  // namespace iron

/// A bed that was poured onto a plate, between smooth sides, and has a second plate pressed on top.  Plates are the patches
/// 0 and 2.  Spheres may be parcels of k.
struct plate_bed {
    bed spheres;
    int parcel_factor;
    double radius = 0;  ///< of the tube [m]
    double height = 0;  ///< between the plates [m]
    zone core{};        ///< what is farther than 2.5 diameters from all walls; of a smaller bed the middle
    double solid = 0;   ///< fraction of the core [-]

    plate_bed(int factor, double radius, double column, double friction, double gravity = 9.81)
        : plate_bed(factor, radius, column, settings(factor, friction, gravity)) {}
    /// As much as there is room for in a column, but no more than a mass [kg].
    plate_bed(int factor, double radius_, double column, const bed_settings& s, double most = 1e300)
        : spheres(s), parcel_factor(factor), radius(radius_) {
        const double d = factor * iron::diameter;
        stand_in_tube();
        feed_into({{0, 0, 0}, radius, column}, iron::density, d, d).fill(spheres);
        std::vector<std::int32_t> spare;
        for (hearth::dem::index i = 0; i < spheres.size(); ++i)
            if (static_cast<double>(spheres.ids()[i] + 1) * spheres.mass(i) > most) spare.push_back(i);
        if (!spare.empty()) spheres.remove(spare);
        settle(spheres, 60000);
        double top = 0;
        for (hearth::dem::index i = 0; i < spheres.size(); ++i) top = std::fmax(top, spheres.spheres()[i].centre.z + d / 2);
        const int lid = add_lid(top + 0.01 * d);
        const double pace = 0.05 * factor;  // [m/s]
        const double pressed = 1000 * hearth::constants<double>::pi() * radius * radius;  // by 1 kPa
        spheres.set_motion(lid, {{0, 0, -pace}, {}, {}});
        height = top + 0.01 * d;
        while (spheres.force_on_wall(lid).z < pressed) {
            spheres.advance(50);
            height -= 50 * spheres.settings().step * pace;
        }
        spheres.set_motion(lid, {});
        settle(spheres, 20000);
        const double aside = std::fmin(2.5 * d, 0.5 * radius), above = std::fmin(2.5 * d, 0.3 * height);
        core = {{0, 0, above}, radius - aside, height - 2 * above};
        solid = solid_fraction(spheres, core);
    }

    /// A bed of grains made k times as large, of parcels under gravity less by k: dynamically similar, with the same speeds,
    /// stresses and overlaps over diameters.
    plate_bed(const plate_bed& grains, int k)
        : spheres(settings(k, grains.spheres.settings().contact.friction, -grains.spheres.settings().gravity.z / k)),
          parcel_factor(k), radius(k * grains.radius), height(k * grains.height),
          core{double(k) * grains.core.base, k * grains.core.radius, k * grains.core.height}, solid(grains.solid) {
        stand_in_tube();
        add_lid(height);
        std::vector<hearth::dem::particle> parcels(static_cast<std::size_t>(grains.spheres.size()));
        for (hearth::dem::index i = 0; i < grains.spheres.size(); ++i) {
            hearth::dem::particle& p = parcels[static_cast<std::size_t>(i)];
            p.position = double(k) * grains.spheres.spheres()[i].centre;
            p.radius = k * grains.spheres.spheres()[i].radius;
            p.density = iron::density;
        }
        spheres.insert(parcels);
    }

    static bed_settings settings(int factor, double friction, double gravity) {
        bed_settings s;
        s.gravity = {0, 0, -gravity};
        s.body = {1.0e8, iron::poisson_ratio};
        s.step = 3e-5 * factor;
        s.contact.friction = friction;
        s.contact.damping = 0.5;
        return s;
    }

  private:
    int add_smooth(std::vector<hearth::dem::facet> facets, int patch) {
        bed_settings smooth = spheres.settings();
        smooth.contact.friction = 0;
        return spheres.add_wall(wall_of(smooth, std::move(facets), patch));
    }
    void stand_in_tube() {
        add_smooth(hearth::dem::shape::plane({0, 0, 0}, {0, 0, 1}), 0);
        add_smooth(hearth::dem::shape::cylinder({0, 0, -1}, {0, 0, 10}, radius), 1);
    }
    int add_lid(double level) { return add_smooth(hearth::dem::shape::plane({0, 0, level}, {0, 0, -1}), 2); }
};

/// Effective conductivity of the core, and the parts of contacts, gas films and radiation in it [W/(m K)].
struct conductivity_parts {
    double contact = 0, film = 0, radiation = 0;
    double between_plates = 0;  ///< heat from plate to plate over the whole height: with the resistance at the plates
    double core() const { return contact + film + radiation; }
};

enum class heat_paths { all, radiation };

/// A plate sees nothing but the bed, however few spheres touch it: its exchange areas add up to its own.
template <class Links>
void close_view(const plate_bed& made, int plate, double emissivity, Links& links) {
    double seen = 0;
    for (const auto& w : links.walls) seen += w.patch == plate ? w.link.radiation : 0.0;
    const double whole = hearth::constants<double>::stefan_boltzmann() * hearth::closure::grey_exchange::bed_factor(emissivity) *
                         hearth::constants<double>::pi() * made.radius * made.radius;
    for (auto& w : links.walls)
        if (w.patch == plate) w.link.radiation *= whole / seen;
}

/// Contacts, films and radiation between particles and to the plates, for gas at `kelvin`; the tube is insulated.
inline auto heat_links(plate_bed& made, double kelvin, double emissivity, double cutoff, heat_paths paths) {
    using namespace hearth;
    namespace dem = hearth::dem;
    bed& b = made.spheres;
    dem::thermal_bed warm(b, {500, iron::conductivity, emissivity}, made.parcel_factor);
    gas_samples gas(static_cast<std::size_t>(b.size()));
    std::fill(gas.conductivity.begin(), gas.conductivity.end(), iron::gas_conductivity(kelvin));
    std::fill(gas.void_fraction.begin(), gas.void_fraction.end(), 1 - made.solid);

    contact_materials materials;
    materials.particle = materials.wall = {iron::youngs_modulus, iron::poisson_ratio};
    materials.wall_conductivity = iron::conductivity;
    radiation_params p;
    p.solid_fraction = made.solid;
    p.emissivity = emissivity;
    p.cutoff = cutoff;
    p.open_from = 1;  // closed by plates
    const double fitted = std::clamp(made.solid, 0.57, 0.64);
    const double true_over_soft = std::pow(b.settings().body.youngs_modulus / iron::youngs_modulus, 2.0 / 3.0);
    const scene heated{conduction{closure::zhang::constriction{}, materials},
                       film_conduction{closure::gas_film{}, true_over_soft},
                       hearth::radiation{closure::feng_han::monte_carlo_fit{fitted}, p, closure::wall_view::bed(fitted)}};
    auto links = heated.links(warm, warm, gas);
    b.for_each_near_wall(1.0, [&](dem::index i, int w, double distance) {  // films at walls, which the term leaves out
        const double r = b.spheres()[i].radius, gap = distance - r;
        const double film = closure::gas_film::wall_conductance(closure::film_pair<double>{
            gap < 0 ? gap * true_over_soft : gap, r, r, iron::conductivity, iron::conductivity,
            iron::gas_conductivity(kelvin), 1 - made.solid});
        if (film > 0) links.walls.push_back({i, b.wall_at(w).patch, {film, 0.0}});
    });
    for (const int plate : {0, 2}) close_view(made, plate, emissivity, links);
    dem::scale_parcels(links, made.parcel_factor);
    if (paths == heat_paths::radiation) {
        for (auto& pair : links.pairs) pair.link.conductance = 0;
        for (auto& w : links.walls) w.link.conductance = 0;
    }
    links.walls.erase(std::remove_if(links.walls.begin(), links.walls.end(), [](const auto& w) { return w.patch == 1; }),
                      links.walls.end());
    return links;
}

/// Advances the temperatures of the bed with its plates as they are.
template <class Links>
void heat(const plate_bed& made, const Links& links, double seconds, std::vector<double>& temperature) {
    const auto n = static_cast<std::size_t>(made.spheres.size());
    std::vector<double> mass(n);
    std::vector<hearth::heat_bath<double>> baths(n);
    for (std::size_t i = 0; i < n; ++i) mass[i] = made.spheres.mass(static_cast<hearth::dem::index>(i));
    for (const auto& w : links.walls)
        baths[static_cast<std::size_t>(w.particle)].add(w.link, made.spheres.patch_temperature(w.patch));
    const hearth::constant_specific_heat<> cp{500};
    hearth::thermal_network network;
    std::vector<hearth::particle_step<double>> taken;
    network.advance(links.pairs, baths, mass, [&](std::size_t) -> const hearth::constant_specific_heat<>& { return cp; },
                    hearth::tssm(1.0), seconds, temperature, taken);
}

/// Plates at 10 K above and below a temperature, steady: steps of the implicit network that are longer than any time of the
/// bed.  The conductivity is the mean flux in the core, sum of heat times way over volume, over the mean gradient there.
inline conductivity_parts conductivity_between_plates(plate_bed& made, double kelvin, double emissivity, double cutoff = 2.5,
                                                      heat_paths paths = heat_paths::all) {
    bed& b = made.spheres;
    b.set_patch_temperature(0, kelvin + 10);
    b.set_patch_temperature(2, kelvin - 10);
    const auto links = heat_links(made, kelvin, emissivity, cutoff, paths);
    std::vector<double> temperature;
    for (hearth::dem::index i = 0; i < b.size(); ++i)
        temperature.push_back(kelvin + 10 - 20 * b.spheres()[i].centre.z / made.height);
    for (int pass = 0; pass < 3; ++pass) heat(made, links, 1e8, temperature);

    const double pi = hearth::constants<double>::pi(), d = made.parcel_factor * iron::diameter;
    conductivity_parts found;
    for (const auto& w : links.walls) {
        if (w.patch != 0) continue;
        found.between_plates += w.link.heat(temperature[static_cast<std::size_t>(w.particle)], kelvin + 10) * made.height /
                                (20 * pi * made.radius * made.radius);
    }
    double sz = 0, st = 0, szz = 0, szt = 0, count = 0;
    const auto inside = [&](std::int32_t i) {
        const vector3 x = b.spheres()[i].centre - made.core.base;
        return std::hypot(x.x, x.y) < made.core.radius && x.z > 0 && x.z < made.core.height ? 1.0 : 0.0;
    };
    for (std::int32_t i = 0; i < b.size(); ++i) {
        const double z = b.spheres()[i].centre.z, t = temperature[static_cast<std::size_t>(i)];
        if (inside(i) > 0) sz += z, st += t, szz += z * z, szt += z * t, count += 1;
    }
    const double gradient = (count * szt - sz * st) / (count * szz - sz * sz);
    // Of what the spheres of the core fill: how many centres the core's border cuts off does not matter then.
    const double volume = count * pi / 6 * d * d * d / made.solid;
    std::size_t at = 0;
    double* const part_of[] = {&found.contact, &found.film, &found.radiation};
    for (const hearth::link_part& part : links.parts) {
        for (; at < part.pairs; ++at) {
            const auto& pair = links.pairs[at];
            const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
            const double way = b.spheres()[i].centre.z - b.spheres()[j].centre.z;
            const double into_i = pair.link.heat(temperature[i], temperature[j]);
            *part_of[part.term] += 0.5 * (inside(pair.first) + inside(pair.second)) * into_i * way / (-volume * gradient);
        }
    }
    return found;
}

/// Times in which a cold bed on a hot plate, insulated elsewhere, gets a twentieth and a tenth of the way to its temperature,
/// in implicit steps of so many seconds.
inline std::vector<double> heating_times(plate_bed& made, double cold, double hot, double step) {
    bed& b = made.spheres;
    b.set_patch_temperature(0, hot);
    auto links = heat_links(made, 0.5 * (cold + hot), 0.95, 2.5, heat_paths::all);
    links.walls.erase(std::remove_if(links.walls.begin(), links.walls.end(), [](const auto& w) { return w.patch != 0; }),
                      links.walls.end());
    std::vector<double> temperature(static_cast<std::size_t>(b.size()), cold), times;
    double before = cold, time = 0;
    while (times.size() < 2) {
        heat(made, links, step, temperature);
        double mean = 0;
        for (const double t : temperature) mean += t / static_cast<double>(temperature.size());  // of equal masses
        const double wanted = cold + (hot - cold) * (times.empty() ? 0.05 : 0.1);
        if (mean >= wanted) times.push_back(time + step * (wanted - before) / (mean - before));
        before = mean;
        time += step;
    }
    return times;
}

/// Times in which the upper half of an insulated bed, cold above a hot lower half, gets a tenth and a fifth of the way to
/// the temperature of that, in implicit steps of so many seconds: what the bed alone does, without plates.
inline std::vector<double> mixing_times(plate_bed& made, double cold, double hot, double step) {
    bed& b = made.spheres;
    auto links = heat_links(made, 0.5 * (cold + hot), 0.95, 2.5, heat_paths::all);
    links.walls.clear();
    std::vector<double> temperature, times;
    std::vector<std::size_t> upper;
    for (hearth::dem::index i = 0; i < b.size(); ++i) {
        const bool above = b.spheres()[i].centre.z > 0.5 * made.height;
        temperature.push_back(above ? cold : hot);
        if (above) upper.push_back(static_cast<std::size_t>(i));
    }
    double before = cold, time = 0;
    while (times.size() < 2) {
        heat(made, links, step, temperature);
        double mean = 0;
        for (const std::size_t i : upper) mean += temperature[i] / static_cast<double>(upper.size());
        const double wanted = cold + (hot - cold) * (times.empty() ? 0.1 : 0.2);
        if (mean >= wanted) times.push_back(time + step * (wanted - before) / (mean - before));
        before = mean;
        time += step;
    }
    return times;
}

/// Driven discharge of a share of the bed in so many seconds: the most that was due and had not left, over the bed's mass.
inline double largest_arrears(plate_bed& made, double seconds, double share = 0.5) {
    bed& b = made.spheres;
    double mass = 0, worst = 0;
    for (hearth::dem::index i = 0; i < b.size(); ++i) mass += b.mass(i);
    hearth::dem::outflow sink({0, 0, share * mass / seconds});
    b.set_wall_open(2, true);
    const double start = b.time();
    while (b.time() - start < seconds) {
        b.advance(50);
        sink.update(b, 50 * b.settings().step);
        worst = std::fmax(worst, std::fabs(sink.now().due) / mass);
    }
    return worst;
}

}  // namespace hearth_test
