// SPDX-License-Identifier: MIT
// What a scene is said to become, beside what it becomes.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "coarse_column.hpp"

using namespace hearth::furnace;

TEST_CASE("foresee: the cells told are those that are built, with and without free space, pipe, burners and grading") {
    settings base = short_shaft(4, 0.2);
    base.bed.coarse_graining = 10;
    const std::vector<std::vector<std::string>> scenes{
        {},
        {"mesh.cells_across=7", "mesh.axial_size_m=0.09", "mesh.axial_size_burners_m=0.013"},
        {"mesh.cells_across=13", "mesh.axial_size_bottom_m=0.2", "mesh.axial_size_burners_m=0.2"},
        {"shaft.hopper_height_m=0"},
        {"shaft.hopper_height_m=0", "burners.feed=section", "mesh.axial_size_bottom_m=0.031"},
        {"shaft.hopper_height_m=2", "shaft.offgas_pipe_diameter_m=0.5", "mesh.axial_size_m=0.07"},
        {"shaft.offgas_pipe_diameter_m=0.11", "mesh.cells_across=24"},  // a pipe as narrow as a face of the wall
        {"shaft.offgas_pipe_diameter_m=5"},  // wider than the free space: as wide as it can be
        {"burners.height_m=0.5"},            // too low for cells of their own
        {"burners.count=0", "burners.mass_flow_kg_per_s=0"},
        {"bed.packing=dense", "bed.motion=plug", "shaft.hopper_fill_m=1", "bed.void_fraction=0.46"},
    };
    for (const auto& keys : scenes) {
        settings scene = base;
        set_keys(scene, keys);
        CAPTURE(document(scene));
        CHECK(foresee(scene).cells == static_cast<std::int64_t>(furnace(scene).cells().cells.size()));
    }
}

TEST_CASE("foresee: a shaft that has no mesh is refused before anything is built") {
    settings scene = short_shaft(4, 0.2);
    set_keys(scene, {"shaft.offgas_pipe_diameter_m=0.01"});
    CHECK_THROWS_WITH_AS(foresee(scene), doctest::Contains("mesh: "), bad_scene);
}

TEST_CASE("foresee: each further rank holds the mesh and the places of all once more") {
    const settings scene = short_shaft(4, 0.2);
    const plan one = foresee(scene), three = foresee(scene, 3);
    // Of a cell six faces, half each, with owner, neighbour, area and centre, and its own volume and centre: 30 numbers.
    CHECK(three.memory - one.memory > 2 * 8.0 * (30 * static_cast<double>(one.cells) + 4 * static_cast<double>(one.parcels)));
    CHECK(three.cells == one.cells);
}

TEST_CASE("foresee: stones in the hopper cost memory of their own") {
    settings scene = short_shaft(4, 0.2);
    set_keys(scene, {"bed.packing=dense", "bed.motion=plug"});
    const plan without = foresee(scene);
    set_keys(scene, {"shaft.hopper_fill_m=3"});  // as many as in the shaft
    const plan with = foresee(scene);
    CHECK(with.waiting == with.parcels);
    CHECK(with.parcels == without.parcels);
    // A parcel is its sphere, mass and fields at least: 20 numbers.
    CHECK(with.memory - without.memory > 160.0 * static_cast<double>(with.waiting));
}
