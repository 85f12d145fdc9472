// SPDX-License-Identifier: MIT
// Particles as a picture for ParaView.  read_picture.py reads it with VTK and compares it with particles.txt.
#include <hearth/dem/picture.hpp>

#include <fstream>

#include <doctest/doctest.h>

#include <hearth/io/vtkhdf.hpp>

#include "solvers/dem/packed.hpp"

TEST_CASE("particles are written as points with their fields, an empty bed as none") {
    using namespace hearth::dem;
    bed b = hearth_test::tube_on_floor(hearth_test::soft_settings(0.5, 0.3), 0.08, 2);
    hearth_test::feed_into({{0, 0, 0.02}, 0.08, 0.2}, 3580, 0.016, 0.0195).fill(b);
    b.advance(500);
    for (std::int32_t i = 0; i < b.size(); ++i) b.temperatures()[i] = 300 + static_cast<double>(b.ids()[i]);
    hearth::io::vtkhdf_file picture("particles.hdf", hearth::io::vertices(points_of(b)), b.time());
    write_fields(picture, b);
    picture.close();
    CHECK(points_of(b).size() == 3 * static_cast<std::size_t>(b.size()));

    std::ofstream text("particles.txt");
    text.precision(17);
    text << b.time() << '\n';
    const auto contacts = b.contact_counts();
    for (std::int32_t i = 0; i < b.size(); ++i) {
        const auto& s = b.spheres()[i];
        const auto& v = b.motions()[i].velocity;
        text << b.ids()[i] << ' ' << s.centre.x << ' ' << s.centre.y << ' ' << s.centre.z << ' ' << 2 * s.radius << ' '
             << b.temperatures()[i] << ' ' << v.x << ' ' << v.y << ' ' << v.z << ' ' << contacts[static_cast<std::size_t>(i)]
             << '\n';
    }
    CHECK(text.good());

    const bed nobody = hearth_test::tube_on_floor(hearth_test::soft_settings(0.5, 0.3), 0.08, 2);
    hearth::io::vtkhdf_file none("nobody.hdf", hearth::io::vertices(points_of(nobody)), 0.0);
    write_fields(none, nobody);
}
