// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/core/error.hpp>
#include <hearth/time/tssm.hpp>

namespace hearth {

/// Books what gas and particles gain and what comes through the boundary, in the one way that closes under every form
/// of time scale splitting.  With a Gamma per particle no state function is conserved, so the ledger is one of
/// increments:
///
///     s dE_gas + sum_p dE_p / Gamma_p = boundary
///
/// E may be enthalpy [J], mass [kg], or the mass of a species [kg].  A change of Gamma changes no E, so the switch of a
/// particle between flight and bed books nothing.  Sums are compensated (Neumaier).
class tssm_ledger {
  public:
    /// s as the clock gives it.
    explicit tssm_ledger(double gas_storage_factor = 1.0) : storage_(gas_storage_factor) {
        if (!(storage_ >= 0.0 && storage_ <= 1.0))
            throw bad_value("gas_storage_factor", bad_value::no_index, storage_, "in [0, 1] [-]");
    }

    /// Increase of the gas's content.
    void gas(double increment) { stored_.add(storage_ * increment); }
    /// Increase of a particle's content, and the particle's factor while it took place.
    void particle(double increment, double acceleration_factor) { stored_.add(increment / acceleration_factor); }
    /// What came in through the boundary in model time: gas inflow, and heat of walls and surroundings to gas or bed,
    /// once (not times Gamma); the content of fed particles over their Gamma.
    void boundary(double amount) { supplied_.add(amount); }

    /// Left side less right side.
    double imbalance() const { return stored_.value() - supplied_.value(); }
    /// Sum of the magnitudes of all entries: what to compare the imbalance with.
    double turnover() const { return stored_.magnitude + supplied_.magnitude; }
    /// Imbalance over turnover [-]; 0 when nothing was booked.
    double relative_imbalance() const {
        const double scale = turnover();
        return scale > 0.0 ? std::fabs(imbalance()) / scale : 0.0;
    }

  private:
    struct compensated {
        double sum = 0.0, lost = 0.0, magnitude = 0.0;
        void add(double term) {
            const double next = sum + term;
            lost += std::fabs(sum) >= std::fabs(term) ? (sum - next) + term : (term - next) + sum;
            sum = next;
            magnitude += std::fabs(term);
        }
        double value() const { return sum + lost; }
    };

    double storage_;
    compensated stored_, supplied_;
};

}  // namespace hearth
