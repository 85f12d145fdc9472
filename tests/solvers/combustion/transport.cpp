// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <hearth/combustion/transport.hpp>

#include "solvers/combustion/states.hpp"

using namespace hearth::combustion;

namespace {

per_species pure(species k) {
    per_species x{};
    x[k] = 1;
    return x;
}

}  // namespace

TEST_CASE("transport: viscosities of pure gases agree with tables") {
    struct row {
        species k;
        double temperature, viscosity, tolerance;  // [K], [1e-6 Pa s], [-]
    };
    // CRC Handbook of Chemistry and Physics, "Viscosity of gases"; steam at 1000 K from the IAPWS formulation.
    for (const row& r :
         {row{CH4, 300, 11.2, 0.03}, row{CH4, 600, 19.4, 0.03}, row{O2, 300, 20.8, 0.03}, row{O2, 600, 35.1, 0.03},
          row{N2, 300, 17.9, 0.03}, row{N2, 600, 29.6, 0.03}, row{CO, 300, 17.8, 0.03}, row{CO, 600, 29.1, 0.03},
          row{CO2, 300, 15.0, 0.03}, row{CO2, 600, 28.0, 0.03}, row{H2, 300, 9.0, 0.03}, row{H2, 600, 14.4, 0.03},
          row{H2O, 400, 13.3, 0.08}, row{H2O, 600, 21.4, 0.08}, row{H2O, 1000, 37.6, 0.08}}) {
        CAPTURE(r.k);
        CAPTURE(r.temperature);
        CHECK(1e6 * viscosities(r.temperature)[r.k] == doctest::Approx(r.viscosity).epsilon(r.tolerance));
        CHECK(transport(r.temperature, 1e5, pure(r.k)).viscosity ==
              doctest::Approx(viscosities(r.temperature)[r.k]).epsilon(1e-14));
    }
}

TEST_CASE("transport: conductivities of pure gases agree with tables") {
    struct row {
        species k;
        double temperature, conductivity;  // [K], [1e-3 W/(m K)]
    };
    // CRC Handbook of Chemistry and Physics, "Thermal conductivity of gases"; steam: VDI Heat Atlas.
    for (const row& r : {row{CH4, 300, 34.4}, row{O2, 300, 26.5}, row{N2, 300, 26.0}, row{N2, 600, 44.0},
                         row{CO, 300, 25.0}, row{CO2, 300, 16.8}, row{CO2, 600, 41.6}, row{H2, 300, 186.9},
                         row{H2O, 473.15, 33.3}, row{H2O, 673.15, 54.8}, row{H2O, 873.15, 79.9}}) {
        CAPTURE(r.k);
        CAPTURE(r.temperature);
        CHECK(1e3 * transport(r.temperature, 1e5, pure(r.k)).conductivity ==
              doctest::Approx(r.conductivity).epsilon(0.07));
    }
}

TEST_CASE("transport: air agrees with Sutherland's formula") {
    // mu = 1.716e-5 (T/273.15)^1.5 383.55/(T + 110.4), k = 2.646e-3 T^1.5/(T + 245.4 10^(-12/T)), of use up to 1900 K,
    // where they fall below the tables; Prandtl number of air.
    for (const double t : {300.0, 600.0, 1000.0, 1500.0}) {
        CAPTURE(t);
        const transport_properties air = transport(t, 101325, {0, 0.21, 0.79, 0, 0, 0, 0});
        CHECK(air.viscosity ==
              doctest::Approx(1.716e-5 * std::pow(t / 273.15, 1.5) * 383.55 / (t + 110.4)).epsilon(0.06));
        CHECK(air.conductivity ==
              doctest::Approx(2.646e-3 * std::pow(t, 1.5) / (t + 245.4 * std::pow(10, -12 / t))).epsilon(0.05));
        const nasa7 gas = combine(amounts_from_moles({0, 0.21, 0.79, 0, 0, 0, 0}));
        CHECK(air.viscosity * gas.heat_capacity(t) / air.conductivity == doctest::Approx(0.72).epsilon(0.04));
    }
}

TEST_CASE("transport: diffusivities of pairs agree with measurements") {
    struct row {
        species of, in;
        double temperature, diffusivity;  // [K], [1e-4 m^2/s] at one atmosphere
    };
    // Marrero & Mason, J. Phys. Chem. Ref. Data 1 (1972) 3, doi:10.1063/1.3253094; H2O-N2: Poling et al., 5th ed.,
    // ch. 11.
    for (const row& r : {row{O2, N2, 293.15, 0.203}, row{CO2, N2, 298.15, 0.165}, row{H2, N2, 298.15, 0.779},
                         row{CH4, N2, 298.15, 0.216}, row{CO, N2, 295.8, 0.212}, row{H2O, N2, 307.5, 0.256}}) {
        CAPTURE(r.of);
        CHECK(1e4 * transport(r.temperature, 101325, pure(r.in)).diffusivity[r.of] ==
              doctest::Approx(r.diffusivity).epsilon(0.1));
    }
}

TEST_CASE("transport: any mixture at any temperature and pressure is finite, bounded by its pure gases, and scales") {
    const std::uint64_t seed = 31;
    CAPTURE(seed);
    hearth_test::seeded random(seed);
    for (int i = 0; i < 2000; ++i) {
        const double t = random.uniform(200, 3500), p = random.log_uniform(1e3, 1e7);
        const per_species x = mole_fractions(any_mixture(random)), mu = viscosities(t);
        const transport_properties one = transport(t, p, x), two = transport(t, 2 * p, x);
        // Wilke's mixtures may pass the pure gases by a quarter (light with heavy).
        CHECK(one.viscosity > 0.75 * *std::min_element(mu.begin(), mu.end()));
        CHECK(one.viscosity < 1.25 * *std::max_element(mu.begin(), mu.end()));
        CHECK(one.conductivity > 0);
        CHECK(one.viscosity == viscosity(t, x));
        CHECK(two.viscosity == one.viscosity);
        CHECK(two.conductivity == one.conductivity);
        for (std::size_t k = 0; k < species_count; ++k) {
            CHECK(one.diffusivity[k] > 0);
            CHECK(std::isfinite(one.diffusivity[k]));
            CHECK(two.diffusivity[k] == doctest::Approx(0.5 * one.diffusivity[k]).epsilon(1e-14));
        }
    }
}

TEST_CASE("transport: in a pair both gases diffuse alike") {
    for (const double share : {0.001, 0.3, 0.9}) {
        const per_species x{share, 0, 1 - share, 0, 0, 0, 0};
        const transport_properties gas = transport(700, 1e5, x);
        CHECK(gas.diffusivity[CH4] == doctest::Approx(gas.diffusivity[N2]).epsilon(1e-10));
    }
}
