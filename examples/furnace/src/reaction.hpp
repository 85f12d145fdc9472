// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <hearth/combustion/reactor.hpp>
#include <hearth/furnace/settings.hpp>
#include <hearth/gas/solver.hpp>

#include "mixture.hpp"

namespace hearth::furnace {

/// Finite-rate chemistry in a gas that is iterated to a steady state.
///
/// A steady gas has no time step to split, so every cell takes its own: a tenth of the time in which the flow renews
/// its gas.  The reactor runs over that time from the cell's state, adiabatically, and the transport equation pulls the
/// cell towards where it ended, as fast as that time: Y_flow + 10 Y_reacted = 11 Y.  That is the fixed point of a
/// Strang splitting whose steps are that short.  It converges for rates of any size, since each step makes a mean of
/// two mixtures; slow rates are integrated exactly, and of what reacts at once a cell keeps an eleventh of what came
/// in.
///
/// A gas without storage forgets the hot gas that lights a furnace.  So a scene that starts cold has an igniter: around the burners,
/// where the stones are below 1200 K, gas reacts as if it had the temperature of ignition.  It adds no heat.
class reaction {
  public:
    explicit reaction(const settings& scene);

    /// Fills the solver's sources of conversion, from the gas as it is.
    void update(gas::solver& solver, const reacting_mixture& mixture);

    std::int64_t reacting = 0;    ///< cells that the last update computed; the others are too cold or have nothing left
    std::int64_t unfinished = 0;  ///< of all updates: cells left as they were, since the integration did not finish
    std::int64_t first_unfinished = -1;  ///< cell

    static constexpr double share_of_renewal = 0.1;    ///< the step over the time that renews a cell's gas [-]
    static constexpr double lowest_temperature = 900;  ///< below, no cell reacts [K]
    static constexpr double dissociates_from = 1500;   ///< above, products make CO and H2 [K]

  private:
    combustion::jones_lindstedt mechanism_;
    combustion::tolerance accuracy_{1e-3, 1e-6};
    bool bed_mixes_;
    double igniter_ = 0, igniter_height_;  // [K], 0: none; [m]
};

}  // namespace hearth::furnace
