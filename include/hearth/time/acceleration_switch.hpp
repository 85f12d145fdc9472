// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <hearth/core/error.hpp>
#include <hearth/time/tssm.hpp>

namespace hearth {

/// Gives each particle its Gamma: that of the bed while it rests on others, 1 while it flies.  A particle in flight
/// moves at its true speed, so at Gamma 678 one metre of fall would give it 98.6 % of the gas's lead in temperature
/// instead of 0.6 %.
///
/// Hysteresis on the number of contacts: a particle settles after `patience` updates in a row with at least
/// `contacts_to_settle`, and takes off after as many with at most `contacts_to_leave`.  So neither a collision in the
/// air nor one that rattles in the bed switches it.  The switch changes no temperature, mass or composition: it injects
/// nothing.
class acceleration_switch {
  public:
    struct params {
        int contacts_to_settle = 2;  ///< a collision in flight is with one
        int contacts_to_leave = 0;
        int patience = 10;  ///< updates in a row
    };

    /// Throws bad_value for a factor below 1, and for limits that leave no hysteresis.
    explicit acceleration_switch(double acceleration_factor) : acceleration_switch(acceleration_factor, params()) {}
    acceleration_switch(double acceleration_factor, params settings) : bed_(acceleration_factor), params_(settings) {
        detail::check_acceleration_factor(acceleration_factor);
        if (!(params_.contacts_to_leave >= 0))
            throw bad_value("contacts_to_leave", bad_value::no_index, params_.contacts_to_leave, ">= 0");
        if (!(params_.contacts_to_settle > params_.contacts_to_leave))
            throw bad_value("contacts_to_settle", bad_value::no_index, params_.contacts_to_settle,
                            "> contacts_to_leave");
        if (!(params_.patience >= 1)) throw bad_value("patience", bad_value::no_index, params_.patience, ">= 1");
    }

    /// Adds particles at the end, in flight or at rest in the bed.
    void append(std::size_t count, bool in_flight) {
        factors_.resize(factors_.size() + count, in_flight ? 1.0 : bed_);
        streak_.resize(factors_.size(), 0);
    }

    /// Removes particle i by moving the last one into its place.
    void remove(std::size_t i) {
        factors_[i] = factors_.back();
        streak_[i] = streak_.back();
        factors_.pop_back();
        streak_.pop_back();
    }

    /// One update with the number of contacts of every particle, walls included.  Returns how many switched.
    template <class Counts>
    std::size_t update(const Counts& contact_counts) {
        std::size_t switched = 0;
        for (std::size_t i = 0; i < factors_.size(); ++i) {
            const auto contacts = static_cast<int>(contact_counts[i]);
            const bool flies = in_flight(i);
            const bool wants = flies ? contacts >= params_.contacts_to_settle : contacts <= params_.contacts_to_leave;
            streak_[i] = wants ? streak_[i] + 1 : 0;
            if (streak_[i] < params_.patience) continue;
            factors_[i] = flies ? bed_ : 1.0;
            streak_[i] = 0;
            ++switched;
        }
        return switched;
    }

    bool in_flight(std::size_t i) const { return factors_[i] < bed_; }
    /// Gamma of every particle, for tssm_per_particle.
    const std::vector<double>& factors() const { return factors_; }

  private:
    double bed_;
    params params_;
    std::vector<double> factors_;
    std::vector<int> streak_;
};

}  // namespace hearth
