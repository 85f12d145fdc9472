// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <hearth/dem/bed.hpp>

/// Particles as points of a picture, for hearth/io/vtkhdf.hpp or any file with the same calls:
///
///     io::vtkhdf_file picture("particles_0001.hdf", io::vertices(points_of(shaft)), shaft.time());
///     write_fields(picture, shaft);
///
/// Each rank writes its own particles; ParaView draws them as spheres with Point Gaussian or Glyph, scaled by diameter_m.
namespace hearth::dem {

/// x, y, z of each centre in turn [m].
inline std::vector<double> points_of(const bed& b) {
    std::vector<double> points;
    points.reserve(3 * static_cast<std::size_t>(b.size()));
    for (index i = 0; i < b.size(); ++i) {
        const vector3& x = b.spheres()[i].centre;
        points.insert(points.end(), {x.x, x.y, x.z});
    }
    return points;
}

/// id, diameter_m, temperature_K, velocity_m_per_s, spin_rad_per_s and the number of contacts of each particle.
template <class File>
void write_fields(File& file, const bed& b) {
    const auto n = static_cast<std::size_t>(b.size());
    std::vector<float> values(n);
    const auto write = [&](const char* name, auto&& of) {
        for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(of(static_cast<index>(i)));
        file.point_field(name, values);
    };
    const auto write_vectors = [&](const char* name, auto&& of) {
        std::vector<float> vectors(3 * n);
        for (std::size_t i = 0; i < n; ++i)
            for (int a = 0; a < 3; ++a)
                vectors[3 * i + static_cast<std::size_t>(a)] = static_cast<float>(of(static_cast<index>(i))[a]);
        file.point_field(name, vectors, 3);
    };
    file.point_field("id", std::vector<std::int64_t>(b.ids(), b.ids() + n));
    write("diameter_m", [&](index i) { return 2 * b.spheres()[i].radius; });
    write("temperature_K", [&](index i) { return b.temperatures()[i]; });
    write_vectors("velocity_m_per_s", [&](index i) { return b.motions()[i].velocity; });
    write_vectors("spin_rad_per_s", [&](index i) { return b.motions()[i].spin; });
    const std::vector<int> contacts = b.contact_counts();
    write("contacts", [&](index i) { return contacts[static_cast<std::size_t>(i)]; });
}

}  // namespace hearth::dem
