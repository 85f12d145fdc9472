// SPDX-License-Identifier: MIT
// A bed between plates, 10 K above and below a temperature, against what was measured: Fig. 3 of Spijker et al. 2023.
#include <cmath>

#include <doctest/doctest.h>

#include "solvers/dem/plates.hpp"

using namespace hearth_test;

namespace {

plate_bed& grains_between_plates() {
    static plate_bed made(1, 9 * iron::diameter, 30 * iron::diameter, 0.3);
    return made;
}

/// Share of the radiative conductivity of a bed of black spheres, k = 4 sigma F_E D T^3, over the solid fraction: own Monte
/// Carlo of gravity-settled packings, the same as behind closure::feng_han::monte_carlo_fit.
double exchange_factor(double solid) {
    constexpr std::array<double, 4> at{0.57671, 0.59292, 0.61780, 0.63687}, factor{1.06765, 1.04145, 1.00659, 0.97567};
    std::size_t k = 0;
    while (k + 2 < at.size() && solid > at[k + 1]) ++k;
    return factor[k] + (factor[k + 1] - factor[k]) * (solid - at[k]) / (at[k + 1] - at[k]);
}

}  // namespace

TEST_CASE("Yagi and Kunii: iron spheres of 11 mm conduct within 25 % of their Eq. 15 from 400 to 1100 K") {
    CHECK(std::fabs(iron::yagi_kunii(308.85, 1.0, 0.9) / iron::gas_conductivity(308.85) / 19.73 - 1) < 0.02);  // their Fig. 13
    CHECK(std::fabs(iron::yagi_kunii(308.85, 0.9, 0.9) / iron::gas_conductivity(308.85) / 17.93 - 1) < 0.02);
    plate_bed& made = grains_between_plates();
    CHECK(std::fabs(made.solid - 0.60) < 0.012);
    conductivity_parts last;
    for (const double kelvin : {400.0, 600.0, 800.0, 1000.0, 1100.0}) {
        const conductivity_parts found = conductivity_between_plates(made, kelvin, 0.95);
        MESSAGE(kelvin << " K: contacts " << found.contact << ", films " << found.film << ", radiation " << found.radiation
                       << ", all " << found.core() << " W/(m K); Eq. 15 from " << iron::yagi_kunii(kelvin, 0.9, 0.9)
                       << " to " << iron::yagi_kunii(kelvin, 1, 1));
        for (const double beta : {0.9, 1.0})
            for (const double p : {0.9, 1.0}) CHECK(std::fabs(found.core() / iron::yagi_kunii(kelvin, beta, p) - 1) < 0.25);
        // Contacts hardly feel the temperature, films follow the gas, radiation takes over.
        CHECK(found.contact < found.film);
        CHECK(found.radiation > last.radiation);
        CHECK((found.radiation > found.film) == (kelvin > 700));
        CHECK(found.between_plates < found.core());  // the plates resist
        last = found;
    }
}

TEST_CASE("radiation alone: the bed's exchange factor within 3 % at the default cutoff, and of the list to 4 diameters") {
    plate_bed& made = grains_between_plates();
    const double cube = 4 * hearth::constants<double>::stefan_boltzmann() * iron::diameter * 1e9;
    const double found = conductivity_between_plates(made, 1000, 1.0, 2.5, heat_paths::radiation).radiation / cube;
    const double full = conductivity_between_plates(made, 1000, 1.0, 4.0, heat_paths::radiation).radiation / cube;
    MESSAGE("F_E " << found << ", with all to 4 diameters " << full << "; view factors " << exchange_factor(made.solid));
    CHECK(std::fabs(found / exchange_factor(made.solid) - 1) < 0.03);
    CHECK(std::fabs(full / exchange_factor(made.solid) - 1) < 0.03);
    CHECK(std::fabs(found / full - 1) < 0.03);
}

TEST_CASE("parcels: a bed of them conducts, heats up and leaves as one of grains") {
    // The same core in diameters, and the same stress on it: deeper by k, under gravity less by k; it heats k^2 times as long.
    plate_bed& one = grains_between_plates();
    const conductivity_parts grains = conductivity_between_plates(one, 800, 1.0);
    const std::vector<double> alone = mixing_times(one, 300, 1000, 20);
    for (const int k : {2, 3, 4}) {
        plate_bed made(k, 9 * k * iron::diameter, 30 * k * iron::diameter, 0.3, 9.81 / k);
        CHECK(std::fabs(made.solid - one.solid) < 0.006);
        const conductivity_parts parcels = conductivity_between_plates(made, 800, 1.0);
        const std::vector<double> times = mixing_times(made, 300, 1000, 20 * k * k);
        MESSAGE("k = " << k << ": contacts " << parcels.contact / grains.contact << ", films " << parcels.film / grains.film
                       << ", radiation " << parcels.radiation / grains.radiation << "; heating " << times[0] / alone[0] / (k * k)
                       << ", " << times[1] / alone[1] / (k * k));
        // Other packings of 2500 spheres: films and radiation differ by 1 %; contacts by 5 %, for few chains carry the load.
        CHECK(std::fabs(parcels.contact / grains.contact - 1) < 0.10);
        CHECK(std::fabs(parcels.film / grains.film - 1) < 0.03);
        CHECK(std::fabs(parcels.radiation / grains.radiation - 1) < 0.03);
        // As the square of the height, 1 % from packing to packing, over the conductivity, whose contacts are a twelfth.
        for (std::size_t t = 0; t < 2; ++t) CHECK(std::fabs(times[t] / alone[t] / (k * k) - 1) < 0.05);
        const double layer = k * iron::diameter / made.height;
        CHECK(largest_arrears(made, 2 * k) < 0.5 * layer);  // what passed and what is due part by half a layer
    }
}
