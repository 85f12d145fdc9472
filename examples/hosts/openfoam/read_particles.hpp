// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fstream>
#include <vector>

#include <hearth/core/strided_cloud.hpp>

/// What the OpenFOAM hosts share: a list of spheres.  Include after fvCFD.H.
struct particle_list {
    std::vector<double> rows;  // x, y, z, radius of each
    std::vector<std::int64_t> ids;

    hearth::strided_cloud<double> view() const {
        hearth::strided_cloud<double> cloud;
        cloud.count = static_cast<std::int64_t>(ids.size());
        cloud.position = {rows.data(), 4};
        cloud.radius = {rows.data() + 3, 4};
        cloud.ids = ids.data();
        return cloud;
    }
};

/// Each rank takes its share of the list; hearth brings every particle to the ranks whose cells it overlaps.
inline particle_list read_particles(const Foam::fileName& name) {
    std::ifstream file(name);
    if (!file) {
        FatalErrorInFunction << "cannot read the particles " << name << Foam::exit(Foam::FatalError);
    }
    particle_list list;
    std::int64_t id = 0;
    for (double x, y, z, radius; file >> x >> y >> z >> radius; ++id) {
        if (id % Foam::Pstream::nProcs() != Foam::Pstream::myProcNo()) continue;
        list.rows.insert(list.rows.end(), {x, y, z, radius});
        list.ids.push_back(id);
    }
    if (!file.eof()) {
        FatalErrorInFunction << name << ": particle " << Foam::label(id) << " is not x y z radius"
                             << Foam::exit(Foam::FatalError);
    }
    return list;
}
