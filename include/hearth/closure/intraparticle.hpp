// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// The share of a particle's own conduction in its heat transfer.
/// A sphere of one temperature per particle, its mean, exchanges with gas through 1/h_eff = 1/h + d/(10 k): exact for a
/// parabolic profile inside, the quasi-steady one (linear driving force, Glueckauf, Trans. Faraday Soc. 51 (1955)
/// 1540). Good while Bi is small; above 0.3 one temperature does not describe the particle and this is a first
/// correction.
struct intraparticle {
    /// Bi on the volume over the surface, d/6 [-].
    HEARTH_FUNCTION static constexpr double biot_limit() { return 0.3; }

    /// Bi = h (d/6) / k [-].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar biot(const Scalar& transfer_coefficient, const Scalar& diameter,
                                       const Scalar& conductivity) {
        return transfer_coefficient * diameter / (real_t<Scalar>(6) * conductivity);
    }

    /// h_eff [W/(m^2 K)].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar transfer_coefficient(const Scalar& transfer_coefficient, const Scalar& diameter,
                                                       const Scalar& conductivity) {
        using real = real_t<Scalar>;
        return transfer_coefficient / (real(1) + transfer_coefficient * diameter / (real(10) * conductivity));
    }
};

/// How often, and how far, the Biot number passed the limit.  The caller owns it, one per thread, and adds them up.
struct biot_report {
    std::int64_t evaluations = 0;
    std::int64_t above_limit = 0;
    double largest = 0;  ///< [-]

    void add(double biot) {
        ++evaluations;
        if (biot > intraparticle::biot_limit()) ++above_limit;
        if (biot > largest) largest = biot;
    }

    biot_report& operator+=(const biot_report& other) {
        evaluations += other.evaluations;
        above_limit += other.above_limit;
        if (other.largest > largest) largest = other.largest;
        return *this;
    }
};

}  // namespace hearth::closure
