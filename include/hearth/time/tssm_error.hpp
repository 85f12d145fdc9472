// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include <hearth/core/error.hpp>
#include <hearth/core/function.hpp>
#include <hearth/time/tssm.hpp>

namespace hearth {

/// A packed bed under a gas stream, as far as the error of time scale splitting depends on it.
struct tssm_bed {
    /// Heat that the gas in the bed stores over that of the solid: e rho_gas c_gas / ((1 - e) rho_solid c_solid) [-].
    double storage_ratio;
    /// Transfer units from the gas entrance to the place asked for: h a x / (G c_gas) [-].
    double transfer_units;
};

/// Steepest rise of the solid's temperature in Schumann's bed: the maximum over eta of
/// exp(-(xi + eta)) I0(2 sqrt(xi eta)), xi the transfer units [-].
///
/// exp(-xi) for xi <= 1, where the front arrives steepest.  Above, 1/(2 sqrt(pi xi)) times a polynomial in 1/xi that
/// was fitted to the maximum in 30 digits; relative error below 6e-5.
template <class Real>
HEARTH_FUNCTION Real steepest_rise(Real transfer_units) {
    if (!(transfer_units > Real(1))) return std::exp(-transfer_units);
    const Real u = Real(1) / transfer_units;
    const Real shape =
        Real(1.00004731019) +
        u * (Real(0.120411889044) +
             u * (Real(0.124112792721) +
                  u * (Real(-0.329739959369) +
                       u * (Real(0.833969406511) + u * (Real(-0.605174112334) + u * Real(0.160473332654))))));
    return shape * std::sqrt(u) * Real(0.28209479177387814);  // 1 / (2 sqrt(pi))
}

/// Largest error of a particle's temperature that Gamma causes, over the step of the gas's inlet temperature [-], to
/// first order in the delay: |s Gamma - 1| beta xi times the steepest rise.  Within 5 % where |s Gamma - 1| beta xi <
/// 0.1. Zero for the corrected form, whose only error is that of its time step.
inline double tssm_error(double acceleration_factor, gas_storage form, const tssm_bed& bed) {
    detail::check_acceleration_factor(acceleration_factor);
    const double excess = std::fabs(gas_storage_factor(form, acceleration_factor) * acceleration_factor - 1.0);
    return excess * bed.storage_ratio * bed.transfer_units * steepest_rise(bed.transfer_units);
}

/// Largest Gamma whose error stays below the tolerance, by the same estimate; at least 1.
/// Infinite for the corrected form (the motion and the time step set its limit).  The quasi-steady form has an error
/// that Gamma does not change: infinite where that is below the tolerance, else 1. Throws bad_value for a tolerance
/// that is not > 0, or a bed whose numbers are not finite and > 0.
inline double gamma_for(double tolerance, gas_storage form, const tssm_bed& bed) {
    if (!(tolerance > 0.0)) throw bad_value("tolerance", bad_value::no_index, tolerance, "> 0 [-]");
    const auto check = [](const char* name, double value) {
        if (!(value > 0.0 && std::isfinite(value)))
            throw bad_value(name, bad_value::no_index, value, "finite and > 0 [-]");
    };
    check("storage_ratio", bed.storage_ratio);
    check("transfer_units", bed.transfer_units);
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    const double unit = bed.storage_ratio * bed.transfer_units * steepest_rise(bed.transfer_units);
    if (form == gas_storage::corrected) return unlimited;
    if (form == gas_storage::quasi_steady) return unit <= tolerance ? unlimited : 1.0;
    return 1.0 + tolerance / unit;
}

/// The delay law: with constant properties, splitting shifts every temperature of Schumann's bed by this much process
/// time [s], and does nothing else.  Positive: late.  distance from the gas entrance [m], interstitial_velocity [m/s].
inline double tssm_delay(double acceleration_factor, gas_storage form, double distance, double interstitial_velocity) {
    detail::check_acceleration_factor(acceleration_factor);
    return (gas_storage_factor(form, acceleration_factor) * acceleration_factor - 1.0) * distance /
           interstitial_velocity;
}

}  // namespace hearth
