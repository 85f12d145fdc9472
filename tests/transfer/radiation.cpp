// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/closure/feng_han.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/radiation.hpp>

#include "support/warm_bed.hpp"

using namespace hearth;
using namespace hearth_test;

namespace {

constexpr double sigma = constants<double>::stefan_boltzmann();
constexpr double diameter = 0.018;

test::packing periodic_bed(double solid_fraction = 0.6) {
    test::packing_settings settings;
    settings.solid_fraction = solid_fraction;
    settings.size = {9, 9, 9};
    settings.periodic = {true, true, true};
    return test::make_packing(settings);
}

scene<radiation<closure::feng_han::monte_carlo_fit>> radiating(radiation_params settings = {}) {
    return scene{radiation{closure::feng_han::monte_carlo_fit{settings.solid_fraction}, settings}};
}

/// Radiative conductivity over 4 sigma d T^3 that a list gives a bed: sum over pairs of A F s^2 over the solid's
/// surface, times the solid fraction; the same sum as behind the reference 1.04 at 0.593 and 1.007 at 0.618.
template <class Link>
double exchange_factor(const warm_bed& bed, const link_list<Link>& links, double solid_fraction) {
    double sum = 0, surface = 0;
    for (std::size_t k = 0; k < links.pairs.size(); ++k) {
        const auto& pair = links.pairs[k];
        const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
        const double s = bed.near[k].distance / (bed.radius[a] + bed.radius[b]);
        REQUIRE((bed.near[k].first == pair.first && bed.near[k].second == pair.second));
        sum += 2 * pair.link.radiation / sigma * s * s;
    }
    for (const double r : bed.radius) surface += 4 * constants<double>::pi() * r * r;
    return solid_fraction * sum / surface;
}

TEST_CASE("radiation: a list to 2.5 diameters conducts what the full list would, and rows then sum above 1") {
    const auto packed = periodic_bed();
    const warm_bed full(packed, diameter, 4.0), bed(packed, diameter, 2.5);
    radiation_params whole;
    whole.cutoff = 4.0;
    const auto all = radiating(whole).links(full, full);
    const auto list = radiating().links(bed, bed);
    const double reference = exchange_factor(full, all, packed.solid_fraction());
    const double scaled = exchange_factor(bed, list, packed.solid_fraction());
    CAPTURE(reference);
    CAPTURE(scaled);
    // The share beyond the cutoff is taken from other packings of that density; 2 % is their spread.
    CHECK(scaled == doctest::Approx(reference).epsilon(0.02));
    // Own ray tracing: 1.041 - (0.6 - 0.593) 1.36 = 1.03; this packing is not settled but pushed apart, 5 %.
    CHECK(scaled == doctest::Approx(1.03).epsilon(0.05));

    REQUIRE(list.views.size() == 1);
    const view_report& rows = list.views[0];
    MESSAGE("rows: mean " << rows.row_mean << ", " << rows.row_least << " to " << rows.row_largest << ", scale "
                          << rows.scale);
    CHECK(rows.scale > 1.04);
    CHECK(rows.scale < 1.14);
    CHECK(rows.row_mean > 1.03);
    CHECK(rows.row_mean < 1.10);
    CHECK(rows.open == 0);  // the inside of a bed does not look out
}

TEST_CASE("radiation: closed rows sum to 1") {
    const auto packed = periodic_bed();
    const warm_bed bed(packed, diameter, 2.5);
    radiation_params settings;
    settings.rows = view_rows::closed;
    const auto list = radiating(settings).links(bed, bed);
    CHECK(list.views[0].row_mean == doctest::Approx(1).epsilon(1e-6));
    CHECK(list.views[0].row_least == doctest::Approx(1).epsilon(1e-6));
    CHECK(list.views[0].row_largest == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("radiation: the view that is missing at a free surface goes to the surroundings, at walls to the walls") {
    test::packing_settings settings;
    settings.solid_fraction = 0.57;
    settings.size = {8, 8, 8};
    settings.periodic = {true, true, false};
    const auto packed = test::make_packing(settings);
    radiation_params params;
    params.solid_fraction = 0.58;
    params.surroundings = 1000;
    const warm_bed open_top(packed, diameter, 2.5, 5), closed(packed, diameter, 2.5);
    const auto list = radiating(params).links(open_top, open_top);
    const view_report& rows = list.views[0];
    CHECK(rows.open > 20);  // of 64 places in the top layer
    // An open plane sees the surroundings once: sum A (open view) over the area of the top.
    double area = 0;
    int below = 0;
    for (const auto& open : list.surroundings) {
        area += open.link.radiation / sigma;
        CHECK(open.temperature == 1000);
        below += open_top.position[static_cast<std::size_t>(open.particle)][2] < 6 * diameter ? 1 : 0;
    }
    CHECK(below <= 2);  // a hole in the packing may look like a surface
    const double top = 64 * diameter * diameter;
    MESSAGE("open area over the free surface: " << area / top);
    // The deadband withholds the second layer, a tenth to a fifth of the exchange, and F of a distance alone does not
    // know who stands in front.
    CHECK(area / top > 0.75);
    CHECK(area / top < 1.35);

    double wall_area = 0;
    const auto walled = radiating(params).links(closed, closed);
    for (const auto& wall : walled.walls) wall_area += wall.link.radiation / sigma;
    // Two walls, black; the pushed packing touches them with another number of spheres than a settled one.
    CHECK(wall_area / (2 * top) == doctest::Approx(1).epsilon(0.35));
}

TEST_CASE("radiation: what one side loses the other gains, and nothing flows between equal temperatures") {
    const auto packed = periodic_bed();
    const warm_bed bed(packed, diameter, 2.5);
    const auto list = radiating().links(bed, bed);
    std::vector<double> heat(bed.radius.size(), 0.0);
    std::vector<double> t(heat.size(), 1234.5);
    const auto no_wall = [](int) { return 0.0; };
    auto ledger = accumulate(list, t, no_wall, heat).at(0);
    CHECK(ledger.between == 0);
    CHECK(std::all_of(heat.begin(), heat.end(), [](double q) { return q == 0; }));

    seeded random(9);
    for (double& value : t) value = random.uniform(300, 2500);
    ledger = accumulate(list, t, no_wall, heat).at(0);
    // Each pair adds q and -q: round-off of some hundred thousand sums.
    CHECK(std::fabs(std::accumulate(heat.begin(), heat.end(), 0.0)) < 1e-13 * ledger.between);
    CHECK(ledger.between > 0);
}

TEST_CASE("radiation: grey particles exchange less, by the bed's factor") {
    const auto packed = periodic_bed(0.58);
    const warm_bed bed(packed, diameter, 2.5);
    radiation_params grey;
    grey.emissivity = 0.65;
    const auto dull = radiating(grey).links(bed, bed), black = radiating().links(bed, bed);
    REQUIRE(dull.pairs.size() == black.pairs.size());
    // Ray tracing with reflection: 0.619 at 0.65.
    CHECK(dull.pairs[7].link.radiation == doctest::Approx(0.619 * black.pairs[7].link.radiation).epsilon(1e-12));
}

TEST_CASE("radiation: unequal spheres exchange the same area from both sides") {
    warm_bed bed(2);
    bed.radius = {0.008, 0.00975};
    bed.near = {{0, 1, 0.018}};
    const radiation term{closure::feng_han::monte_carlo_fit{}};
    const view<warm_bed> p(bed, 0), q(bed, 1);
    CHECK(term.pair_area(p, q, 0.018) == term.pair_area(q, p, 0.018));
}

TEST_CASE("radiation: parameters out of range are refused") {
    const auto refuse = [](auto set) {
        radiation_params params;
        set(params);
        CHECK_THROWS_AS(radiation(closure::feng_han::monte_carlo_fit{}, params), bad_value);
    };
    const double nan = std::nan("");
    for (const double bad : {nan, 0.0, -1.0, 1.5}) refuse([&](auto& p) { p.emissivity = bad; });
    for (const double bad : {nan, 0.5, 4.5}) refuse([&](auto& p) { p.cutoff = bad; });
    for (const double bad : {nan, 0.0, 1.0}) refuse([&](auto& p) { p.solid_fraction = bad; });
    for (const double bad : {nan, 0.0, -3.0}) refuse([&](auto& p) { p.surroundings = bad; });
    for (const double bad : {nan, -0.1, 1.1}) refuse([&](auto& p) { p.open_from = bad; });
}

}  // namespace
