// SPDX-License-Identifier: MIT
#pragma once

namespace hearth::dem {

/// An elastic body, particle or wall.
struct material {
    double youngs_modulus = 3.77e8;  ///< of the motion: softened, unless a user can afford the true one [Pa]
    double poisson_ratio = 0.25;     ///< [-]
};

/// Which form of the spring-slider-dashpot is computed.
enum class slip_rule {
    shorten,  ///< on slip the tangential spring keeps the Coulomb force; levers end at the contact point
    paper     ///< OpenFOAM 2.4's pair model: on slip the spring is reset; levers are the radii
};

/// How two bodies behave in contact.
struct contact_settings {
    double damping = 0.12;           ///< alpha of Tsuji's dashpot [-], >= 0; see damping_of_restitution()
    double friction = 0.5;           ///< Coulomb coefficient [-], >= 0
    double rolling_friction = 0.0;   ///< largest rolling torque over normal force and effective radius [-], >= 0
    slip_rule rule = slip_rule::shorten;
};

/// Spring-slider-dashpot of Cundall and Strack (doi:10.1680/geot.1979.29.1.47) with the Hertzian springs and the dashpot of
/// Tsuji, Tanaka and Ishida (doi:10.1016/0032-5910(92)88030-L), as OpenFOAM's PairSpringSliderDashpot.  For one kind of
/// pair; s = sqrt(R* overlap):
///
///     normal        4/3 E* s overlap - eta u_n,        eta = alpha sqrt(4/3 E* s M*)
///     tangential   -8 G* s xi - eta u_t,               at most mu |normal|
///     rolling      -8 G* s R*^2 theta,                 at most mu_r R* |normal|  (doi:10.1061/(ASCE)0733-9399(1998)124:3(285))
///
/// The normal force is not clipped: at the end of a contact the dashpot may pull, and then the restitution is the exact
/// exp(-alpha pi / sqrt(5 - alpha^2)) at any speed.
struct contact_law {
    double normal_stiffness;      ///< 4/3 E* [Pa]
    double tangential_stiffness;  ///< 8 G* [Pa]
    double effective_modulus;     ///< E* [Pa]
    contact_settings settings;

    /// Two particles of one material.  Throws bad_value.
    static contact_law between_particles(const material& particle, const contact_settings& settings);
    /// A particle and a wall.  Throws bad_value.
    static contact_law with_wall(const material& particle, const material& wall, const contact_settings& settings);
};

/// Coefficient of restitution of an impact without friction [-].
double restitution_of_damping(double damping);
/// Its inverse; restitution in (0, 1].  Throws bad_value.
double damping_of_restitution(double restitution);

/// Undamped impact of two spheres, or of a sphere on a wall (effective radius and mass are then the sphere's own).
struct hertz_impact {
    double effective_radius;   ///< R* [m]
    double effective_mass;     ///< M* [kg]
    double effective_modulus;  ///< E* [Pa]
    double speed;              ///< of approach [m/s]

    double largest_overlap() const;  ///< [m]
    double duration() const;         ///< [s]
};

/// Time in which a Rayleigh wave crosses a sphere [s]; steps of 10 to 30 % of it are usual.
double rayleigh_time(double radius, double density, const material& particle);

}  // namespace hearth::dem
