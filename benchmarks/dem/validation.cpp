// SPDX-License-Identifier: MIT
// Numbers of the validation page of the solvers, as tables in a folder: validation FOLDER [TABLE ...].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "solvers/dem/plates.hpp"
#include "support/tables.hpp"

namespace {

using namespace hearth_test;
namespace dem = hearth::dem;
constexpr double pi = hearth::constants<double>::pi();

/// Zehner, Bauer and Schluender, VDI Heat Atlas D6.3, of iron spheres in air at 1 atm: flattened contacts share 0.0077.
double zehner_bauer_schluender(double kelvin, double emissivity, double void_fraction) {
    const double gas = iron::gas_conductivity(kelvin), solid = iron::conductivity / gas, flat = 0.0077;
    const double r = 4 * hearth::constants<double>::stefan_boltzmann() * std::pow(kelvin, 3) * iron::diameter /
                     ((2 / emissivity - 1) * gas);
    const double b = 1.25 * std::pow((1 - void_fraction) / void_fraction, 10.0 / 9.0);
    const double n = 1 + (r - b) / solid;
    const double core =
        2 / n *
        (b * (solid + r - 1) / (n * n * solid) * std::log((solid + r) / b) + (b + 1) / (2 * b) * (r - b) - (b - 1) / n);
    const double open = std::sqrt(1 - void_fraction);
    return gas * ((1 - open) * void_fraction * (1 / void_fraction + r) + open * (flat * solid + (1 - flat) * core));
}

void fig_3(std::ostream& out) {
    plate_bed made(1, 10 * iron::diameter, 36 * iron::diameter, 0.3);
    out << "# " << made.spheres.size() << " spheres, solid fraction " << made.solid << '\n'
        << "kelvin contact film radiation all between_plates yk_low yk_high zbs\n";
    for (double kelvin = 300; kelvin <= 1200; kelvin += 50) {
        const conductivity_parts p = conductivity_between_plates(made, kelvin, 0.95);
        out << kelvin << ' ' << p.contact << ' ' << p.film << ' ' << p.radiation << ' ' << p.core() << ' '
            << p.between_plates << ' ' << iron::yagi_kunii(kelvin, 0.9, 0.9) << ' ' << iron::yagi_kunii(kelvin, 1, 1)
            << ' ' << zehner_bauer_schluender(kelvin, 0.95, 0.40) << '\n';
    }
}

void exchange(std::ostream& out) {
    out << "friction solid cutoff_2.5 cutoff_4\n";
    const double cube = 4 * hearth::constants<double>::stefan_boltzmann() * iron::diameter * 1e9;
    for (const double friction : {0.0, 0.1, 0.3, 1.0}) {
        plate_bed made(1, 10 * iron::diameter, 36 * iron::diameter, friction);
        out << friction << ' ' << made.solid;
        for (const double cutoff : {2.5, 4.0})
            out << ' ' << conductivity_between_plates(made, 1000, 1.0, cutoff, heat_paths::radiation).radiation / cube;
        out << '\n';
    }
}

/// Parcels of k beside grains.  In a bed of the same number of diameters, k times as large, under the same stress:
/// parts of the conductivity, and times of mixing over k^2.
void parcels_alike(std::ostream& out) {
    out << "k number solid contact film radiation time_10_s time_20_s discharge_error seconds\n";
    for (const int k : {1, 2, 3, 4}) {
        const double began = bench::cpu_seconds();
        plate_bed made(k, 9 * k * iron::diameter, 30 * k * iron::diameter, 0.3, 9.81 / k);
        const conductivity_parts p = conductivity_between_plates(made, 800, 1.0);
        const std::vector<double> times = mixing_times(made, 300, 1000, 20 * k * k);
        const dem::index number = made.spheres.size();
        const double worst = largest_arrears(made, 2 * k);
        out << k << ' ' << number << ' ' << made.solid << ' ' << p.contact << ' ' << p.film << ' ' << p.radiation << ' '
            << times[0] / (k * k) << ' ' << times[1] / (k * k) << ' ' << worst << ' ' << bench::cpu_seconds() - began
            << '\n'
            << std::flush;
    }
}

/// The same vessel, 12 grains in radius, with as much of grains or of parcels of k: height, stress, conductivity,
/// heating from below, discharge.
void parcels(std::ostream& out) {
    const double radius = 12 * iron::diameter, column = 44 * iron::diameter;
    out << "k number mass height solid floor_stress conductivity between_plates time_5_s time_10_s discharge_error "
           "seconds\n";
    for (const int k : {1, 2, 3, 4}) {
        const double began = bench::cpu_seconds();
        plate_bed made(k, radius, column, plate_bed::settings(k, 0.3, 9.81), 34.0);
        const conductivity_parts p = conductivity_between_plates(made, 800, 1.0);
        const std::vector<double> times = heating_times(made, 300, 1000, 20);
        const dem::index number = made.spheres.size();
        const double mass = number * made.spheres.mass(0);
        const double stress = -made.spheres.force_on_wall(0).z / (pi * radius * radius);
        const double worst = largest_arrears(made, 2);
        out << k << ' ' << number << ' ' << mass << ' ' << made.height << ' '
            << mass / (iron::density * pi * radius * radius * made.height) << ' ' << stress << ' ' << p.core() << ' '
            << p.between_plates << ' ' << times[0] << ' ' << times[1] << ' ' << worst << ' '
            << bench::cpu_seconds() - began << '\n'
            << std::flush;
    }
}

/// Height, packing, stress and conductivity of one bed over step, skin and softening, with the time that they took.
void sweeps(std::ostream& out) {
    out << "what value seconds height solid floor_stress conductivity deepest_overlap\n";
    struct run {
        const char* what;
        double step, skin, modulus;
    };
    std::vector<run> runs{{"reference", 3e-6, 0.1, 1e9}};
    for (const double step : {3e-6, 6e-6, 1.2e-5, 2.4e-5, 3.6e-5}) runs.push_back({"step", step, 0.1, 1e8});
    for (const double skin : {0.02, 0.05, 0.2, 0.4}) runs.push_back({"skin", 1.2e-5, skin, 1e8});
    for (const double modulus : {1e6, 1e7, 1e8, 1e9})
        runs.push_back({"modulus", 1.2e-5 * std::sqrt(1e8 / modulus), 0.1, modulus});
    for (const run& r : runs) {
        dem::bed_settings s = plate_bed::settings(1, 0.3, 9.81);
        s.step = r.step;
        s.skin = r.skin;
        s.body.youngs_modulus = r.modulus;
        s.deepest_overlap = 0.8;
        const double began = bench::cpu_seconds();
        plate_bed made(1, 6 * iron::diameter, 24 * iron::diameter, s);
        const double seconds = bench::cpu_seconds() - began;
        double deepest = 0, top = 0;
        made.spheres.for_each_contact([&](dem::index, dem::index, double, double overlap, const dem::vector3&) {
            deepest = std::fmax(deepest, overlap);
        });
        for (dem::index i = 0; i < made.spheres.size(); ++i) top = std::fmax(top, made.spheres.spheres()[i].centre.z);
        const double area = pi * std::pow(6 * iron::diameter, 2);
        const double value = r.what[1] == 't' ? r.step : r.what[1] == 'k' ? r.skin : r.modulus;
        out << r.what << ' ' << value << ' ' << seconds << ' '
            << dem::surface_level(made.spheres, {{0, 0, 0}, 6 * iron::diameter, 1}) << ' ' << made.solid << ' '
            << -made.spheres.force_on_wall(0).z / area << ' ' << conductivity_between_plates(made, 800, 1.0).core()
            << ' ' << deepest / iron::diameter << '\n'
            << std::flush;
    }
}

/// Discharge through holes in flat floors of a wide bin; Beverloo's law asks for bins wider than 2.5 holes and holes
/// wider than 6 diameters.
void beverloo(std::ostream& out) {
    constexpr double d = 0.018;
    out << "bin_over_d hole_over_d friction flow law\n";
    struct run {
        double bin, hole, friction;
    };
    for (const run& r :
         {run{14, 6, 0.5}, run{14, 8, 0.5}, run{24, 6, 0.5}, run{24, 8, 0.5}, run{14, 8, 0.3}, run{14, 8, 0.1}}) {
        const dem::bed_settings s = soft_settings(r.friction, 0.3);
        const double radius = r.bin * d / 2;
        bed b(s);
        b.add_wall(wall_of(s, dem::shape::disc({0, 0, 0}, {0, 0, 1}, radius, {{{0, 0, 0}, r.hole * d / 2}})));
        b.add_wall(wall_of(s, dem::shape::cylinder({0, 0, -1}, {0, 0, 2}, radius)));
        const int plug = b.add_wall(wall_of(s, dem::shape::disc({0, 0, -1e-4}, {0, 0, 1}, radius)));
        auto source = feed_into({{0, 0, 16 * d}, radius, 12 * d}, 3580, 0.95 * d, d);
        dem::fill_to_level(b, source, {{0, 0, 0}, radius, 14 * d}, 14 * d, 60000);
        settle(b, 30000);
        const double bulk = 3580 * solid_fraction(b, {{0, 0, 2 * d}, radius, 9 * d});
        b.set_wall_open(plug, true);
        double left = 0, began = 0, since = 0;
        for (;;) {
            b.advance(200);
            std::vector<dem::index> gone;
            for (dem::index i = 0; i < b.size(); ++i)
                if (b.spheres()[i].centre.z < -3 * d) gone.push_back(i);
            for (const auto i : gone) left += b.mass(i);
            b.remove(gone);
            if (began == 0 && left > 1) began = b.time(), since = left;
            if (began > 0 && dem::surface_level(b, {{0, 0, 0}, radius, 1}) < 9 * d) break;
        }
        const double law = 0.58 * bulk * std::sqrt(9.81) * std::pow((r.hole - 1.4 * 0.975) * d, 2.5);
        out << r.bin << ' ' << r.hole << ' ' << r.friction << ' ' << (left - since) / (b.time() - began) << ' ' << law
            << '\n'
            << std::flush;
    }
}

}  // namespace

int main(int count, char** words) {
    return bench::write_tables(count, words,
                               {{"fig_3", fig_3},
                                {"exchange", exchange},
                                {"parcels_alike", parcels_alike},
                                {"parcels", parcels},
                                {"sweeps", sweeps},
                                {"beverloo", beverloo}});
}
