// SPDX-License-Identifier: MIT
#include <hearth/dem/contact_law.hpp>

#include <cmath>

#include <hearth/core/constants.hpp>

#include "check.hpp"

namespace hearth::dem {
namespace {

using detail::check;

constexpr double pi = constants<double>::pi();

void check_material(const material& m) {
    check(m.youngs_modulus > 0 && std::isfinite(m.youngs_modulus), "youngs_modulus", m.youngs_modulus,
          "finite and > 0 [Pa]");
    check(m.poisson_ratio > -1 && m.poisson_ratio <= 0.5, "poisson_ratio", m.poisson_ratio, "in (-1, 0.5] [-]");
}

contact_law make(const material& a, const material& b, const contact_settings& settings) {
    check_material(a);
    check_material(b);
    check(settings.damping >= 0 && settings.damping < std::sqrt(5.0), "damping", settings.damping,
          "in [0, sqrt(5)) [-]");
    check(settings.friction >= 0 && std::isfinite(settings.friction), "friction", settings.friction,
          "finite and >= 0 [-]");
    check(settings.rolling_friction >= 0 && std::isfinite(settings.rolling_friction), "rolling_friction",
          settings.rolling_friction, "finite and >= 0 [-]");
    const auto normal = [](const material& m) { return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus; };
    const auto shear = [](const material& m) {
        return 2 * (2 - m.poisson_ratio) * (1 + m.poisson_ratio) / m.youngs_modulus;  // (2 - nu) / G
    };
    const double modulus = 1 / (normal(a) + normal(b));
    return {4.0 / 3.0 * modulus, 8 / (shear(a) + shear(b)), modulus, settings};
}

}  // namespace

contact_law contact_law::between_particles(const material& particle, const contact_settings& settings) {
    return make(particle, particle, settings);
}

contact_law contact_law::with_wall(const material& particle, const material& wall, const contact_settings& settings) {
    return make(particle, wall, settings);
}

double restitution_of_damping(double damping) {
    check(damping >= 0 && damping < std::sqrt(5.0), "damping", damping, "in [0, sqrt(5)) [-]");
    return std::exp(-damping * pi / std::sqrt(5 - damping * damping));
}

double damping_of_restitution(double restitution) {
    check(restitution > 0 && restitution <= 1, "restitution", restitution, "in (0, 1] [-]");
    const double logarithm = std::log(restitution);
    return -std::sqrt(5.0) * logarithm / std::sqrt(logarithm * logarithm + pi * pi);
}

double hertz_impact::largest_overlap() const {
    return std::pow(15 * effective_mass * speed * speed / (16 * std::sqrt(effective_radius) * effective_modulus), 0.4);
}

double hertz_impact::duration() const { return 2.9432752 * largest_overlap() / speed; }

double rayleigh_time(double radius, double density, const material& particle) {
    check_material(particle);
    const double shear_modulus = particle.youngs_modulus / (2 * (1 + particle.poisson_ratio));
    return pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * particle.poisson_ratio + 0.8766);
}

}  // namespace hearth::dem
