// SPDX-License-Identifier: MIT
// From nothing to a running adapter, as ../README.md tells it: a host of its own with hot gas over a cold bed.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include <hearth/closure/gunn.hpp>
#include <hearth/core/conformance.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/voidage/transfer_operator.hpp>

// [host]
namespace host {

struct mesh {  // cells in a row, 20 mm by 20 mm by dx
    std::vector<double> dx, x;
};
struct particle {
    std::array<double, 3> at, velocity;
    double radius, temperature, heat_rate;
};
using cloud = std::vector<particle>;

}  // namespace host
// [host]

// [mesh]
template <>
struct hearth::mesh_traits<host::mesh> {
    using index = int;
    using scalar = double;
    static index cell_count(const host::mesh& m) { return static_cast<int>(m.dx.size()); }
    static scalar volume(const host::mesh& m, index c) { return 4e-4 * m.dx[at(c)]; }
    static point centre(const host::mesh& m, index c) { return {m.x[at(c)], 0, 0}; }
    static point extent(const host::mesh& m, index c) { return {m.dx[at(c)], 0.02, 0.02}; }
    template <class Visit>
    static void for_each_face(const host::mesh& m, Visit&& visit) {
        for (index c = 0; c + 1 < cell_count(m); ++c) visit(c, c + 1, 4e-4, 4e-4 / (m.x[at(c + 1)] - m.x[at(c)]));
    }

  private:
    static std::size_t at(index c) { return static_cast<std::size_t>(c); }
};
// [mesh]

// [particles]
template <>
struct hearth::particle_traits<host::cloud> {
    using index = std::size_t;
    using scalar = double;
    static index particle_count(const host::cloud& c) { return c.size(); }
    static const auto& get(quantity::position, const host::cloud& c, index i) { return c[i].at; }
    static const auto& get(quantity::velocity, const host::cloud& c, index i) { return c[i].velocity; }
    static scalar get(quantity::radius, const host::cloud& c, index i) { return c[i].radius; }
    static scalar get(quantity::temperature, const host::cloud& c, index i) { return c[i].temperature; }
    static void add(quantity::heat_rate, host::cloud& c, index i, scalar watts) { c[i].heat_rate += watts; }
};
// [particles]

// [gas]
struct gas_at_particles {  // what W gathers; add what your scene asks for
    std::vector<double> void_fraction, temperature, heat_rate;
    std::vector<std::array<double, 3>> velocity;
};
template <>
struct hearth::particle_traits<gas_at_particles> {
    using index = std::size_t;
    using scalar = double;
    using gas = gas_at_particles;
    static index particle_count(const gas& g) { return g.temperature.size(); }
    static scalar get(quantity::void_fraction, const gas& g, index i) { return g.void_fraction[i]; }
    static scalar get(quantity::gas_temperature, const gas& g, index i) { return g.temperature[i]; }
    static const auto& get(quantity::gas_velocity, const gas& g, index i) { return g.velocity[i]; }
    static scalar get(quantity::gas_density, const gas&, index) { return 1.2; }
    static scalar get(quantity::gas_viscosity, const gas&, index) { return 1.8e-5; }
    static scalar get(quantity::gas_conductivity, const gas&, index) { return 0.026; }
    static scalar get(quantity::gas_specific_heat, const gas&, index) { return 1005; }
    static void add(quantity::gas_heat_rate, gas& g, index i, scalar watts) { g.heat_rate[i] += watts; }
};
// [gas]

int main() {
    host::mesh mesh;
    for (double x = 0; mesh.dx.size() < 40; x += mesh.dx.back()) {
        mesh.dx.push_back(0.004 + 0.001 * std::sin(static_cast<double>(mesh.dx.size())));
        mesh.x.push_back(x + 0.5 * mesh.dx.back());
    }
    host::cloud cloud;
    for (int i = 0; i < 12; ++i) cloud.push_back({{0.02 + 0.01 * i, 0.001 * (i % 3), 0}, {}, 0.005, 300, 0});
    std::vector<double> gas_temperature(mesh.dx.size(), 400), gas_heat(mesh.dx.size());
    std::vector<std::array<double, 3>> gas_velocity(mesh.dx.size(), {1.0, 0, 0});  // interstitial

    // [conformance]
    for (const std::string& failure : hearth::conformance(mesh).failures) std::printf("%s\n", failure.c_str());
    for (const std::string& failure : hearth::cloud_conformance(cloud).failures) std::printf("%s\n", failure.c_str());
    // [conformance]

    // [once]
    const hearth::cell_graph<> graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    hearth::transfer_operator<host::mesh> transfer(locator);
    const hearth::scene scene{hearth::convection{hearth::closure::gunn{}}};
    // [once]

    // [step]
    std::vector<double> void_fraction(mesh.dx.size());
    transfer.distribute(cloud, void_fraction);  // gives the solid fraction
    for (double& fraction : void_fraction) fraction = 1 - fraction;

    gas_at_particles gas;
    gas.velocity.resize(cloud.size());
    for (auto* values : {&gas.void_fraction, &gas.temperature, &gas.heat_rate}) values->resize(cloud.size());
    transfer.gather(std::tie(void_fraction, gas_temperature, gas_velocity),
                    std::tie(gas.void_fraction, gas.temperature, gas.velocity));

    scene.accumulate(cloud, gas);               // heat into each particle, and out of the gas at it
    transfer.scatter(gas.heat_rate, gas_heat);  // [W] of each cell, a source for your gas equations
    // [step]

    double taken = 0, given = 0;
    for (const host::particle& p : cloud) taken += p.heat_rate;
    for (const double watts : gas_heat) given -= watts;
    std::printf("particles take %.6f W, the gas gives %.6f W\n", taken, given);
    const bool conforms = hearth::conformance(mesh).passed() && hearth::cloud_conformance(cloud).passed();
    return conforms && taken > 1 && std::abs(taken - given) < 1e-13 * taken ? 0 : 1;
}
