// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <hearth/combustion/species.hpp>

#include "support/random.hpp"

namespace hearth::combustion {

/// Amounts [mol/kg] of methane and air (O2 : N2 = 1 : 3.76) at an equivalence ratio.
inline per_species methane_air(double equivalence_ratio) {
    return amounts_from_moles({equivalence_ratio, 2, 2 * 3.76, 0, 0, 0, 0});
}

/// Any mixture: each species absent, a trace down to 1e-12, or present.  [mol/kg]
inline per_species any_mixture(hearth_test::seeded& random) {
    per_species x{};
    while (!(sum(x) > 0))
        for (double& part : x) {
            const double kind = random.uniform(0, 1);
            part = kind < 0.3 ? 0 : kind < 0.5 ? random.log_uniform(1e-12, 1) : random.uniform(0, 1);
        }
    return amounts_from_moles(x);
}

/// A hot, lean or rich mixture in which everything is present.  [mol/kg]
inline per_species burning_mixture(hearth_test::seeded& random) {
    per_species x;
    for (double& part : x) part = random.uniform(0.01, 0.1);
    x[N2] = 0.7;
    return amounts_from_moles(x);
}

}  // namespace hearth::combustion
