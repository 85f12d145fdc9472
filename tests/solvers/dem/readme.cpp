// SPDX-License-Identifier: MIT
// The example of examples/solvers/dem/README.md.
#include <doctest/doctest.h>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/zhang.hpp>
#include <hearth/scene/scene.hpp>
#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/radiation.hpp>

#include <hearth/dem/feed.hpp>
#include <hearth/dem/recording.hpp>
#include <hearth/dem/thermal_bed.hpp>

TEST_CASE("the example of the README fills, discharges and links a small shaft") {
    // [use]
    using namespace hearth::dem;
    bed_settings settings;
    settings.step = 2.7e-5;                                              // [s]
    settings.contact.damping = damping_of_restitution(0.65);
    bed shaft(settings);
    const int floor = shaft.add_wall({shape::plane({0, 0, 0}, {0, 0, 1})});
    shaft.add_wall({shape::cylinder({0, 0, -1}, {0, 0, 2}, 0.1)});
    const zone inside{{0, 0, 0}, 0.1, 0.2};                              // base, radius, height [m]
    feed source({{{0, 0, 0.2}, 0.1, 0.1}, 0.5, 3580}, size_distribution({{0.016, 0}, {0.0195, 1}}));
    fill_to_level(shaft, source, inside, 0.15, 40000);
    outflow sink({floor, 0, 0.5});                                       // 0.5 kg/s, as much as is fed
    for (int k = 0; k < 100; ++k) {
        shaft.advance(100);
        source.update(shaft, 100 * settings.step);
        sink.update(shaft, 100 * settings.step);
    }
    thermal_bed warm(shaft, {800, 4, 1});                                // heat capacity, conductivity, emissivity
    const hearth::scene kiln{hearth::conduction{hearth::closure::zhang::constriction{}},
                             hearth::radiation{hearth::closure::feng_han::monte_carlo_fit{}}};
    const auto links = kiln.links(warm, warm);                           // for hearth/time/thermal_network.hpp
    // [use]
    CHECK(surface_level(shaft, inside) > 0.12);
    CHECK(sink.now().taken > 0.05);
    CHECK(links.pairs.size() > 10 * static_cast<std::size_t>(shaft.size()));
    // [record]
    recorder watch({inside});
    while (watch.mass_left() < 0.2) {                                    // [kg]; better what lies in several diameters
        shaft.advance(100);
        source.update(shaft, 100 * settings.step);
        sink.update(shaft, 100 * settings.step);
        watch.observe(shaft);
    }
    recorded_bed later(std::make_shared<recording>(watch.finish()), surroundings::of(shaft), 0.5);
    std::vector<double> temperature(later.masses().size(), 300.0);       // whatever belongs to particles
    const passage moved = later.advance(60.0);                           // a minute of the process
    moved.carry(temperature, 300.0);                                     // by which all have left and others have come
    // [record]
    CHECK(later.now().out + later.now().due == doctest::Approx(0.5 * 60).epsilon(1e-12));
    CHECK(moved.left.size() > 1000);
    CHECK(temperature.size() == static_cast<std::size_t>(later.size()));
}
