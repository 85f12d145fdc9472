// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/lattice.hpp>
#include <hearth/voidage/transfer_operator.hpp>

#include "support/box_mesh.hpp"
#include "support/packing.hpp"
#include "support/random.hpp"
#include "support/thread_communicator.hpp"

namespace {

using namespace hearth::test;
using hearth::point;
using hearth_test::seeded;

/// A bed on a mesh with split cells, and a threshold low enough for the cap to work.
struct scene {
    explicit scene(std::uint64_t seed)
        : random(seed),
          periodic{random.index(2) == 0, random.index(2) == 0, random.index(2) == 0},
          bed(make_packing({random.uniform(0.2, 0.5), {4, 4, 4}, random.uniform(0, 0.5), periodic, seed})),
          mesh({planes(), planes(), planes()}, periodic, [&](int i, int j, int k) { return (i + 2 * j + k) % 5 == 0; }),
          settings{std::nullopt, bed.solid_fraction() + random.uniform(0.02, 0.1), 1e-5} {}

    std::vector<double> planes() {
        return graded_planes(4, 3 + static_cast<int>(random.index(7)), random.uniform(0.85, 1.15));
    }
    std::vector<double> numbers(std::size_t count) {
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i) values.push_back(random.uniform(-1, 1));
        return values;
    }
    std::size_t particles() const { return bed.radii.size(); }
    std::size_t cells() const { return mesh.centres.size(); }

    seeded random;
    std::array<bool, 3> periodic;
    packing bed;
    box_mesh mesh;
    hearth::filtered_fraction_settings settings;
};

/// The same with the map of the bed made.
struct mapped : scene {
    explicit mapped(std::uint64_t seed)
        : scene(seed),
          graph(mesh),
          locator(mesh, graph),
          transfer(locator, settings),
          fraction(cells()),
          report(transfer.distribute(bed, fraction)) {}

    hearth::cell_graph<> graph;
    hearth::cell_locator<box_mesh> locator;
    hearth::transfer_operator<box_mesh> transfer;
    std::vector<double> fraction;
    hearth::filtered_fraction_report report;
};

template <class Values>
double sum(const Values& values) {
    long double total = 0;
    for (const double v : values) total += static_cast<long double>(v);
    return static_cast<double>(total);
}

double magnitude(const std::vector<double>& values) {
    double total = 0;
    for (const double v : values) total += std::abs(v);
    return total;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
    long double total = 0;
    for (std::size_t i = 0; i < a.size(); ++i) total += static_cast<long double>(a[i]) * static_cast<long double>(b[i]);
    return static_cast<double>(total);
}

}  // namespace

TEST_CASE("transfer operator: keeps sums, is its own transpose, and sees constants as constants") {
    int capped = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        CAPTURE(seed);
        mapped s(seed);
        auto& transfer = s.transfer;
        const auto& fraction = s.fraction;
        const auto& report = s.report;
        if (report.cap.smoothed_cells > 0) ++capped;
        CHECK(report.maximum <= s.settings.threshold * (1 + 1e-14));

        // Scalars.  The volume-weighted sums inside round a few times for each term of the kernel and each sweep of the
        // cap, in all less than a thousand times.
        const std::vector<double> sources = s.numbers(s.particles()), gas = s.numbers(s.cells());
        std::vector<double> at_cells(s.cells()), at_particles(s.particles());
        transfer.scatter(sources, at_cells);
        transfer.gather(gas, at_particles);
        CHECK(std::abs(sum(at_cells) - sum(sources)) <= 1e-13 * magnitude(sources));
        CHECK(std::abs(product(at_cells, gas) - product(sources, at_particles)) <= 1e-12 * magnitude(sources));

        // A constant, and the bounds of the gas.
        transfer.gather(std::vector<double>(s.cells(), 300.0), at_particles);
        for (const double t : at_particles) CHECK(t == doctest::Approx(300).epsilon(1e-13));

        // Vectors, component by component: each the same bits as that scalar.
        std::vector<std::array<double, 3>> forces(s.particles()), on_gas(s.cells());
        for (std::size_t i = 0; i < s.particles(); ++i) forces[i] = {1.5, sources[i], -sources[i]};
        transfer.scatter(forces, on_gas);
        for (std::size_t c = 0; c < s.cells(); ++c) {
            CHECK(on_gas[c][1] == at_cells[c]);
            CHECK(on_gas[c][2] == -at_cells[c]);
        }
        std::vector<std::array<float, 3>> velocity(s.cells(), {1.0F, 2.0F, 3.0F}), seen(s.particles());
        transfer.gather(velocity, seen);
        for (const auto& u : seen) CHECK(static_cast<double>(u[2]) == doctest::Approx(3.0).epsilon(1e-7));

        // It did to volume what it does to any other property.
        std::vector<double> volumes, spread(s.cells());
        for (const double r : s.bed.radii) volumes.push_back(4.0 / 3 * 3.14159265358979323846 * r * r * r);
        transfer.scatter(volumes, spread);
        for (std::size_t c = 0; c < s.cells(); ++c) {
            CHECK(spread[c] == doctest::Approx(fraction[c] * s.mesh.volume(static_cast<int>(c))).epsilon(1e-12));
        }
    }
    CHECK(capped > 10);  // or the cap's part was not tested
}

TEST_CASE("transfer operator: the shares of a particle are positive, sum to 1, and lie around it") {
    scene s(3);
    const hearth::cell_graph graph(s.mesh);
    const hearth::cell_locator locator(s.mesh, graph);
    hearth::transfer_operator<box_mesh> transfer(locator);
    std::vector<double> fraction(s.cells());
    transfer.distribute(s.bed, fraction);
    for (std::int64_t id = 0; id < static_cast<std::int64_t>(s.particles()); id += 5) {
        double total = 0;
        for (const auto& [cell, share] : transfer.footprint(id)) {
            CHECK(share >= 0);
            total += share;
        }
        CHECK(std::abs(total - 1) <= 1e-13);
    }
    CHECK(transfer.footprint(1234567).empty());
}

TEST_CASE("transfer operator: the same bits on any number of ranks") {
    for (const std::uint64_t seed : {2U, 5U}) {
        CAPTURE(seed);
        scene s(seed);
        const hearth::cell_graph graph(s.mesh);
        const hearth::cell_locator locator(s.mesh, graph);
        hearth::transfer_operator<box_mesh> transfer(locator, s.settings);
        std::vector<double> fraction(s.cells()), at_cells(s.cells()), at_particles(s.particles());
        const auto expected = transfer.distribute(s.bed, fraction);
        const std::vector<double> sources = s.numbers(s.particles()), gas = s.numbers(s.cells());
        transfer.scatter(sources, at_cells);
        transfer.gather(gas, at_particles);

        for (const int ranks : {1, 2, 3, 4, 5, 8}) {
            CAPTURE(ranks);
            const std::vector<int> owners =
                random_owners(s.mesh.size(), ranks, seed + static_cast<std::uint64_t>(ranks));
            std::vector<double> fraction_there(s.cells()), cells_there(s.cells()), particles_there(s.particles());
            on_ranks(ranks, [&](thread_communicator communicator) {
                const box_share share(s.mesh, owners, communicator.rank(), 3);
                const packing_share cloud(s.bed, communicator.rank(), ranks, 4);
                const hearth::cell_graph part(share, communicator);
                const hearth::cell_locator here(share, part);
                hearth::transfer_operator<box_share, thread_communicator> distributed(here, s.settings);
                std::vector<double> field(share.cells.size()), received(share.cells.size()), gas_here;
                const auto report = distributed.distribute(cloud, field);
                if (report.width != expected.width || report.capped_volume != expected.capped_volume ||
                    report.maximum != expected.maximum || report.solid_volume != expected.solid_volume) {
                    throw std::logic_error("the report depends on the ranks");
                }
                std::vector<double> sources_here, seen(cloud.ids.size());
                for (const std::int64_t id : cloud.ids) sources_here.push_back(sources[static_cast<std::size_t>(id)]);
                for (const int c : share.cells) gas_here.push_back(gas[static_cast<std::size_t>(c)]);
                distributed.scatter(sources_here, received);
                distributed.gather(gas_here, seen);
                std::vector<double> twice(seen.size()), thrice(seen.size());
                distributed.gather(std::tie(gas_here, gas_here), std::tie(twice, thrice));
                if (twice != seen || thrice != seen) throw std::logic_error("fields together differ from one alone");
                for (std::size_t c = 0; c < field.size(); ++c) {
                    fraction_there[static_cast<std::size_t>(share.cells[c])] = field[c];
                    cells_there[static_cast<std::size_t>(share.cells[c])] = received[c];
                }
                for (std::size_t i = 0; i < seen.size(); ++i)
                    particles_there[static_cast<std::size_t>(cloud.ids[i])] = seen[i];
            });
            const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
                return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
            };
            CHECK(same(fraction_there, fraction));
            CHECK(same(cells_there, at_cells));
            CHECK(same(particles_there, at_particles));
        }
    }
}

TEST_CASE("transfer operator: several fields at once get the bits that each gets alone") {
    int capped = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        mapped s(seed);
        auto& transfer = s.transfer;
        if (s.report.cap.smoothed_cells > 0) ++capped;

        // Six columns go as four and two, five as four and one; of doubles and floats, scalars and vectors.
        const std::vector<double> one = s.numbers(s.cells()), other = s.numbers(s.cells()),
                                  third = s.numbers(s.cells());
        std::vector<std::array<float, 3>> vectors(s.cells());
        for (std::size_t c = 0; c < s.cells(); ++c) {
            vectors[c] = {static_cast<float>(one[c]), static_cast<float>(1e6 * other[c]), 0.0F};
        }
        std::vector<double> one_seen(s.particles()), other_seen(s.particles()), third_seen(s.particles()),
            alone(s.particles());
        std::vector<std::array<float, 3>> vectors_seen(s.particles()), vectors_alone(s.particles());
        transfer.gather(vectors, vectors_alone);
        transfer.gather(std::tie(one, vectors, other, third), std::tie(one_seen, vectors_seen, other_seen, third_seen));
        CHECK(vectors_seen == vectors_alone);
        transfer.gather(one, alone);
        CHECK(one_seen == alone);
        transfer.gather(other, alone);
        CHECK(other_seen == alone);
        transfer.gather(third, alone);
        CHECK(third_seen == alone);
        std::vector<double> again(s.particles());
        vectors_seen.assign(s.particles(), {});
        transfer.gather(std::tie(vectors, other, one), std::tie(vectors_seen, again, one_seen));
        CHECK(vectors_seen == vectors_alone);
        transfer.gather(other, alone);
        CHECK(again == alone);

        std::vector<double> given(s.cells()), given_alone(s.cells());
        std::vector<std::array<double, 3>> pushed(s.cells()), pushed_alone(s.cells()), forces(s.particles());
        for (std::size_t i = 0; i < s.particles(); ++i) forces[i] = {one_seen[i], alone[i], -1};
        transfer.scatter(alone, given_alone);
        transfer.scatter(forces, pushed_alone);
        transfer.scatter(std::tie(forces, alone), std::tie(pushed, given));
        CHECK(pushed == pushed_alone);
        CHECK(given == given_alone);

        // One bad value: nothing is written.
        std::vector<double> bad = third;
        bad[s.cells() / 2] = std::numeric_limits<double>::quiet_NaN();
        std::vector<double> kept(s.particles(), 7.0), kept_too = kept;
        CHECK_THROWS_AS(transfer.gather(std::tie(one, bad), std::tie(kept, kept_too)), hearth::bad_value);
        CHECK(kept == std::vector<double>(s.particles(), 7.0));
        CHECK(kept_too == kept);
    }
    CHECK(capped > 5);
}

TEST_CASE("transfer operator: a particle moved changes only its own shares, and the map knows its revision") {
    scene s(4);
    const hearth::cell_graph graph(s.mesh);
    const hearth::cell_locator locator(s.mesh, graph);
    hearth::transfer_operator<box_mesh> transfer(locator);  // at 0.74 the cap has nothing to do
    std::vector<double> fraction(s.cells());
    CHECK(transfer.revision() == 0);
    REQUIRE(transfer.distribute(s.bed, fraction).cap.smoothed_cells == 0);
    CHECK(transfer.revision() == 1);
    const auto before = transfer.footprint(7);
    s.bed.positions[3] = {2, 2, 2};
    transfer.distribute(s.bed, fraction);
    CHECK(transfer.revision() == 2);
    CHECK(transfer.footprint(7) == before);
}

TEST_CASE("transfer operator: two kernels share footprints and give the bits that each gives alone") {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        CAPTURE(seed);
        scene s(seed);
        const hearth::cell_graph graph(s.mesh);
        const hearth::cell_locator locator(s.mesh, graph);
        auto narrow = s.settings;
        narrow.width = 0.1;
        hearth::transfer_operator<box_mesh> wide(locator, s.settings), thin(locator, narrow), alone(locator, s.settings);
        std::vector<double> fraction(s.cells()), other(s.cells()), wanted(s.cells()), sources = s.numbers(s.particles());
        CHECK_THROWS_AS(wide.distribute_like(thin, fraction), std::logic_error);  // it has no map
        thin.distribute(s.bed, other);
        const auto shared = wide.distribute_like(thin, fraction), own = alone.distribute(s.bed, wanted);
        CHECK(fraction == wanted);
        CHECK(shared.particles == own.particles);
        CHECK(shared.width == own.width);
        CHECK(shared.cap.touched_cells == own.cap.touched_cells);
        // It outlives the one that it is like.
        s.bed.positions[0] = {2, 2, 2};
        thin.distribute(s.bed, other);
        std::vector<double> given(s.cells()), given_alone(s.cells());
        wide.scatter(sources, given);
        alone.scatter(sources, given_alone);
        CHECK(given == given_alone);
        const hearth::cell_locator elsewhere(s.mesh, graph);
        hearth::transfer_operator<box_mesh> stranger(elsewhere, s.settings);
        CHECK_THROWS_AS(stranger.distribute_like(thin, other), std::logic_error);
    }
}

TEST_CASE("transfer operator: without a kernel it is the Volume Fraction Smoother of the centre deposit, with vectors") {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        CAPTURE(seed);
        scene s(seed);
        s.settings.width = 0.0;
        const hearth::cell_graph graph(s.mesh);
        const hearth::cell_locator locator(s.mesh, graph);
        hearth::transfer_operator<box_mesh> transfer(locator, s.settings);
        std::vector<double> fraction(s.cells()), plain(s.cells());
        const auto report = transfer.distribute(s.bed, fraction, hearth::deposit::centre{});
        hearth::deposit_solid_fraction(locator, s.bed, plain, hearth::deposit::centre{});
        hearth::volume_fraction_smoother smoother(graph, hearth::vfs_settings{s.settings.threshold});
        CHECK(smoother.smooth(plain).touched_cells == report.cap.touched_cells);
        CHECK(plain == fraction);

        // Momentum goes where the log of the smoother says.
        std::vector<std::array<double, 3>> forces(s.particles()), on_gas(s.cells());
        for (auto& f : forces) f = {s.random.uniform(-1, 1), s.random.uniform(-1, 1), s.random.uniform(-1, 1)};
        transfer.scatter(forces, on_gas);
        for (std::size_t a = 0; a < 3; ++a) {
            std::vector<double> along(s.cells(), 0.0);
            double scale = 0;
            for (std::size_t p = 0; p < s.particles(); ++p) {
                along[static_cast<std::size_t>(s.mesh.find(s.bed.positions[p]))] += forces[p][a];
                scale += std::abs(forces[p][a]);
            }
            smoother.scatter(along);
            for (std::size_t c = 0; c < s.cells(); ++c) CHECK(std::abs(on_gas[c][a] - along[c]) <= 1e-13 * scale);
        }
    }
}

TEST_CASE("transfer operator: refuses what it cannot do, and leaves the fields") {
    const hearth::lattice mesh{{{4, 4, 4}, {1, 1, 1}, {false, false, false}, {0, 0, 0}}};
    const hearth::cell_graph graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    hearth::transfer_operator<hearth::lattice> transfer(locator);
    packing bed = make_packing({0.3, {4, 4, 4}, 0, {false, false, false}, 1});
    std::vector<double> field(64, 0.5), sources(bed.radii.size(), 1.0);

    CHECK_THROWS_AS(transfer.scatter(sources, field), std::logic_error);
    transfer.distribute(bed, field);
    const std::vector<double> fraction = field;
    sources[5] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(transfer.scatter(sources, field), "hearth: value of particle 5 is nan, allowed: finite",
                         hearth::bad_value);
    CHECK(field == fraction);
    std::vector<double> gas(64, 1.0), seen(bed.radii.size(), 7.0);
    gas[9] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH_AS(transfer.gather(gas, seen), "hearth: value of cell 9 is inf, allowed: finite",
                         hearth::bad_value);
    CHECK(seen == std::vector<double>(bed.radii.size(), 7.0));

    // Five times the spheres do not fit; the field stays, and there is no map.
    packing crowd = bed;
    for (int copy = 0; copy < 4; ++copy) {
        crowd.positions.insert(crowd.positions.end(), bed.positions.begin(), bed.positions.end());
        crowd.radii.insert(crowd.radii.end(), bed.radii.begin(), bed.radii.end());
    }
    CHECK_THROWS_AS(transfer.distribute(crowd, field), hearth::infeasible_volume);
    CHECK(field == fraction);
    CHECK_THROWS_AS(transfer.gather(fraction, seen), std::logic_error);

    using settings = hearth::filtered_fraction_settings;
    CHECK_THROWS_AS(hearth::transfer_operator<hearth::lattice>(locator, settings{std::nullopt, 1.5, 1e-5}),
                    hearth::bad_value);
    hearth::transfer_operator<hearth::lattice> negative(locator, settings{-1.0, 0.74, 1e-5});
    CHECK_THROWS_AS(negative.distribute(bed, field), hearth::bad_value);
    hearth::transfer_operator<hearth::lattice> loose(locator, settings{std::nullopt, 0.74, 0.5});
    CHECK_THROWS_AS(loose.distribute(bed, field), hearth::bad_value);
    CHECK(field == fraction);
}
