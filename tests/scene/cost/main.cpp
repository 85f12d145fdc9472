// SPDX-License-Identifier: MIT
// Runs the cold bed by a scene and by hand on the same random bed; fails where they differ by more than round-off.
// callgrind counts the instructions of each function; see cost.cmake.
#include <cmath>
#include <cstdio>
#include <vector>

#include "scene/cost/cold_loop.hpp"
#include "support/random.hpp"

int main() {
    const std::size_t count = 10000;
    using vectors = std::vector<std::array<double, 3>>;
    hearth_test::seeded random(1);
    std::vector<double> radius(count), void_fraction(count), density(count, 1.2), viscosity(count, 1.8e-5);
    vectors velocity(count), wind(count), gradient(count), force[2], reaction[2];
    for (std::size_t i = 0; i < count; ++i) {
        radius[i] = random.uniform(0.004, 0.01);
        void_fraction[i] = random.uniform(0.35, 0.5);
        for (std::size_t a = 0; a < 3; ++a) {
            velocity[i][a] = random.uniform(-1, 1);
            wind[i][a] = random.uniform(-2, 2);
            gradient[i][a] = random.uniform(-1000, 1000);
        }
    }
    std::array<double, 6> ledger[2];
    for (const int k : {0, 1}) {
        force[k].assign(count, {});
        reaction[k].assign(count, {});
        cost::bed bed{static_cast<std::ptrdiff_t>(count), radius.data(), velocity.data(), force[k].data()};
        cost::gas gas{void_fraction.data(), density.data(),  viscosity.data(),
                      wind.data(),          gradient.data(), reaction[k].data()};
        (k == 0 ? cost::by_scene : cost::by_hand)(bed, gas, ledger[k]);
    }
    double difference = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t a = 0; a < 3; ++a)
            difference = std::fmax(difference, std::fabs(force[0][i][a] - force[1][i][a]) +
                                                   std::fabs(reaction[0][i][a] - reaction[1][i][a]));
    for (std::size_t a = 0; a < 6; ++a)
        difference = std::fmax(difference, std::fabs(ledger[0][a] - ledger[1][a]) / count);
    std::printf("largest difference %g N\n", difference);
    return difference < 1e-12 ? 0 : 1;
}
