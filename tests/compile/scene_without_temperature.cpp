// SPDX-License-Identifier: MIT
// error: hearth: the scene reads a quantity that the host lacks: see Tag in host_gives<Tag, false>
#include <hearth/closure/gunn.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/convection.hpp>

#include "host.hpp"

template <>
struct hearth::particle_traits<host::cloud> {
    using index = int;
    using scalar = double;
    static index particle_count(const host::cloud&) { return 1; }
    static scalar get(quantity::radius, const host::cloud&, index) { return 1; }
    static host::point get(quantity::velocity, const host::cloud&, index) { return {}; }
#ifdef MENDED
    static scalar get(quantity::temperature, const host::cloud&, index) { return 300; }
#endif
    static void add(quantity::heat_rate, host::cloud&, index, scalar) {}
};

template <>
struct hearth::particle_traits<host::mesh> {  // stands for the gas at the particles
    using index = int;
    using scalar = double;
    static host::point get(quantity::gas_velocity, const host::mesh&, index) { return {}; }
    static scalar get(quantity::void_fraction, const host::mesh&, index) { return 0.4; }
    static scalar get(quantity::gas_density, const host::mesh&, index) { return 1; }
    static scalar get(quantity::gas_viscosity, const host::mesh&, index) { return 1; }
    static scalar get(quantity::gas_conductivity, const host::mesh&, index) { return 1; }
    static scalar get(quantity::gas_specific_heat, const host::mesh&, index) { return 1; }
    static scalar get(quantity::gas_temperature, const host::mesh&, index) { return 300; }
    static void add(quantity::gas_heat_rate, host::mesh&, index, scalar) {}
};

void plug_in(host::cloud& cloud, host::mesh& gas) {
    (void)hearth::scene{hearth::convection{hearth::closure::gunn{}}}.accumulate(cloud, gas);
}
