// SPDX-License-Identifier: MIT
// Choices that a scene makes beside its numbers: how volume becomes a solid fraction, and Gamma.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "coarse_column.hpp"

using namespace hearth::furnace;

TEST_CASE("voidage: the paper's smoother keeps all solid below its threshold, closes the books and counts what closures do not know") {
    settings scene = coarse_column();
    scene.voidage.method = voidage_method::vfs;
    scene.voidage.threshold = 0.9;
    furnace shaft(scene);
    run_couplings(shaft, 4);
    const snapshot seen = shaft.look();
    double solid = 0, densest = 0;
    for (std::size_t c = 0; c < seen.void_fraction.size(); ++c) {
        solid += seen.cell_volume[c] * (1 - seen.void_fraction[c]);
        densest = std::max(densest, 1 - seen.void_fraction[c]);
        CHECK(std::isfinite(seen.gas_temperature[c]));
    }
    const summary books = shaft.summarise();
    CHECK(densest <= 0.9 + 1e-12);
    CHECK(densest > 0.74);  // a kernel would leave nothing above the densest packing: this is the other method
    CHECK(solid * scene.particles.density == doctest::Approx(*books.bed_mass).epsilon(1e-12));
    CHECK(*books.stranded_volume == 0);
    CHECK(*books.clamped_evaluations > 0);  // Gunn ends at a void fraction of 0.35, and full cells have 0.1
    CHECK(std::any_of(books.warnings.begin(), books.warnings.end(), [](const std::string& w) { return w.find("clamped_evaluations") != std::string::npos; }));
    CHECK(std::abs(*books.enthalpy_audit) < 1e-3 * shaft.now().fuel_power);
    CHECK(*books.element_imbalance < 1e-6);
    for (const double t : seen.particle_temperature) {
        CHECK(t >= 300 - 1e-6);
        CHECK(t <= 2700);
    }
}

TEST_CASE("Gamma: auto is what moves the bed quasi-statically, or 1 where heat is asked to be more exact than a gas at rest is") {
    settings paper;
    paper.bed.coarse_graining = 1;
    paper.bed.packing = bed_packing::lattice;
    paper.bed.motion = bed_motion::plug;
    paper.mesh.axial_size = paper.mesh.axial_size_bottom = paper.mesh.axial_size_burners = 0.5;
    paper.mesh.across = 4;
    set_keys(paper, {"time.acceleration_factor=auto"});
    CHECK(paper.time.acceleration_factor.automatic);
    CHECK(document(paper).find("acceleration_factor = \"auto\"") != std::string::npos);
    CHECK(hash(parse_scene(document(paper))) == hash(paper));

    settings scene = coarse_column();
    set_keys(scene, {"time.acceleration_factor=auto"});
    const furnace column(scene);
    // 0.2 sqrt(g d): parcels of 2.2 times 17.6 mm; stones sink by 166.7 kg/h... 120/h over 3580 * 0.582 * 0.0227 m^2.
    const double d = 1 / (0.2 / 16e-3 + 0.3 / 17e-3 + 0.3 / 18e-3 + 0.2 / 19.5e-3);
    const double speed = 0.04 * 3000 / 3600 / (3580 * 0.582 * 3.14159265358979 / 4 * 0.17 * 0.17);
    CHECK(column.scene().time.acceleration_factor == std::floor(0.2 * std::sqrt(9.81 * 2.2 * d) / speed));
    scene.time.acceleration_tolerance = 1e-6;
    CHECK(furnace(scene).scene().time.acceleration_factor == 1);
}

TEST_CASE("Gamma: one that no bed can follow is told, and changes nothing in a bed that moves as a plug") {
    settings scene = coarse_column();
    const auto run = [&](double acceleration_factor) {
        scene.time.acceleration_factor = acceleration_factor;
        furnace shaft(scene);
        run_couplings(shaft, 2);
        return shaft;
    };
    const furnace slow = run(50), fast = run(1e4);
    const auto told = [](const furnace& shaft) {
        const auto all = shaft.summarise().warnings;
        return std::any_of(all.begin(), all.end(), [](const std::string& w) { return w.find("time.acceleration_factor") == 0; });
    };
    CHECK_FALSE(told(slow));
    CHECK(told(fast));
    const auto one = slow.look().particle_temperature, other = fast.look().particle_temperature;
    double apart = 0;
    for (std::size_t i = 0; i < one.size(); ++i) apart = std::max(apart, std::abs(one[i] - other[i]));
    CHECK(apart < 1e-6);  // of 2200 K, in which Gamma cancels but for rounding
}
