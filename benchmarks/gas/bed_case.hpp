// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>

#include <hearth/closure/ergun.hpp>
#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

namespace bench {

/// Air through a bed of spheres, 0.3 m high in a duct of 0.3 m x 0.3 m, with 0.3 m of free gas above.  Isothermal, or
/// with spheres of one temperature.  Walls are adiabatic; there is no turbulence model.
struct bed_case {
    static constexpr double side = 0.3, height = 0.3;                               // [m]
    static constexpr double mass_flow = 0.1, temperature = 300, pressure = 101325;  // [kg/s] [K] [Pa]
    static constexpr double void_fraction = 0.42, diameter = 0.014;                 // [-] [m]
    static constexpr double particle_temperature = 900;                             // [K]
    double heat_exchange = 0;                                                       // 0: isothermal [W/(m^3 K)]

    hearth::gas::simple_gas air() const { return {}; }
    double flux() const { return mass_flow / (side * side); }                                // [kg/(m^2 s)]
    double speed() const { return flux() / air().density(pressure, temperature, nullptr); }  // superficial [m/s]

    /// The same in one dimension, to round-off: temperature at a height, and pressure there above the outlet's.
    double temperature_at(double z) const {
        const double units = heat_exchange * std::min(z, height) / (flux() * air().heat_capacity);
        return particle_temperature - (particle_temperature - temperature) * std::exp(-units);
    }
    /// `e` is the void fraction that inertia knows: 1 for a solver that only adds a resistance.
    double drop_from(double z, double e = void_fraction) const {
        const int steps = 10000;
        const double h = (height - z) / steps;
        const auto volume = [&](double at, double p) {
            return 1 / air().density(pressure + p, temperature_at(at), nullptr);
        };
        double upper = volume(height, 0),
               above = -0.5 * flux() * flux() * upper * (1 / (e * e) - 1);  // Bernoulli at the top
        for (int i = 0; i < steps; ++i) {                                   // from the bed's top down
            const double middle = height - (i + 0.5) * h, rho = 1 / volume(middle, above);
            const double lower = volume(middle - 0.5 * h, above);
            above += flux() * flux() / (e * e) * (upper - lower);
            above += h * hearth::closure::pressure_gradient(
                             hearth::closure::ergun{}, hearth::closure::bed_flow<double>{
                                                           void_fraction, flux() / rho / void_fraction, rho,
                                                           air().viscosity(temperature_at(middle), nullptr), diameter});
            upper = lower;
        }
        return above;
    }

    hearth::gas::polyhedra shape(int n) const {
        using hearth::gas::graded;
        return hearth::gas::box(graded(side, n), graded(side, n), graded(2 * height, n));
    }

    std::unique_ptr<hearth::gas::solver> make(
        const hearth::gas::mesh& m, const hearth::gas::solver_settings& wanted = {},
        const hearth::gas::parallel& ranks = hearth::gas::solver::single_rank()) const {
        using namespace hearth::gas;
        solver_settings settings = wanted;
        settings.turbulence = false;
        settings.energy = heat_exchange > 0;
        settings.dispersion = 0;
        settings.energy_relaxation = 1;  // the spheres hold temperatures
        settings.gravity = {0, 0, 0};
        auto gas = std::make_unique<solver>(m, std::make_shared<simple_gas>(air()), settings, ranks);
        gas->set("z_min", mass_flow_inlet(mass_flow, {temperature}));
        gas->set("z_max", pressure_outlet(pressure, {temperature}));
        for (int c = 0; c < m.owned_cells(); ++c) {
            if (m.centre[c].z > height) continue;
            gas->bed.void_fraction[c] = void_fraction;
            gas->bed.diameter[c] = diameter;
            gas->bed.heat_conductance[c] = heat_exchange * m.volume[c];
            gas->bed.heat_source[c] = gas->bed.heat_conductance[c] * particle_temperature;
        }
        gas->initialise(temperature);
        return gas;
    }
};

/// The first iteration from which on all values stay within `tolerance` of the last one, relatively.
template <class Values>
int settled_from(const Values& v, double tolerance) {
    int i = static_cast<int>(v.size());
    while (i > 0 && std::abs(v[i - 1] - v[v.size() - 1]) <= tolerance * std::abs(v[v.size() - 1])) --i;
    return i;
}

}  // namespace bench
