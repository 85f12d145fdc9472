// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <hearth/core/error.hpp>

namespace hearth {

/// Time Scale Splitting (Pollhammer's TSSM; Spijker & Raupenstrauch 2023, Eqs. 13-16, doi:10.1002/ceat.202200617): the
/// bed lives Gamma seconds of the process while the gas and the motion live one second of the model.
///
/// This file is the one place that says what carries Gamma.  A clock has
///
///     factor(i)               Gamma of particle i [-].  Multiplies EVERY rate into the particle: convection,
///     conduction
///                             and radiation with particles, walls and surroundings, drying, reaction.
///                             // Paper: Eqs. 14 and 15 print it for convection and species only; here: all of them,
///                             // because a mechanism left out falls behind by Gamma and shifts the steady state.
///     feed_factor()           Gamma of the bed [-].  Multiplies the mass flow of feed and discharge (Eq. 13).
///     true_velocity(i, v)     v / Gamma of particle i [m/s].  Stands for the particle's velocity in every slip: drag,
///                             Nusselt, Sherwood (Eq. 16).
///     gas_storage_factor()    s [-].  Multiplies the gas storage of mass, enthalpy and species, d(void fraction)/dt
///                             included.
///
/// and leaves alone: the gas side of every exchange (the gas sees it once), drag and contact forces, gas inflow.
/// The ledger that closes is one of increments: s dE_gas + sum_p dE_p / Gamma_p = what came through the boundary
/// (see tssm_ledger.hpp).
///
/// `unsplit` is the clock of a plain simulation and inlines to nothing.
struct unsplit {
    template <class Index>
    static constexpr double factor(Index) {
        return 1.0;
    }
    static constexpr double feed_factor() { return 1.0; }
    static constexpr double gas_storage_factor() { return 1.0; }

    template <class Index, class Velocity>
    static constexpr Velocity true_velocity(Index, const Velocity& velocity) {
        return velocity;
    }
};

/// What the gas storage is multiplied by.
enum class gas_storage {
    /// s = 1, as the paper has it: the gas stores Gamma times too much in the bed's time, so fronts come late by
    /// (Gamma - 1) x / interstitial velocity, and a bed that moves Gamma times too fast pumps the gas.
    paper,
    /// s = 1 / Gamma: in the bed's time the gas stores what it really stores.  The equations are those of the true bed;
    /// what is left is the error of the time step.
    corrected,
    /// s = 0: the gas is at rest with the bed at every instant.
    quasi_steady
};

/// The factor s of gas_storage.
constexpr double gas_storage_factor(gas_storage form, double acceleration_factor) {
    return form == gas_storage::paper ? 1.0 : form == gas_storage::corrected ? 1.0 / acceleration_factor : 0.0;
}

namespace detail {

inline void check_acceleration_factor(double value, std::int64_t index = bad_value::no_index) {
    // Written so that NaN fails too.
    if (!(value >= 1.0 && value < 1e300)) throw bad_value("acceleration_factor", index, value, "finite and >= 1 [-]");
}

/// Divides anything with [0], [1], [2], or a number.
template <class Velocity>
constexpr Velocity divided(Velocity velocity, double factor) {
    if constexpr (std::is_arithmetic_v<Velocity>) {
        return static_cast<Velocity>(velocity / factor);
    } else {
        for (std::size_t k = 0; k < 3; ++k) velocity[k] /= factor;
        return velocity;
    }
}

}  // namespace detail

/// One Gamma for every particle.  Throws bad_value for a factor that is below 1 or not finite.
class tssm {
  public:
    explicit tssm(double acceleration_factor, gas_storage form = gas_storage::corrected)
        : factor_(acceleration_factor), form_(form) {
        detail::check_acceleration_factor(acceleration_factor);
    }

    template <class Index>
    double factor(Index) const {
        return factor_;
    }
    double feed_factor() const { return factor_; }
    double gas_storage_factor() const { return hearth::gas_storage_factor(form_, factor_); }

    template <class Index, class Velocity>
    Velocity true_velocity(Index, const Velocity& velocity) const {
        return detail::divided(velocity, factor_);
    }

    gas_storage form() const { return form_; }

  private:
    double factor_;
    gas_storage form_;
};

/// A Gamma of its own for every particle: 1 in free flight, that of the bed else.  Factors is anything with [i], such
/// as acceleration_switch::factors(); it is borrowed and must outlive the clock.
///
/// Two particles of different Gamma exchange heat as any pair: each takes the rate times its own factor, and the ledger
/// of increments closes all the same.  The gas storage has one factor, that of the bed: what flies moves at its true
/// speed but displaces gas by s times it, which is small where few particles fly.
template <class Factors>
class tssm_per_particle {
  public:
    tssm_per_particle(double acceleration_factor, const Factors& factors, gas_storage form = gas_storage::corrected)
        : bed_(acceleration_factor, form), factors_(&factors) {}

    template <class Index>
    double factor(Index i) const {
        return (*factors_)[static_cast<std::size_t>(i)];
    }
    double feed_factor() const { return bed_.feed_factor(); }
    double gas_storage_factor() const { return bed_.gas_storage_factor(); }

    template <class Index, class Velocity>
    Velocity true_velocity(Index i, const Velocity& velocity) const {
        return detail::divided(velocity, factor(i));
    }

  private:
    tssm bed_;
    const Factors* factors_;
};

}  // namespace hearth
