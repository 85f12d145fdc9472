// SPDX-License-Identifier: MIT
// A bed that DEM moves all the time, in a short shaft of few parcels.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/furnace/spinel.hpp>

#include "coarse_column.hpp"

using namespace hearth::furnace;

namespace {

constexpr double pi = 3.14159265358979323846;

/// Two metres of the paper's shaft.  Parcels ten times softer than the paper's, so that DEM's clock is not Gamma alone.
settings moving_shaft(bed_motion motion) {
    settings scene = short_shaft(4, 0.25);
    scene.shaft.height = 2;
    scene.burners.height = 1.3;
    scene.bed.motion = motion;
    scene.bed.coarse_graining = 8;
    scene.bed.softened_modulus = 3.77e7;
    scene.bed.recording_acceleration_factor = 300;
    scene.time.acceleration_factor = 300;
    scene.time.couplings = 20;
    scene.time.residence_times = 0.8;
    scene.time.balance_tolerance = 1;
    return scene;
}

double mass_of(double diameter) { return 3580 * pi / 6 * diameter * diameter * diameter; }

/// Mean temperatures of the last ten couplings [K].
struct outcome {
    double peak, product;
};
outcome outcome_of(const furnace& shaft) {
    const saved_state state = shaft.save();
    const auto last_ten = [&](const char* name) {
        const std::vector<double>& all = state.at(name);
        return std::accumulate(all.end() - 10, all.end(), 0.0) / 10;
    };
    return {last_ten("past/peak"), spinel::temperature(last_ten("past/product_enthalpy") / last_ten("past/product"))};
}

}  // namespace

TEST_CASE("driven: flow and mass are exact, heat closes, and the shaft is as hot as one that moves by a recording") {
    const settings scene = moving_shaft(bed_motion::dem);
    const double largest = 8 * 19.5e-3, parcel = mass_of(largest);
    furnace shaft(scene);
    run_couplings(shaft, 1);
    const auto brought = [&] { return shaft.save().at("motion/feed").at(4); };  // [kg]
    const auto product = [&] { return shaft.save().at("past/product").back(); };
    const double first = brought(), from = shaft.now().process_time;
    double out = 0, least = *shaft.summarise().bed_mass, most = least, previous = least;
    for (int k = 1; k < scene.time.couplings; ++k) {
        shaft.step();
        CAPTURE(k);
        out += product();
        // Feed and discharge each wait for the next parcel, and the discharge for it to pass the exit.
        const double due = scene.particles.mass_flow * (shaft.now().process_time - from);
        CHECK(std::abs(brought() - first - due) < parcel);
        CHECK(std::abs(out - due) < 2 * parcel);
        const double mass = *shaft.summarise().bed_mass;
        CHECK(std::abs(mass - previous) < 0.05 * mass);
        least = std::min(least, mass);
        most = std::max(most, mass);
        previous = mass;
        // Who still falls is not of the bed: the feed begins 2.5 parcels above it.
        double top = 0;
        for (const auto& x : shaft.look().particle_position) top = std::max(top, x[2]);
        CHECK(top > scene.shaft.height - largest);
        CHECK(top < scene.shaft.height + 2.5 * largest);
    }
    // Feed and discharge keep the sum of bed and falling parcels to a parcel each.  The bed lacks those that fall: from
    // the top of the feed, 8.5 parcels up and as fast as after a fall of one, this takes (sqrt(9.5) - 1) sqrt(2 d / g),
    // with g a tenth of the earth's as the parcels are ten times too soft; Gamma is 300, the clock slower by the root
    // of ten.
    const double flight = (std::sqrt(9.5) - 1) * std::sqrt(2 * largest / 0.981) * 300 * std::sqrt(0.1);
    MESSAGE("bed from " << least << " to " << most << " kg, falling at most " << flight * scene.particles.mass_flow);
    CHECK(most - least < flight * scene.particles.mass_flow + 3 * parcel);
    const summary books = shaft.summarise();
    CHECK(std::abs(*books.solid_mass_imbalance) < 1e-12);
    CHECK(std::abs(*books.enthalpy_audit) < 1e-3 * *books.fuel_power);
    CHECK(std::abs(*books.gas_mass_imbalance) < 1e-6);
    for (const std::string& warning : books.warnings) CHECK(warning.find("feed") == std::string::npos);
    CHECK(foresee(scene).motion_steps > 0);

    // The two beds are packings of their own.  Over eight seeds the peak was 1767 +- 13 K and 1770 +- 16 K of
    // recordings, the product 777 +- 4 K and 785 +- 9 K: three standard deviations of a difference.
    furnace other(moving_shaft(bed_motion::recorded));
    run_couplings(other, scene.time.couplings);
    const outcome driven = outcome_of(shaft), recorded = outcome_of(other);
    MESSAGE("peak " << driven.peak << " K, of the recording " << recorded.peak);
    MESSAGE("product " << driven.product << " K, of the recording " << recorded.product);
    CHECK(std::abs(driven.peak - recorded.peak) < 60);
    CHECK(std::abs(driven.product - recorded.product) < 30);
}

TEST_CASE("driven: a feed faster than it finds room for is told, with what waits; mass is exact all the same") {
    settings scene = moving_shaft(bed_motion::dem);
    scene.shaft.height = 1;
    scene.burners.height = 0.6;
    scene.time.couplings = 4;
    const auto told = [&](double acceleration_factor) {
        scene.time.acceleration_factor = acceleration_factor;
        furnace shaft(scene);
        run_couplings(shaft, scene.time.couplings);
        const summary books = shaft.summarise();
        CHECK(std::abs(*books.solid_mass_imbalance) < 1e-12);
        return std::count_if(books.warnings.begin(), books.warnings.end(), [](const std::string& warning) {
            return warning.find("the feed has found no room for ") == 0 && warning.find("time.acceleration_factor") != std::string::npos;
        });
    };
    CHECK(told(200) == 0);
    // Parcels cannot fall in as fast as this bed sinks: at 2000 they still could.
    CHECK(told(4500) == 1);
}

TEST_CASE("driven: a state that does not fit is refused and changes nothing; scenes without DEM or flow are refused") {
    settings scene = moving_shaft(bed_motion::dem);
    scene.shaft.height = 1;
    scene.burners.height = 0.6;
    scene.time.residence_times = 0.1;
    furnace shaft(scene);
    run_couplings(shaft, 1);
    const saved_state good = shaft.save();
    for (const char* name : {"motion/numbers", "motion/state", "motion/feed", "motion/outflow"}) {
        saved_state lacking = good, damaged = good;
        lacking.erase(name);
        damaged.at(name).pop_back();
        CHECK_THROWS_WITH_AS(shaft.restore(lacking), (std::string("the state lacks ") + name).c_str(), bad_scene);
        CHECK_THROWS_AS(shaft.restore(damaged), bad_scene);
        CHECK(same_bits(timeless(shaft.save()), timeless(good)));
    }
    CHECK_THROWS_WITH_AS(set_keys(scene, {"bed.packing=lattice"}),
                         "bed.motion is \"dem\", allowed with bed.packing = \"dem\": DEM moves what it has packed",
                         bad_scene);
    CHECK_THROWS_AS(set_keys(scene, {"particles.mass_flow_kg_per_h=0"}), bad_scene);
}
