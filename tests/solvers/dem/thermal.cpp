// SPDX-License-Identifier: MIT
// The bed as a host of the coupling library.
#include <hearth/dem/thermal_bed.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/closure/wall_view.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>

#include "solvers/dem/packed.hpp"
#include "support/random.hpp"

using namespace hearth::dem;
using hearth_test::feed_into;
using hearth_test::settle;
using hearth_test::soft_settings;
using hearth_test::tube_on_floor;
using hearth_test::wall_of;

namespace {

constexpr double d = 0.018;

bed settled_tube(double diameter, double radius, double column) {
    bed b = tube_on_floor(soft_settings(0.3, 0.5), radius, 10 * column);
    feed source = feed_into({{0, 0, 0}, radius, column}, 3580, 0.9 * diameter, diameter);
    source.fill(b);
    settle(b, 40000);
    return b;
}

hearth::contact_materials steel() {
    hearth::contact_materials m;
    m.particle = {2.0e11, 0.29};
    m.wall = {2.0e11, 0.29};
    m.wall_conductivity = 45;
    return m;
}

using id_pair = std::pair<std::int64_t, std::int64_t>;
std::set<id_pair> near_by_list(const bed& b, double factor) {
    std::set<id_pair> found;
    std::size_t visits = 0;
    b.for_each_near(factor, [&](std::int32_t i, std::int32_t j, double) {
        found.insert(std::minmax(b.ids()[i], b.ids()[j]));
        ++visits;
    });
    CHECK(visits == found.size());  // each once
    return found;
}
std::set<id_pair> near_by_all(const bed& b, double factor) {
    std::set<id_pair> found;
    for (std::int32_t i = 0; i < b.size(); ++i)
        for (std::int32_t j = i + 1; j < b.size(); ++j)
            if (norm(b.spheres()[i].centre - b.spheres()[j].centre) <
                factor * (b.spheres()[i].radius + b.spheres()[j].radius))
                found.insert(std::minmax(b.ids()[i], b.ids()[j]));
    return found;
}

/// Conductivity along z of the bed in a zone whose temperature rises evenly with z [W/(m K)]: heat of pairs times their
/// height, summed over what lies in the zone, over its volume.
template <class Links, class Conductance>
double conductivity_of(const bed& b, const zone& core, const Links& links, const Conductance& conductance) {
    const auto inside = [&](std::int32_t i) {
        const vector3 x = b.spheres()[i].centre - core.base;
        return std::hypot(x.x, x.y) < core.radius && x.z > 0 && x.z < core.height ? 0.5 : 0.0;
    };
    double sum = 0;
    for (const auto& pair : links.pairs) {
        const double dz = b.spheres()[pair.first].centre.z - b.spheres()[pair.second].centre.z;
        sum += (inside(pair.first) + inside(pair.second)) * conductance(pair.link) * dz * dz;
    }
    return sum / (hearth::constants<double>::pi() * core.radius * core.radius * core.height);
}

}  // namespace

TEST_CASE("near list: that of all pairs, while the bed moves, is sorted, loses and gains particles") {
    bed b = tube_on_floor(soft_settings(0.3, 0.5), 4 * d, 2);
    feed source = feed_into({{0, 0, 0.2}, 4 * d, 8 * d}, 3580, 0.5 * d, d);
    source.fill(b);
    for (int k = 0; k < 12; ++k) {
        CHECK(near_by_list(b, 2.5) == near_by_all(b, 2.5));
        b.advance(120);
        if (k % 4 == 1) source.fill(b);
        if (k % 4 == 3) b.remove({0, b.size() / 2});
    }
    settle(b, 40000);
    CHECK(near_by_list(b, 2.5) == near_by_all(b, 2.5));
    const auto made = b.near_rebuilds();
    for (int k = 0; k < 5; ++k) {
        b.expire_lists();  // contacts are searched and particles sorted again, neighbours are not
        b.advance(20);
        CHECK(near_by_list(b, 2.5) == near_by_all(b, 2.5));
    }
    CHECK(near_by_list(b, 1.2) == near_by_all(b, 1.2));  // the longer list serves
    CHECK(b.near_rebuilds() == made);
}

TEST_CASE("contact conduction: areas of the true modulus, however soft the motion; conductance grows with force^(1/3)") {
    // Two steel spheres of 19.8 mm: 2 k a = 2.916e-3 W/(K N^(1/3)) with k = 45 W/(m K), E = 2e11 Pa, nu = 0.29.
    for (const double softened : {2e11, 3.77e8}) {
        for (const double newtons : {0.5, 5.0, 50.0}) {
            bed_settings s;
            s.body = {softened, 0.29};
            s.deepest_overlap = 0.9;
            bed b(s);
            const contact_law law = contact_law::between_particles(s.body, s.contact);
            const double overlap = std::pow(newtons / (law.normal_stiffness * std::sqrt(0.0099 / 2)), 2.0 / 3.0);
            particle one;
            one.radius = 0.0099;
            one.density = 7800;
            particle two = one;
            two.position.x = 2 * 0.0099 - overlap;
            b.insert({one, two});
            thermal_bed warm(b, {500, 45, 0.8});
            const hearth::scene conducts{hearth::conduction{hearth::closure::zhang::constriction{}, steel()}};
            const auto links = conducts.links(warm, warm);
            REQUIRE(links.pairs.size() == 1);
            CHECK(links.pairs[0].link.conductance == doctest::Approx(2.916e-3 * std::cbrt(newtons)).epsilon(1e-3));
        }
    }
}

TEST_CASE("conduction and radiation of a settled bed: isothermal stays so, a closed bed keeps its energy at any step and Gamma") {
    bed b = settled_tube(d, 5 * d, 16 * d);
    thermal_bed warm(b, {800, 4, 1});
    hearth::radiation_params p;
    p.open_from = 1.0;  // closed
    const hearth::scene hot{hearth::conduction{hearth::closure::zhang::constriction{}, steel()},
                            hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}, p}};
    const auto links = hot.links(warm, warm);
    const auto n = static_cast<std::size_t>(b.size());
    CHECK(links.pairs.size() > 20 * n);
    CHECK(links.walls.size() > 0);
    std::vector<double> mass(n), temperature(n, 1234.5);
    for (std::size_t i = 0; i < n; ++i) mass[i] = b.mass(static_cast<std::int32_t>(i));
    const hearth::constant_specific_heat<> cp{800};
    const auto caloric = [&](std::size_t) -> const hearth::constant_specific_heat<>& { return cp; };
    hearth::thermal_network network;
    std::vector<hearth::particle_step<double>> taken;

    b.set_patch_temperature(0, 1234.5);
    b.set_patch_temperature(1, 1234.5);
    const auto baths = hot.baths(warm, warm, hearth::no_gas{}, links);
    for (const double step : {1e-3, 10.0, 1e6}) {
        network.advance(links.pairs, baths, mass, caloric, hearth::tssm(678.0), step, temperature, taken);
        for (const double t : temperature) CHECK(std::fabs(t - 1234.5) < 1e-12 * 1234.5 * 4);
    }

    const std::vector<hearth::heat_bath<double>> none(n);
    for (const double gamma : {1.0, 678.0}) {
        for (const double step : {1e-2, 1e2, 1e6}) {
            CAPTURE(step);
            for (std::size_t i = 0; i < n; ++i) temperature[i] = 300 + 2000 * b.spheres()[i].centre.z / (8 * d);
            const auto energy = [&] {
                double sum = 0;
                for (std::size_t i = 0; i < n; ++i) sum += mass[i] * 800 * temperature[i];
                return sum;
            };
            const double before = energy(), highest = *std::max_element(temperature.begin(), temperature.end());
            for (int k = 0; k < 3; ++k)
                network.advance(links.pairs, none, mass, caloric, hearth::tssm(gamma), step, temperature, taken);
            CHECK(std::fabs(energy() / before - 1) < 1e-12);
            for (const double t : temperature) CHECK((t >= 300 && t <= highest));
        }
    }
}

TEST_CASE("radiative conductivity of a settled bed is that of the view factors; parcels of twice the size give the same") {
    // 4 sigma F_E D T^3 with F_E 1.007 / 1.041 / 1.068 at solid fractions 0.618 / 0.593 / 0.577 (own Monte Carlo).
    const double radius = 10 * d, temperature = 1000;
    double radiative[2], fraction[2];
    for (const int k : {1, 2}) {
        bed b = settled_tube(k * d, radius, (k == 1 ? 30 : 80) * d);
        const double surface = surface_level(b, {{0, 0, 0}, radius, 1});
        const zone core{{0, 0, 2.5 * k * d}, radius - 2.5 * k * d, surface - 5.5 * k * d};
        REQUIRE(core.height > 2 * k * d);
        fraction[k - 1] = hearth_test::solid_fraction(b, core);
        thermal_bed warm(b, {800, 4, 1}, k);
        hearth::radiation_params p;
        p.solid_fraction = fraction[k - 1];
        const hearth::scene shines{hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}, p}};
        auto links = shines.links(warm, warm);
        scale_parcels(links, k);
        radiative[k - 1] = conductivity_of(b, core, links, [&](const auto& link) {
            return 4 * temperature * temperature * temperature * link.radiation;
        });
    }
    const double sigma = hearth::constants<double>::stefan_boltzmann();
    const double exchange = radiative[0] / (4 * sigma * 0.95 * d * std::pow(temperature, 3));
    MESSAGE("F_E " << exchange << " at solid fraction " << fraction[0] << "; k = 2: ratio " << radiative[1] / radiative[0]);
    CHECK(exchange > 0.95);
    CHECK(exchange < 1.10);
    CHECK(radiative[1] == doctest::Approx(radiative[0]).epsilon(0.08));  // small core: 60 parcels
}

TEST_CASE("grains: what the gas sees of a parcel is k^3 grains of a k-th of its radius") {
    bed b{bed_settings{}};
    particle p;
    p.radius = 0.04;
    p.density = 1000;
    b.insert({p});
    thermal_bed warm(b, {800, 4, 1}, 4);
    auto cloud = grains(warm);
    using traits = hearth::particle_traits<grain_cloud>;
    CHECK(traits::get(hearth::quantity::radius{}, cloud, 0) == doctest::Approx(0.01));
    CHECK(64 * traits::get(hearth::quantity::mass{}, cloud, 0) == doctest::Approx(b.mass(0)));
    traits::add(hearth::quantity::heat_rate{}, cloud, 0, 2.0);
    traits::add(hearth::quantity::force{}, cloud, 0, vector3{0, 0, 1});
    CHECK(warm.heat_rates[0] == 128.0);
    warm.push();
    const double weight = b.mass(0) * 9.81;
    b.advance(1);
    CHECK(b.motions()[0].velocity.z == doctest::Approx((64 - weight) / b.mass(0) * b.settings().step));
    CHECK_THROWS_AS(thermal_bed(b, {0, 4, 1}), hearth::bad_value);
    CHECK_THROWS_AS(thermal_bed(b, {800, 4, 1.2}), hearth::bad_value);
    CHECK_THROWS_AS(thermal_bed(b, {800, 4, 1}, 0), hearth::bad_value);
}

TEST_CASE("flight: particles fall at Gamma 1, those in the bed have its Gamma, one bounce switches nothing") {
    bed_settings s = soft_settings(0.5, 0.3);
    bed b = tube_on_floor(s, 1.3 * d, 3);
    std::vector<particle> balls;
    for (int k = 0; k < 12; ++k) {
        particle p;
        p.radius = 0.5 * d;
        p.density = 3580;
        p.position = {0.4 * d * (k % 2), 0.3 * d * (k % 3), (0.6 + 1.1 * k) * d};
        balls.push_back(p);
    }
    balls.back().position.z = 2.0;
    const auto last = b.insert(balls) + 11;
    thermal_bed warm(b, {800, 4, 1});
    for (int k = 0; k < 6000; k += 50) {
        b.advance(50);
        b.update_flight();
    }
    const auto gamma = warm.acceleration_factors(678);
    for (std::int32_t i = 0; i < b.size(); ++i) {
        CAPTURE(b.ids()[i]);
        CHECK(gamma[static_cast<std::size_t>(i)] == (b.ids()[i] == last ? 1.0 : 678.0));
    }
    for (int k = 0; k < 20000; k += 50) {
        b.advance(50);
        b.update_flight();
    }
    int flying = 0;
    for (std::int32_t i = 0; i < b.size(); ++i) flying += b.in_flight(i);
    CHECK(flying == 0);
}

TEST_CASE("patches: walls of one patch share a temperature; unknown ones are refused") {
    bed b = tube_on_floor(soft_settings(0.5, 0.3), 2 * d, 3);
    CHECK(b.patch_temperature(1) == 300);
    b.set_patch_temperature(1, 900);
    CHECK(b.patch_temperature(1) == 900);
    CHECK_THROWS_AS(b.set_patch_temperature(7, 900), hearth::bad_value);
    CHECK_THROWS_AS(b.set_patch_temperature(1, -1), hearth::bad_value);
    CHECK_THROWS_AS(b.add_wall(wall_of(b.settings(), shape::plane({0, 0, 9}, {0, 0, 1}), 1)), hearth::bad_value);
}
