// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include <hearth/furnace/furnace.hpp>

int main() {
    namespace hf = hearth::furnace;
    // A furnace in code: what is not set is the furnace of the paper.
    hf::settings scene;
    scene.shaft.height = 3;
    scene.shaft.hopper_height = 0;
    scene.burners.height = 2;
    scene.bed.motion = hf::bed_motion::plug;
    scene.physics.combustion = hf::burning::mixed_is_burnt;
    scene.bed.coarse_graining = 10;
    scene.mesh.across = 4;
    scene.mesh.axial_size = 0.3;
    scene.mesh.axial_size_bottom = scene.mesh.axial_size_burners = 0.15;
    scene.time.couplings = 6;
    scene.time.residence_times = 0.05;
    hf::furnace shaft(scene);

    double hottest_before = 0;
    while (!shaft.done()) {
        shaft.step();  // DEM packs the bed first; then each step is a coupling
        if (shaft.steps_done() == 0) continue;
        const hf::status now = shaft.now();
        std::printf("%5.0f s: peak %.0f K, off-gas %.0f K\n", now.process_time, now.peak_particle_temperature, now.offgas_temperature);
        if (shaft.steps_done() == 3) {
            hottest_before = now.maximum_gas_temperature;
            shaft.set_burner_flow(0);  // somebody shuts the burners while it runs
        }
    }
    const hf::snapshot seen = shaft.look();
    const double hottest = *std::max_element(seen.gas_temperature.begin(), seen.gas_temperature.end());
    std::printf("%zu cells, hottest gas %.0f K, with burners %.0f K\n", seen.gas_temperature.size(), hottest, hottest_before);
    return hottest < hottest_before ? 0 : 1;
}
