// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// What a body's elasticity does at a contact.
template <class Scalar>
struct elastic {
    Scalar youngs_modulus;  ///< [Pa]
    Scalar poisson_ratio;   ///< [-]
};

/// Size of the contact of two elastic spheres, or of a sphere and a wall, from the force that presses them.
/// Hertz, J. reine angew. Math. 92 (1882) 156, doi:10.1515/crll.1882.92.156.  Valid for a contact much smaller than the
/// spheres, without friction and adhesion: pass the elastic force alone, without damping and cohesion.
///
/// Motion is often computed with a softened modulus.  Radii and areas for heat belong to the true one: take the force,
/// which softening leaves as it is, or rescale the softened overlap.
struct hertz {
    /// 1/E* = (1 - n1^2)/E1 + (1 - n2^2)/E2 [Pa].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar effective_modulus(const elastic<Scalar>& one, const elastic<Scalar>& other) {
        const Scalar a = (real_t<Scalar>(1) - square(one.poisson_ratio)) / one.youngs_modulus;
        const Scalar b = (real_t<Scalar>(1) - square(other.poisson_ratio)) / other.youngs_modulus;
        return real_t<Scalar>(1) / (a + b);
    }

    /// 1/R* = 1/R1 + 1/R2 [m].  Against a flat wall R* is the radius of the sphere itself.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar effective_radius(const Scalar& one, const Scalar& other) {
        return one * other / (one + other);
    }

    /// a = (3 F R* / (4 E*))^(1/3) [m]; 0 for a force of 0 or a pulling one.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar contact_radius(const Scalar& normal_force, const Scalar& effective_radius,
                                                 const Scalar& effective_modulus) {
        using real = real_t<Scalar>;
        const Scalar pressing = at_least(normal_force, real(0));
        return cube_root(Scalar(real(0.75) * pressing * effective_radius / effective_modulus));
    }

    /// A = pi a^2 [m^2].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar contact_area(const Scalar& contact_radius) {
        return constants<real_t<Scalar>>::pi() * square(contact_radius);
    }

    /// Approach of the centres, a^2 / R* [m].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar overlap(const Scalar& contact_radius, const Scalar& effective_radius) {
        return square(contact_radius) / effective_radius;
    }

    /// F = 4/3 E* sqrt(R*) overlap^(3/2) [N]; 0 without overlap.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar normal_force(const Scalar& overlap, const Scalar& effective_radius,
                                               const Scalar& effective_modulus) {
        using real = real_t<Scalar>;
        const Scalar touching = at_least(overlap, real(0));
        const Scalar contact_radius = square_root(Scalar(effective_radius * touching));
        return real(4) / real(3) * effective_modulus * contact_radius * touching;
    }

    /// Overlap that the true modulus would give under the same force: (E_soft / E_true)^(2/3) of the softened one [m].
    /// The same factor turns the softened contact area into the true one.
    template <class Scalar>
    HEARTH_FUNCTION static Scalar true_overlap(const Scalar& softened_overlap, const Scalar& softened_modulus,
                                               const Scalar& true_modulus) {
        return softened_overlap * square(cube_root(Scalar(softened_modulus / true_modulus)));
    }

    /// Contact radius under the true modulus: (E_soft / E_true)^(1/3) of the softened one [m].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar true_contact_radius(const Scalar& softened_radius, const Scalar& softened_modulus,
                                                      const Scalar& true_modulus) {
        return softened_radius * cube_root(Scalar(softened_modulus / true_modulus));
    }
};

}  // namespace hearth::closure
