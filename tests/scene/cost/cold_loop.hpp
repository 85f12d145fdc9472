// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace cost {

/// Particles and gas in plain arrays.
struct bed {
    std::ptrdiff_t count;
    const double* radius;
    const std::array<double, 3>* velocity;
    std::array<double, 3>* force;
};
struct gas {
    const double* void_fraction;
    const double* density;
    const double* viscosity;
    const std::array<double, 3>* velocity;
    const std::array<double, 3>* pressure_gradient;
    std::array<double, 3>* force;
};

void by_scene(bed&, gas&, std::array<double, 6>& ledger);
void by_hand(bed&, gas&, std::array<double, 6>& ledger);

}  // namespace cost
