// SPDX-License-Identifier: MIT
#include <hearth/transfer/sphere_contacts.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/closure/hertz.hpp>
#include <hearth/core/conformance.hpp>
#include <hearth/core/error.hpp>

#include "support/random.hpp"

namespace {

using pair_list = std::vector<std::pair<int, int>>;

/// A host's neighbour list.
struct listed {
    const pair_list* list;
    template <class Visit>
    void operator()(Visit&& visit) const {
        for (const auto& [i, j] : *list) visit(i, j);
    }
};
using contacts_type = hearth::sphere_contacts<listed>;
using traits = hearth::contact_traits<contacts_type>;

/// Spheres of 2 to 4 mm somewhere in a box of 20 mm, in the corner of two walls, and a list with a reach of 3 mm.
struct heap {
    std::vector<double> x, radius;
    pair_list list;
    hearth::strided_cloud<> cloud;

    explicit heap(std::uint64_t seed, int count = 120) {
        hearth_test::seeded random(seed);
        for (int i = 0; i < count; ++i) {
            for (int a = 0; a < 3; ++a) x.push_back(random.uniform(0.001, 0.02));
            radius.push_back(random.uniform(0.001, 0.002));
        }
        cloud.count = count;
        cloud.position = {x.data(), 3};
        cloud.radius = {radius.data(), 1};
        for (int i = 0; i < count; ++i) {
            for (int j = i + 1; j < count; ++j) {
                if (gap(i, j) < 0.003) list.emplace_back(i, j);
            }
        }
    }
    double apart(int i, int j) const {
        const double *a = cloud.position.row(i), *b = cloud.position.row(j);
        return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
    }
    double gap(int i, int j) const { return apart(i, j) - cloud.radius[i] - cloud.radius[j]; }
    contacts_type contacts() const {
        const double s = std::sqrt(0.5);
        return {cloud, {&list}, 0.003, 3e6, {{{0, 0, 1}, 0, 900}, {{s, s, 0}, 0.004, 300}}};
    }
};

}  // namespace

TEST_CASE("sphere contacts: overlaps, forces and points of every touching pair, and of no other") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        CAPTURE(seed);
        const heap h(seed);
        const contacts_type contacts = h.contacts();
        CHECK(hearth::contact_conformance(contacts, h.cloud.count).passed());
        pair_list seen, touching;
        for (const auto& [i, j] : h.list) {
            if (h.gap(i, j) < 0) touching.emplace_back(i, j);
        }
        traits::for_each_contact(contacts, [&](int i, int j, const hearth::contact& touch) {
            seen.emplace_back(i, j);
            // One subtraction of lengths of 4 mm.
            CHECK(std::abs(touch.overlap + h.gap(i, j)) < 4e-18);
            // Hertz the other way round, from the force to the overlap.
            const double r = 1 / (1 / h.cloud.radius[i] + 1 / h.cloud.radius[j]);
            const double a = hearth::closure::hertz::contact_radius(touch.normal_force, r, 3e6);
            CHECK(a * a / r == doctest::Approx(touch.overlap).epsilon(1e-13));
            // The point divides the overlap in two halves, on the line of centres.
            for (const int k : {i, j}) {
                const double* c = h.cloud.position.row(k);
                const double away =
                    std::hypot(touch.position[0] - c[0], touch.position[1] - c[1], touch.position[2] - c[2]);
                CHECK(std::abs(away - std::abs(h.cloud.radius[k] - touch.overlap / 2)) < 1e-17);
            }
        });
        CHECK(touching.size() > 10);
        CHECK(seen == touching);
    }
}

TEST_CASE("sphere contacts: near pairs are those within the factor, and a list that is too short is refused") {
    const heap h(4);
    const contacts_type contacts = h.contacts();
    // The smallest pair touches at 2 mm: a list of 3 mm reaches to 1.75 of the touching distance of the largest.
    pair_list seen, expected;
    traits::for_each_near(contacts, 1.7, [&](int i, int j, double apart) {
        seen.emplace_back(i, j);
        CHECK(apart == doctest::Approx(h.apart(i, j)).epsilon(1e-14));
    });
    for (int i = 0; i < h.cloud.count; ++i) {
        for (int j = i + 1; j < h.cloud.count; ++j) {
            if (h.apart(i, j) < 1.7 * (h.cloud.radius[i] + h.cloud.radius[j])) expected.emplace_back(i, j);
        }
    }
    CHECK(seen == expected);
    CHECK_THROWS_AS(traits::for_each_near(contacts, 2.6, [](int, int, double) {}), hearth::bad_value);
}

TEST_CASE("sphere contacts: plane walls, near and touching") {
    const heap h(5);
    const contacts_type contacts = h.contacts();
    int near = 0, touching = 0;
    traits::for_each_near_wall(contacts, 1.0, [&](std::int64_t i, int w, double away) {
        ++near;
        const double* c = h.cloud.position.row(i);
        CHECK(away == doctest::Approx(w == 0 ? c[2] : (c[0] + c[1]) * std::sqrt(0.5) - 0.004).epsilon(1e-14));
        CHECK(away < 2 * h.cloud.radius[i]);
    });
    traits::for_each_wall_contact(contacts, [&](std::int64_t i, int w, const hearth::contact& touch) {
        ++touching;
        const auto& wall = contacts.walls[static_cast<std::size_t>(w)];
        const double a = hearth::closure::hertz::contact_radius(touch.normal_force, h.cloud.radius[i], 3e6);
        CHECK(a * a / h.cloud.radius[i] == doctest::Approx(touch.overlap).epsilon(1e-13));
        double on_wall = -wall.offset;
        for (std::size_t k = 0; k < 3; ++k) on_wall += wall.normal[k] * touch.position[k];
        CHECK(std::abs(on_wall) < 1e-17);
    });
    int expected_near = 0, expected_touching = 0;
    for (int i = 0; i < h.cloud.count; ++i) {
        const double* c = h.cloud.position.row(i);
        for (const double away : {c[2], (c[0] + c[1]) * std::sqrt(0.5) - 0.004}) {
            expected_near += away < 2 * h.cloud.radius[i];
            expected_touching += away < h.cloud.radius[i];
        }
    }
    CHECK(near == expected_near);
    CHECK(touching == expected_touching);
    CHECK(touching > 5);
    CHECK(traits::wall_temperature(contacts, 1) == 300);
}

TEST_CASE("sphere contacts: ghosts behind the owned particles are seen, two spheres in one place are refused") {
    heap h(6);
    h.cloud.count = 60;  // the other 60 are ghosts
    bool ghost = false;
    traits::for_each_contact(h.contacts(), [&](int, int j, const hearth::contact&) { ghost = ghost || j >= 60; });
    CHECK(ghost);
    for (std::size_t a = 0; a < 3; ++a) h.x[3 + a] = h.x[a];
    h.list = {{0, 1}};
    CHECK_THROWS_AS(traits::for_each_contact(h.contacts(), [](int, int, const hearth::contact&) {}), hearth::bad_value);
}
