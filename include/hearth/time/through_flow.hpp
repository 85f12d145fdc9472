// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/core/function.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/time/particle_energy.hpp>

namespace hearth {

/// Gas that flows through a cell with particles, solved exactly along its way:
///
///     m c dT/dx = hA/L (T_solid - T) + S/L (T_before - T)
///
/// m c: heat capacity flow; hA: conductance to the particles; S = s C / step: storage of the gas in the cell, which
/// lags by one step (s of the clock, C = volume times void fraction times density times specific heat).  A cell many
/// transfer units long, in which gas and bed exchange all they can, is as exact as a short one.
///
/// To the particles the cell is a bath of conductance() at temperature(); after their step, settle() says where the gas
/// is. What the gas loses is what the particles get, to round-off.  March cells along the stream, outlet to inlet.
template <class Real = double>
class through_flow {
  public:
    /// All >= 0 [W/K] and capacity_flow > 0; temperatures [K].
    HEARTH_FUNCTION through_flow(Real capacity_flow, Real conductance, Real storage, Real inlet, Real before)
        : conductance_(conductance), inlet_(inlet), before_(before) {
        const Real units = (conductance + storage) / capacity_flow;
        entering_ = -std::expm1(-units);
        fresh_ = units > Real(0) ? entering_ / units : Real(1);
        solid_ = units > Real(0) ? conductance / (conductance + storage) : Real(0);
        stored_ = units > Real(0) ? storage / (conductance + storage) : Real(1);
    }

    /// Conductance from the particles to the gas as it enters and as it was [W/K]; at most m c + S.
    HEARTH_FUNCTION Real conductance() const { return conductance_ * weight(); }

    /// The temperature that it leads to [K].
    HEARTH_FUNCTION Real temperature() const {
        return inlet_ + (Real(1) - fresh_) * stored_ / weight() * (before_ - inlet_);
    }

    HEARTH_FUNCTION heat_bath<Real> bath() const {
        heat_bath<Real> result;
        result.add(conductive_link<Real>{conductance()}, temperature());
        return result;
    }

    struct outcome {
        Real mean;    ///< mean temperature of the gas in the cell, which it stores [K]
        Real outlet;  ///< [K]
    };

    /// Gas after the particles took `heat_rate` from it: their heat over Gamma over the step of the model [W].
    HEARTH_FUNCTION outcome settle(Real heat_rate) const {
        // The mean temperature of the solid that belongs to this heat, and that which the gas tends to.
        const Real solid = conductance_ > Real(0) ? temperature() - heat_rate / conductance() : before_;
        const Real target = before_ + solid_ * (solid - before_);
        return {target + fresh_ * (inlet_ - target), inlet_ + entering_ * (target - inlet_)};
    }

  private:
    // All parts of the gas's mean are positive, so no digits are lost, however long the cell.
    HEARTH_FUNCTION Real weight() const { return stored_ + fresh_ * solid_; }

    Real conductance_, inlet_, before_;
    Real entering_;  // 1 - exp(-n), n: transfer units of the cell with storage
    Real fresh_;     // share of the inlet in the mean of the gas
    Real solid_;     // share of the solid in what the gas tends to
    Real stored_;    // share of the gas as it was
};

}  // namespace hearth
