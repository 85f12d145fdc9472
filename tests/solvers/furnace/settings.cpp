// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/furnace/settings.hpp>

using namespace hearth::furnace;

namespace {

std::string complaint(const std::string& text) {
    try {
        parse_scene(text, "my.toml");
    } catch (const bad_scene& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("scene: what a file does not name is the furnace of the paper") {
    const settings scene = parse_scene("");
    CHECK(scene.shaft.height == 10);
    CHECK(scene.particles.mass_flow == doctest::Approx(3000.0 / 3600).epsilon(1e-15));
    CHECK(scene.time.acceleration_factor == 678);
}

TEST_CASE("scene: keys are read in their own units") {
    const settings scene = parse_scene(R"(
        title = "hot"
        particles.mass_flow_kg_per_h = 1800
        [burners]
        diameter_mm = 20
        count = 6
        [physics]
        combustion = "mixed_is_burnt"
        radiation = false
        [time]
        acceleration_factor = 50
        [[wall.zone]]
        z_min_m = 0
        z_max_m = 5
        transmittance_W_per_m2K = 2
        ambient_temperature_K = 320
        [[wall.zone]]
        z_min_m = 5
        z_max_m = 10
        transmittance_W_per_m2K = 4
        ambient_temperature_K = 330
    )");
    CHECK(scene.title == "hot");
    CHECK(scene.particles.mass_flow == doctest::Approx(0.5).epsilon(1e-15));
    CHECK(scene.burners.diameter == doctest::Approx(0.02).epsilon(1e-15));
    CHECK(scene.burners.count == 6);
    CHECK(scene.physics.combustion == burning::mixed_is_burnt);
    CHECK_FALSE(scene.physics.radiation);
    CHECK(scene.time.acceleration_factor == 50);
    REQUIRE(scene.shaft.zones.size() == 2);
    CHECK(scene.shaft.zones[1].ambient_temperature == 330);
}

TEST_CASE("scene: every mistake is told with its place, its value and what is allowed") {
    CHECK(complaint("[burners]\ncount = 3\nheigth_m = 8") ==
          "my.toml:3: burners.heigth_m is not a key of a scene; the nearest one is burners.height_m");
    CHECK(complaint("[voidage]\nthreshold = 1.5") == "my.toml:2: voidage.threshold is 1.5, allowed: 0.1 to 1");
    CHECK(complaint("[voidage]\nthreshold = nan") == "my.toml:2: voidage.threshold is nan, allowed: 0.1 to 1");
    CHECK(complaint("[voidage]\nthreshold = \"x\"") == "my.toml:2: voidage.threshold is not a number");
    CHECK(complaint("[bed]\nmotion = \"fast\"") == "my.toml:2: bed.motion is \"fast\", allowed: dem, recorded, plug, frozen");
    CHECK(complaint("[bed]\npacking = \"lattice\"").find("bed.motion is \"recorded\", allowed with bed.packing = \"dem\"") != std::string::npos);
    // Nothing is taken that the program does not do.
    CHECK(complaint("[physics]\ncombustion = \"magic\"") ==
          "my.toml:2: physics.combustion is \"magic\", allowed: none, mixed_is_burnt, equilibrium, jones_lindstedt");
    CHECK(complaint("[voidage]\nmethod = \"smoother\"") == "my.toml:2: voidage.method is \"smoother\", allowed: filtered, vfs");
    CHECK(complaint("physics.turbulence = true").find("my.toml:1: physics.turbulence is not a key of a scene") == 0);
    CHECK(complaint("[burners]\ncount = 2.5") == "my.toml:2: burners.count is not a whole number");
    CHECK(complaint("[physics]\nradiation = 1") == "my.toml:2: physics.radiation is neither true nor false");
    CHECK(complaint("cell_across = 9") == "my.toml:1: cell_across is not a key of a scene; the nearest one is mesh.cells_across");
    CHECK(complaint("[time]\nacceleration_factor = \"fast\"") == "my.toml:2: time.acceleration_factor is neither a number nor \"auto\"");
    CHECK(complaint("[[wall.zone]]\nz_min_m = 0\nz_max_m = 1\nambient_temperature_K = 300") ==
          "my.toml:1: an entry of wall.zone lacks transmittance_W_per_m2K");
    CHECK(complaint("\nkind = \"silo\"") == "my.toml:2: kind is \"silo\", allowed here: furnace");
    CHECK(complaint("kind = \"furnace\"").empty());
    CHECK(complaint("[shaft\n").find("my.toml:1: ") == 0);
    CHECK(complaint("[[particles.size]]\ndiameter_mm = 16\nmass_share = 0.5") ==
          "particles.size: the mass shares sum to 0.5, allowed: 1");
    CHECK(complaint("burners.height_m = 11") == "burners.height_m is 11, allowed: below the top of the shaft, 10");
    CHECK(complaint("burners.equivalence_ratio = 1.2\nphysics.combustion = \"mixed_is_burnt\"") ==
          "burners.equivalence_ratio is 1.2, allowed: at most 1, or physics.combustion = \"equilibrium\" or \"jones_lindstedt\"");
    CHECK_THROWS_WITH_AS(read_scene("no/such/file.toml"), "no/such/file.toml: cannot be opened: No such file or directory", bad_scene);
}

TEST_CASE("scene: --set changes a key, or nothing") {
    settings scene;
    set_keys(scene, {"mesh.cells_across=40"});
    CHECK(scene.mesh.across == 40);
    set_keys(scene, {"bed.motion=plug", "bed.packing=\"lattice\""});
    CHECK(scene.bed.packing == bed_packing::lattice);
    set_keys(scene, {"bed.packing=dem"});  // as a shell hands it over
    CHECK(scene.bed.packing == bed_packing::dem);
    set_keys(scene, {"physics.radiation=false"});
    CHECK_FALSE(scene.physics.radiation);
    CHECK_THROWS_WITH_AS(set_keys(scene, {"bed.motion"}), "--set bed.motion: is not KEY=VALUE", bad_scene);
    CHECK_THROWS_WITH_AS(set_keys(scene, {"mesh.cells_across=1"}),
                         "--set mesh.cells_across=1: mesh.cells_across is 1, allowed: 4 to 1000", bad_scene);
    CHECK(scene.mesh.across == 40);
}

TEST_CASE("scene: keys of --set that are right together are taken in any order, and one that is wrong is named") {
    const std::vector<std::string> right{"bed.packing=dense", "bed.motion=plug", "shaft.hopper_fill_m=2"};
    std::vector<std::string> order{right};
    std::sort(order.begin(), order.end());
    std::string first;
    do {
        settings scene;
        set_keys(scene, order);
        CHECK(scene.bed.packing == bed_packing::dense);
        if (first.empty()) first = document(scene);
        CHECK(document(scene) == first);
    } while (std::next_permutation(order.begin(), order.end()));

    settings scene;
    const std::string before = document(scene);
    const auto refused = [&](const std::string& wrong, const std::string& why) {
        for (std::size_t at = 0; at <= right.size(); ++at) {
            std::vector<std::string> all = right;
            all.insert(all.begin() + static_cast<std::ptrdiff_t>(at), wrong);
            CHECK_THROWS_WITH_AS(set_keys(scene, all), ("--set " + wrong + ": " + why).c_str(), bad_scene);
        }
        CHECK(document(scene) == before);
    };
    refused("bed.pcking=dem", "bed.pcking is not a key of a scene; the nearest one is bed.packing");
    refused("bed.coarse_graining=11", "bed.coarse_graining is 11, allowed: 1 to 10");
    refused("burners.count=many", "burners.count is not a whole number");
    refused("physics.radiation=1", "physics.radiation is neither true nor false");
    // Two that do not go together are told as what they are: a scene that is wrong, whoever said which part of it.
    CHECK_THROWS_WITH_AS(set_keys(scene, {"bed.motion=recorded", "bed.packing=dense"}),
                         doctest::Contains("bed.motion is \"recorded\", allowed with bed.packing = \"dem\""),
                         bad_scene);
    CHECK(document(scene) == before);
}

TEST_CASE("scene: its document reads back as the same scene, and its hash tells scenes apart") {
    settings scene;
    scene.particles.mass_flow = 0.1234567890123;
    scene.bed.packing = bed_packing::lattice;
    scene.bed.motion = bed_motion::plug;
    scene.time.acceleration_factor = 50;
    scene.shaft.zones = {{0, 2, 1, 310}, {2, 9, 2.5, 333}};
    const settings again = parse_scene(document(scene));
    CHECK(document(again) == document(scene));
    CHECK(hash(again) == hash(scene));
    CHECK(hash(again) != hash(settings{}));
}
