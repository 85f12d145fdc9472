// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <vector>

#include <doctest/doctest.h>

#include <hearth/time/caloric.hpp>
#include <hearth/time/limits.hpp>
#include <hearth/time/thermal_network.hpp>

#include "support/random.hpp"

using namespace hearth;

namespace {

/// Largest step at which a scheme is stable: grows(step) says whether a small disturbance has grown after many steps.
template <class Grows>
double bisected(double guess, const Grows& grows) {
    double lo = guess / 16, hi = guess * 16;
    REQUIRE_FALSE(grows(lo));
    REQUIRE(grows(hi));
    for (int k = 0; k < 60; ++k) {
        const double mid = std::sqrt(lo * hi);
        (grows(mid) ? hi : lo) = mid;
    }
    return lo;
}

/// 1e5 steps of a growth rate 1 + x double a disturbance where x > 7e-6: the bisection is good to some 1e-5.
constexpr int many = 100000;
constexpr double fine = 2e-5;

TEST_CASE("limits: a particle against gas and radiation, explicit") {
    const constant_specific_heat<> caloric{1000};
    for (const double factor : {1.0, 678.0}) {
        CAPTURE(factor);
        heat_bath<> bath;
        bath.add(thermal_link<double>{0.04, 5.7e-11}, 1800.0);
        const double mass = 0.011, limit = stable_step::particle(bath, mass * 1000, 1800.0, factor);
        const double found = bisected(limit, [&](double step) {
            double t = 1800 + 1e-5;  // linear: T^4 bends by 1e-8 of this
            for (int n = 0; n < many && std::fabs(t - 1800) < 1e-2; ++n)
                t = explicit_euler::advance(t, mass, caloric, bath, factor * step).temperature;
            return std::fabs(t - 1800) > 1e-5;
        });
        CHECK(found == doctest::Approx(limit).epsilon(fine));
    }
}

TEST_CASE("limits: a particle and the gas of its cell, both explicit") {
    // 10 mm glass, and gas of 1 mm^3 to 1 dm^3.
    const double conductance = 0.0316, particle_capacity = 1.1;
    for (const double gas_capacity : {3.56e-7, 1e-3, 0.4})
        for (const double factor : {1.0, 678.0}) {
            const double limit = stable_step::particle_and_gas(conductance, particle_capacity, gas_capacity, factor);
            const double found = bisected(limit, [&](double step) {
                double particle = 1, gas = 0;
                for (int n = 0; n < many && std::fabs(gas - particle) < 10; ++n) {
                    const double heat = conductance * (gas - particle) * step;
                    particle += factor * heat / particle_capacity;
                    gas -= heat / gas_capacity;
                }
                return std::fabs(gas - particle) > 1;
            });
            CHECK(found == doctest::Approx(limit).epsilon(fine));
        }
    // The example of a cell of 1 mm^3: about 2.3e-5 s.
    CHECK(stable_step::particle_and_gas(0.0316, 1.1, 3.56e-7) == doctest::Approx(2.25e-5).epsilon(0.01));
}

/// Explicit Euler of a whole network; true where a disturbance grew.
bool network_grows(const std::vector<thermal_pair>& pairs, const std::vector<heat_bath<double>>& baths,
                   const std::vector<double>& capacity, double rest, double step, int steps) {
    std::vector<double> t(capacity.size());
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = rest + (i % 2 == 0 ? 1e-5 : -1e-5);
    const auto spread = [&] {
        double s = 0;
        for (const double value : t) s = std::fmax(s, std::fabs(value - rest));
        return s;
    };
    for (int n = 0; n < steps && spread() < 1e-2; ++n) {
        std::vector<double> heat(t.size(), 0.0);
        for (std::size_t i = 0; i < t.size(); ++i)
            heat[i] = baths[i].conductance * (baths[i].conductive_temperature(rest) - t[i]) +
                      radiative_link<double>{baths[i].radiation}.heat(t[i], baths[i].radiative_temperature(rest));
        for (const auto& pair : pairs) {
            const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
            const double q = pair.link.heat(t[a], t[b]);
            heat[a] += q;
            heat[b] -= q;
        }
        for (std::size_t i = 0; i < t.size(); ++i) t[i] += step * heat[i] / capacity[i];
    }
    return spread() > 1.1e-5;
}

TEST_CASE("limits: two bodies in contact or radiation, explicit") {
    const thermal_link<double> link{0.03, 2e-11};
    const double rest = 2243, slope = link.conductance + 4 * link.radiation * std::pow(rest, 3);
    const double limit = stable_step::pair(slope, 9.0, 3.0, 200.0);
    const double found = bisected(limit, [&](double step) {
        return network_grows({{0, 1, link}}, std::vector<heat_bath<double>>(2), {9.0 / 200, 3.0 / 200}, rest, step,
                             many);
    });
    CHECK(found == doctest::Approx(limit).epsilon(fine));
}

TEST_CASE("limits: a network's bound is safe, and sharp where particles fall into two groups") {
    // A ring of equal spheres: every second one warmer is the stiffest mode, and Gershgorin's bound is attained.
    const thermal_link<double> link{0.01, 3e-11};
    std::vector<thermal_pair> ring;
    for (int i = 0; i < 12; ++i) ring.push_back({i, (i + 1) % 12, link});
    const std::vector<double> capacity(12, 5.0), rest(12, 1500.0);
    const std::vector<heat_bath<double>> none(12);
    const double limit = stable_step::network(ring, none, capacity, rest);
    CHECK(bisected(limit, [&](double step) { return network_grows(ring, none, capacity, 1500, step, many); }) ==
          doctest::Approx(limit).epsilon(fine));

    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        hearth_test::seeded random(seed);
        std::vector<thermal_pair> pairs;
        std::vector<heat_bath<double>> baths(30);
        std::vector<double> c(30), t(30, 1200.0);
        for (std::size_t i = 0; i < 30; ++i) {
            c[i] = random.log_uniform(0.1, 10);
            if (random.uniform(0, 1) < 0.3) baths[i].add(thermal_link<double>{random.uniform(0, 1), 1e-11}, 1200.0);
            for (int k = 0; k < 3 && i > 0; ++k)
                pairs.push_back({static_cast<std::int32_t>(i),
                                 static_cast<std::int32_t>(random.index(i)),
                                 {random.log_uniform(1e-3, 1), random.log_uniform(1e-13, 1e-10)}});
        }
        const double bound = stable_step::network(pairs, baths, c, t);
        CHECK_FALSE(network_grows(pairs, baths, c, 1200, bound, 5000));
        CHECK(network_grows(pairs, baths, c, 1200, 2.5 * bound, 5000));  // and not idle: a factor of at most 2
    }
}

TEST_CASE("limits: drag, a contact's spring, transport, diffusion") {
    const double drag = stable_step::drag(0.4, 0.01);
    CHECK(bisected(drag, [](double step) {
              double v = 1;
              for (int n = 0; n < many && std::fabs(v) < 10; ++n) v -= step * 0.4 / 0.01 * v;
              return std::fabs(v) > 1;
          }) == doctest::Approx(drag).epsilon(fine));

    const double contact = stable_step::contact(2e6, 0.005);
    CHECK(bisected(contact, [](double step) {
              double x = 1e-6, v = 0;  // leapfrog; beyond the limit it grows exponentially, at it linearly
              for (int n = 0; n < many && std::fabs(x) < 1e3; ++n) {
                  v -= step * 2e6 / 0.005 * x;
                  x += step * v;
              }
              return std::fabs(x) > 1e2;
          }) == doctest::Approx(contact).epsilon(fine));

    // A ring of cells with a disturbance of the shortest wave, the first to grow.
    const auto ring = [](auto update) {
        return [update](double step) {
            std::vector<double> a(16), b(16);
            for (std::size_t i = 0; i < 16; ++i) a[i] = i % 2 == 0 ? 1.0 : -1.0;
            for (int n = 0; n < 20000; ++n) {
                for (std::size_t i = 0; i < 16; ++i)
                    b[i] = a[i] + step * update(a[(i + 15) % 16], a[i], a[(i + 1) % 16]);
                a.swap(b);
                if (std::fabs(a[0]) > 10) break;
            }
            return std::fabs(a[0]) > 1 + 1e-9;
        };
    };
    for (const double s : {1.0, 1.0 / 678}) {
        const double advection = stable_step::advection(0.01, 3.0, s);
        CHECK(bisected(advection, ring([s](double l, double c, double) { return 3.0 / (s * 0.01) * (l - c); })) ==
              doctest::Approx(advection).epsilon(fine));
        const double diffusion = stable_step::diffusion(0.01, 2e-5, 1, s);
        CHECK(bisected(diffusion, ring([s](double l, double c, double r) {
                           return 2e-5 / (s * 1e-4) * (l - 2 * c + r);
                       })) == doctest::Approx(diffusion).epsilon(fine));
    }
    CHECK(stable_step::advection(0.01, 3.0, 0.0) == 0.0);
    CHECK(stable_step::diffusion(0.01, 2e-5, 3) == doctest::Approx(stable_step::diffusion(0.01, 2e-5, 1) / 3));
    CHECK(stable_step::depletion(1e-4, 2e-7, 200.0) == doctest::Approx(2.5));
}

TEST_CASE("limits: radiation of the paper's bed, 18 mm at 2500 K and Gamma 678: 10 ms") {
    const double area = 3.14159265 * 0.018 * 0.018, mass = 3580 * area * 0.018 / 6;
    heat_bath<> bath;
    bath.add(radiative_link<double>{5.670374419e-8 * area}, 2500.0);
    CHECK(stable_step::particle(bath, mass * 1000, 2500.0, 678.0) == doctest::Approx(0.01).epsilon(0.15));
}

TEST_CASE("limits: nothing exchanged, nothing limited") {
    CHECK(std::isinf(stable_step::particle(heat_bath<>{}, 1.0, 300.0)));
    CHECK(std::isinf(stable_step::network(std::vector<thermal_pair>{}, {}, {}, {})));
    CHECK(std::isinf(stable_step::drag(0.0, 1.0)));
    CHECK(std::isinf(stable_step::contact(0.0, 1.0)));
    CHECK(std::isinf(stable_step::advection(0.1, 0.0)));
    CHECK(std::isinf(stable_step::diffusion(0.1, 0.0, 3)));
    CHECK(std::isinf(stable_step::depletion(1.0, 0.0)));
}

}  // namespace
