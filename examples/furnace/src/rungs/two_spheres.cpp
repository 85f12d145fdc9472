// SPDX-License-Identifier: MIT
#include "two_spheres.hpp"

#include <algorithm>
#include <cmath>

#include <hearth/closure/gas_film.hpp>
#include <hearth/closure/hertz.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/dem/thermal_bed.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/conduction.hpp>

#include "grains.hpp"
#include "rung_of.hpp"

namespace hearth::furnace::rungs {
namespace {

/// Two bodies at rest under a force, as DEM has it.
struct pressed {
    double force = 0;       ///< between them [N]
    double overlap = 0;     ///< of the softened motion [m]
    double conductance = 0;  ///< through the contact, by the scene's term [W/K]
    double seconds = 0;     ///< of the processor
};

/// Presses two spheres, or a sphere onto a wall, until they rest; the contact's heat by the library's term.
pressed press(const two_spheres& s, double force, double softened, bool on_wall) {
    const double began = cpu_seconds(), radius = 0.5 * s.diameter;
    dem::bed_settings settings;
    settings.gravity = {0, 0, 0};
    settings.body = {softened, s.poisson_ratio};
    settings.contact.damping = 0.5;
    settings.contact.friction = 0;
    settings.deepest_overlap = 0.9;
    const double mass = s.density * pi / 6 * std::pow(s.diameter, 3);
    // A fiftieth of the period of the contact's oscillation about its rest, where its stiffness is 2 E* a.
    const closure::elastic<double> body{softened, s.poisson_ratio};
    const double modulus = closure::hertz::effective_modulus(body, body);
    const double around = on_wall ? radius : 0.5 * radius;
    const double stiffness = 2 * modulus * closure::hertz::contact_radius(force, around, modulus);
    settings.step = 2 * pi * std::sqrt((on_wall ? 1.0 : 0.5) * mass / stiffness) / 50;
    dem::bed b(settings);
    if (on_wall) b.add_wall(wall_of(settings, dem::shape::plane({0, 0, 0}, {0, 0, 1}), 0, 0));
    dem::particle one;
    one.position = {0, 0, radius};
    one.radius = radius;
    one.density = s.density;
    std::vector<dem::particle> all{one};
    if (!on_wall) {
        one.position.z += s.diameter;
        all.push_back(one);
    }
    b.insert(all);
    for (dem::index i = 0; i < b.size(); ++i) {
        b.set_outer_force(i, {0, 0, on_wall || b.spheres()[i].centre.z > s.diameter ? -force : force});
    }
    b.advance(4000);

    dem::thermal_bed warm(b, {500, s.conductivity, 1});
    contact_materials materials;
    materials.particle = materials.wall = {s.modulus, s.poisson_ratio};
    materials.wall_conductivity = s.conductivity;
    const scene touching{conduction{closure::zhang::constriction{}, materials}};
    const auto links = touching.links(warm, warm);
    pressed found;
    const auto see = [&](double f, double overlap) { found.force = f, found.overlap = overlap; };
    if (on_wall) {
        b.for_each_wall_contact([&](dem::index, int, double f, double overlap, const dem::vector3&) { see(f, overlap); });
        for (const auto& w : links.walls) found.conductance += w.link.conductance;
    } else {
        b.for_each_contact([&](dem::index, dem::index, double f, double overlap, const dem::vector3&) { see(f, overlap); });
        for (const auto& pair : links.pairs) found.conductance += pair.link.conductance;
    }
    found.seconds = cpu_seconds() - began;
    return found;
}

/// Slope of log y over log x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double a = std::log(x[k]), b = std::log(y[k]);
        sx += a, sy += b, sxx += a * a, sxy += a * b;
    }
    const auto n = static_cast<double>(x.size());
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

void check(const two_spheres& scene) {
    if (scene.softened_modulus > scene.modulus) {
        throw bad_scene("particles.softened_modulus_Pa is " + format(scene.softened_modulus) + ", allowed: at most particles.modulus_Pa, " +
                        format(scene.modulus));
    }
    if (scene.forces.size() < 2) throw bad_scene("contact.forces_N holds 1 number, allowed: two or more, for the slope");
}

rung_plan foresee(const two_spheres& scene) {
    rung_plan p;
    p.builds = "two spheres, and a sphere on a wall, under " + std::to_string(scene.forces.size()) + " forces by DEM";
    p.memory = 20e6;
    p.seconds = 0.01 * (8 + 2 * static_cast<double>(scene.forces.size()));
    p.left_out = {{"gas flow, species, combustion", "only the film in the gap conducts", "all cells"},
                  {"radiation", "kind = \"two_spheres\" is a contact", "view factors"},
                  {"temperatures over time", "heat is linear in the difference given", "the energy equation"}};
    return p;
}

rung_result run(const two_spheres& s, const watcher& watch) {
    const closure::elastic<double> body{s.modulus, s.poisson_ratio};
    const double modulus = closure::hertz::effective_modulus(body, body), radius = 0.5 * s.diameter, d_t = s.temperature_difference;
    const closure::gas_film film;
    std::vector<double> pair_heat, wall_heat, with_film, series, hertz;
    double worst_force = 0, worst_hertz = 0, ratio = 0;
    for (const double force : s.forces) {
        watch(static_cast<double>(pair_heat.size()) / static_cast<double>(s.forces.size() + 1), format(force) + " N");
        const pressed pair = press(s, force, s.softened_modulus, false), wall = press(s, force, s.softened_modulus, true);
        worst_force = std::max({worst_force, std::abs(pair.force / force - 1), std::abs(wall.force / force - 1)});
        const double a = closure::hertz::contact_radius(force, 0.5 * radius, modulus);
        hertz.push_back(2 * s.conductivity * a * d_t);
        pair_heat.push_back(pair.conductance * d_t);
        wall_heat.push_back(wall.conductance * d_t);
        worst_hertz = std::max(worst_hertz, std::abs(pair_heat.back() / hertz.back() - 1));
        ratio += wall.conductance / pair.conductance / static_cast<double>(s.forces.size());
        const double overlap = closure::hertz::overlap(a, 0.5 * radius);
        with_film.push_back(pair_heat.back() + d_t * film.conductance(closure::film_pair<double>{-overlap, radius, radius, s.conductivity,
                                                                                         s.conductivity, s.gas_conductivity, 0.4}));
        series.push_back(d_t * closure::zhang::series{}.conductance(
                                   closure::contact_pair<double>{a, force, s.conductivity, s.conductivity, radius, radius}));
    }
    rung_result r;
    r.tables.push_back({"heat_over_force.csv", {{"force_N", s.forces}, {"hertz_W", hertz}, {"two_spheres_W", pair_heat},
                                                {"sphere_and_wall_W", wall_heat}, {"with_gas_film_W", with_film}, {"letter_of_eq_2_W", series}}});

    // Error against run time over the softening: the heat by the force, and by the overlap as it is.
    curves softening{"over_modulus.csv", {{"modulus_Pa", {}}, {"time_s", {}}, {"by_force_error", {}}, {"by_overlap_error", {}},
                                          {"time_of_process_second_s", {}}}};
    const double middle = s.forces[s.forces.size() / 2];
    for (double soft = s.modulus; soft > 0.9e-3 * s.softened_modulus && soft > 5e6; soft *= 0.1) {
        const pressed pair = press(s, middle, soft, false);
        const double exact = 2 * s.conductivity * closure::hertz::contact_radius(middle, 0.5 * radius, modulus);
        const double geometric = 2 * s.conductivity * std::sqrt(0.5 * radius * pair.overlap);
        const double stiffness = 2 * modulus * soft / s.modulus * std::sqrt(0.5 * radius * pair.overlap);
        const double step = 2 * pi * std::sqrt(0.5 * s.density * pi / 6 * std::pow(s.diameter, 3) / stiffness) / 50;
        softening.columns[0].second.push_back(soft);
        softening.columns[1].second.push_back(pair.seconds);
        softening.columns[2].second.push_back(std::abs(pair.conductance / exact - 1));
        softening.columns[3].second.push_back(std::abs(geometric / exact - 1));
        softening.columns[4].second.push_back(pair.seconds / (4000 * step));
    }
    r.tables.push_back(softening);
    r.findings = {
        {"exponent_two_spheres", "heat over force, exponent: two spheres", "1/3 (Hertz)", slope(s.forces, pair_heat), "-", "%.6f"},
        {"exponent_sphere_and_wall", "  sphere and wall", "1/3 (Hertz)", slope(s.forces, wall_heat), "-", "%.6f"},
        {"exponent_with_gas_film", "  two spheres with the gas in their gap", "", slope(s.forces, with_film), "-"},
        {"wall_over_pair", "heat of sphere and wall over that of two spheres", "2^(1/3) = 1.26", ratio, "-"},
        {"heat_W", "heat at " + format(middle) + " N and " + format(d_t) + " K", "", pair_heat[s.forces.size() / 2], "W"},
        {"hertz_error", "  largest departure from 2 k a of Hertz", "0", worst_hertz, "-", "%.1e"},
        {"force_error", "force in DEM over force applied, less 1", "0", worst_force, "-", "%.1e"},
        {"film_share_percent", "share of the gas film at " + format(s.forces.front()) + " N", "",
         100 * (1 - pair_heat.front() / with_film.front()), "%"},
        {"letter_share", "Eq. 2 by the letter over this, at " + format(middle) + " N", "",
         series[s.forces.size() / 2] / pair_heat[s.forces.size() / 2], "-", "%.2e"},
        {"overlap_as_it_is", "heat by the softened overlap over the true one", "", 1 + softening.columns[3].second.back(), "-"}};
    watch(1, "done");
    return r;
}

}  // namespace hearth::furnace::rungs
