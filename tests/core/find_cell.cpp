// SPDX-License-Identifier: MIT
#include <hearth/core/find_cell.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/core/cell_locator.hpp>
#include <hearth/core/face_mesh.hpp>
#include <hearth/core/strided_cloud.hpp>
#include <hearth/voidage/deposit.hpp>

namespace {

constexpr int n = 5;
constexpr double spacing = 0.1;

/// A cube of cubes in plain arrays, which know no find_cell.
struct cube {
    std::vector<int> owner, neighbour;
    std::vector<double> areas, conductances, volumes, centres;

    cube() : volumes(n * n * n, spacing * spacing * spacing) {
        for (int c = 0; c < n * n * n; ++c) {
            const int at[3] = {c % n, c / n % n, c / (n * n)}, step[3] = {1, n, n * n};
            for (int a = 0; a < 3; ++a) {
                centres.push_back((at[a] + 0.5) * spacing);
                if (at[a] + 1 == n) continue;
                owner.push_back(c);
                neighbour.push_back(c + step[a]);
            }
        }
        areas.assign(owner.size(), spacing * spacing);
        conductances.assign(owner.size(), spacing);
    }
    hearth::face_mesh<> view() const {
        return {n * n * n, static_cast<int>(owner.size()), owner.data(), neighbour.data(), areas.data(), conductances.data(),
                volumes.data(), centres.data()};
    }
};

}  // namespace

TEST_CASE("find_cell: by extents where the host knows none") {
    const cube arrays;
    const auto mesh = arrays.view();
    const hearth::cell_graph<> graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    std::mt19937_64 random(7);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int k = 0; k < 1000; ++k) {
        const hearth::point x{n * spacing * uniform(), n * spacing * uniform(), n * spacing * uniform()};
        const auto at = [&](std::size_t a) { return static_cast<int>(std::floor(x[a] / spacing)); };
        CAPTURE(k);
        CHECK(locator.find(x) == at(0) + n * (at(1) + n * at(2)));
    }
    CHECK(locator.find({-0.01, 0.25, 0.25}) == -1);
    CHECK(locator.find({0.25, 0.25, 0.51}) == -1);
    // On a face, the lower index.
    CHECK(locator.find({2 * spacing, 0.5 * spacing, 0.5 * spacing}) == 1);
}

TEST_CASE("find_cell: particles can be deposited on plain arrays, and outside of them are refused") {
    const cube arrays;
    const auto mesh = arrays.view();
    const hearth::cell_graph<> graph(mesh);
    const hearth::cell_locator locator(mesh, graph);
    double x[3] = {0.22, 0.26, 0.31};
    const double radius = 0.08;
    hearth::strided_cloud<> cloud;
    cloud.count = 1;
    cloud.position = {x, 3};
    cloud.radius = {&radius, 1};
    std::vector<double> fraction(n * n * n);
    hearth::deposit_solid_fraction(locator, cloud, fraction, hearth::deposit::centre{});
    const double volume = 4.0 / 3.0 * std::acos(-1.0) * radius * radius * radius;
    CHECK(fraction[2 + n * (2 + n * 3)] == doctest::Approx(volume / (spacing * spacing * spacing)).epsilon(1e-15));
    x[0] = -0.2;
    CHECK_THROWS_AS(hearth::deposit_solid_fraction(locator, cloud, fraction), hearth::bad_value);
}
