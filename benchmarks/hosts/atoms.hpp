// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "examples/hosts/bed_heat.hpp"
#include "hosts/beside.hpp"

namespace bench {

/// The bed of LIGGGHTS and LAMMPS: 8000 spheres of 10 mm on a cubic lattice that presses them together.
constexpr int atoms_along = 20;
constexpr double spacing = 0.00999, skin = 0.0155;  // [m]

struct listed_pairs {
    std::vector<std::pair<int, int>> list;
    template <class Visit>
    void operator()(Visit&& visit) const {
        for (const auto& [i, j] : list) visit(i, j);
    }
};

/// The host's atoms and pairs in arrays of our own.
template <class Contacts>
struct copied_atoms {
    std::vector<double> positions, radii;
    hearth::sphere_contacts<listed_pairs> contacts{};

    explicit copied_atoms(const Contacts& host) {
        const auto count = static_cast<std::size_t>(host.atoms.count);
        positions.assign(host.atoms.position.first, host.atoms.position.first + 3 * count);
        radii.assign(host.atoms.radius.first, host.atoms.radius.first + count);
        contacts.atoms = host.atoms;
        contacts.atoms.position = {positions.data(), 3};
        contacts.atoms.radius = {radii.data(), 1};
        contacts.list_reach = host.list_reach;
        contacts.effective_modulus = host.effective_modulus;
        host.pairs([&](int i, int j) { contacts.pairs.list.emplace_back(i, j); });
    }
};

/// step: conduction and radiation of all pairs, from the neighbour list to the heat of each sphere.
template <class Contacts>
void atoms_step(benchmark::State& state, const Contacts& host) {
    const copied_atoms<Contacts> own(host);
    std::vector<double> temperature;
    for (std::int64_t i = 0; i < host.atoms.count; ++i)
        temperature.push_back(300 + 1000 * host.atoms.position.row(i)[2]);
    const auto physics = bed::physics();
    const auto step = [&](const auto& contacts, std::vector<double>& heat) {
        auto atoms = contacts.atoms;
        atoms.conductivity = {&bed::conductivity, 0};
        heat.assign(temperature.size(), 0.0);
        hearth::accumulate(physics.links(atoms, contacts), temperature, [](int) { return 300.0; }, heat);
    };
    std::vector<double> on_host, on_own;
    beside(state, [&] { step(host, on_host); }, [&] { step(own.contacts, on_own); });
    if (on_host != on_own) state.SkipWithError("the results differ");
}

}  // namespace bench
