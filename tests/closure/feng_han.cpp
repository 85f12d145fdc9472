// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/sphere_pair.hpp>

using hearth::closure::feng_han;
using fit = feng_han::monte_carlo_fit;

namespace {

/// Own ray tracing: mean view factor of all pairs in a bin of distance, in packings of four solid fractions.
struct bin {
    double lo, hi;
    double mean[4];
};
constexpr double solid_fractions[4]{0.5767, 0.5929, 0.6178, 0.6369};
constexpr bin bins[]{{0.99, 1.001, {7.474e-02, 7.461e-02, 7.436e-02, 7.415e-02}},
                     {1.001, 1.01, {7.326e-02, 7.306e-02, 7.285e-02, 7.258e-02}},
                     {1.01, 1.05, {6.864e-02, 6.850e-02, 6.816e-02, 6.796e-02}},
                     {1.05, 1.1, {6.090e-02, 6.075e-02, 6.039e-02, 6.010e-02}},
                     {1.1, 1.15, {5.390e-02, 5.338e-02, 5.307e-02, 5.294e-02}},
                     {1.15, 1.2, {4.789e-02, 4.762e-02, 4.708e-02, 4.666e-02}},
                     {1.2, 1.25, {4.261e-02, 4.208e-02, 4.160e-02, 4.111e-02}},
                     {1.25, 1.3, {3.781e-02, 3.734e-02, 3.676e-02, 3.616e-02}},
                     {1.3, 1.35, {3.348e-02, 3.314e-02, 3.228e-02, 3.181e-02}},
                     {1.35, 1.4, {2.967e-02, 2.912e-02, 2.825e-02, 2.753e-02}},
                     {1.4, 1.45, {2.603e-02, 2.532e-02, 2.432e-02, 2.341e-02}},
                     {1.45, 1.5, {2.249e-02, 2.171e-02, 2.053e-02, 1.967e-02}},
                     {1.5, 1.55, {1.935e-02, 1.828e-02, 1.716e-02, 1.613e-02}},
                     {1.55, 1.6, {1.592e-02, 1.520e-02, 1.389e-02, 1.275e-02}},
                     {1.6, 1.65, {1.292e-02, 1.208e-02, 1.076e-02, 9.501e-03}},
                     {1.65, 1.7, {1.013e-02, 9.235e-03, 8.055e-03, 6.992e-03}},
                     {1.7, 1.75, {7.745e-03, 6.865e-03, 5.579e-03, 4.695e-03}},
                     {1.75, 1.8, {6.199e-03, 5.595e-03, 4.729e-03, 3.929e-03}},
                     {1.8, 1.85, {4.975e-03, 4.493e-03, 3.696e-03, 3.104e-03}},
                     {1.85, 1.9, {3.859e-03, 3.460e-03, 2.832e-03, 2.408e-03}},
                     {1.9, 1.95, {2.836e-03, 2.490e-03, 1.984e-03, 1.644e-03}},
                     {1.95, 2, {2.090e-03, 1.660e-03, 1.184e-03, 9.044e-04}},
                     {2, 2.1, {2.273e-03, 1.920e-03, 1.472e-03, 1.127e-03}},
                     {2.1, 2.2, {1.838e-03, 1.611e-03, 1.209e-03, 9.222e-04}},
                     {2.2, 2.3, {1.445e-03, 1.239e-03, 9.676e-04, 6.987e-04}},
                     {2.3, 2.4, {1.136e-03, 9.112e-04, 7.071e-04, 5.076e-04}},
                     {2.4, 2.5, {8.051e-04, 6.839e-04, 4.763e-04, 3.424e-04}},
                     {2.5, 2.6, {5.729e-04, 4.677e-04, 3.141e-04, 2.272e-04}},
                     {2.6, 2.7, {4.121e-04, 3.130e-04, 2.122e-04, 1.444e-04}},
                     {2.7, 2.8, {3.045e-04, 2.274e-04, 1.549e-04, 1.064e-04}},
                     {2.8, 2.9, {2.200e-04, 1.676e-04, 1.092e-04, 6.929e-05}},
                     {2.9, 3, {1.684e-04, 1.286e-04, 7.782e-05, 4.819e-05}},
                     {3, 3.25, {1.132e-04, 8.300e-05, 5.154e-05, 3.055e-05}},
                     {3.25, 3.5, {5.826e-05, 4.159e-05, 2.337e-05, 1.342e-05}},
                     {3.5, 3.75, {2.904e-05, 1.970e-05, 1.096e-05, 5.839e-06}},
                     {3.75, 4, {1.516e-05, 1.010e-05, 5.097e-06, 2.524e-06}}};

/// The fit's mean over a bin, touching spheres at distance 1.
double mean(const bin& b, double solid_fraction) {
    const int points = 50;
    double sum = 0;
    for (int k = 0; k < points; ++k) sum += fit::view_factor(b.lo + (b.hi - b.lo) * (k + 0.5) / points, solid_fraction);
    return sum / points;
}

}  // namespace

TEST_CASE("feng_han::monte_carlo_fit: within the stated error of the ray tracing that it was fitted to") {
    const auto rms_and_worst = [](double from, double to) {
        double squares = 0, worst = 0;
        int count = 0;
        for (const bin& b : bins)
            for (int packing = 0; packing < 4; ++packing) {
                if (b.lo < from - 1e-9 || b.hi > to + 1e-9) continue;
                const double error = mean(b, solid_fractions[packing]) / b.mean[packing] - 1;
                squares += error * error;
                worst = std::max(worst, std::fabs(error));
                ++count;
            }
        REQUIRE(count >= 16);
        return std::pair{std::sqrt(squares / count), worst};
    };
    CHECK(rms_and_worst(0.99, 1.5).first < 0.006);
    CHECK(rms_and_worst(1.5, 1.75).first < 0.025);
    CHECK(rms_and_worst(1.75, 2).first < 0.045);
    CHECK(rms_and_worst(2, 4).first < 0.06);
    CHECK(rms_and_worst(0.99, 1.7).second < 0.025);
    CHECK(rms_and_worst(1.7, 2).second < 0.08);
    CHECK(rms_and_worst(2, 4).second < 0.13);
}

TEST_CASE("feng_han::monte_carlo_fit: never above the view of two spheres alone") {
    for (double p = 0.57; p <= 0.64; p += 0.01)
        for (double s = 1; s < 4; s += 0.001) {
            // at contact the fit may exceed by its error
            REQUIRE(fit::view_factor(s, p) < hearth::closure::sphere_pair::view_factor(s) * 1.005);
            REQUIRE(fit::view_factor(s, p) > 0);
        }
}

TEST_CASE("feng_han::monte_carlo_fit: falls with distance but for the dip at 2, and with density beyond 1.5") {
    for (double p = 0.57; p <= 0.64; p += 0.01) {
        for (double s = 1; s < 1.99; s += 0.001) REQUIRE(fit::view_factor(s + 0.001, p) < fit::view_factor(s, p));
        for (double s = 2.1; s < 3.99; s += 0.001) REQUIRE(fit::view_factor(s + 0.001, p) < fit::view_factor(s, p));
        for (double s = 1.5; s < 3.99; s += 0.01) REQUIRE(fit::view_factor(s, p + 0.01) < fit::view_factor(s, p));
        CHECK(fit::view_factor(2.0, p) < fit::view_factor(2.06, p));
    }
}

TEST_CASE("feng_han::monte_carlo_fit: continuous, with an end") {
    const double kink = std::sqrt(3.0);
    for (const double p : {0.57, 0.6, 0.64})
        for (const double s : {kink, 2.0}) {
            const double below = fit::view_factor(s - 1e-9, p), above = fit::view_factor(s + 1e-9, p);
            CHECK(below == doctest::Approx(above).epsilon(1e-7));
        }
    CHECK(fit::view_factor(4.0, 0.57) > 0);
    CHECK(fit::view_factor(4.0, 0.57) < 2e-5);
    CHECK(fit::view_factor(4.000001, 0.57) == 0);
}

TEST_CASE("feng_han::monte_carlo_fit: overlapping spheres count as touching") {
    CHECK(fit::view_factor(0.98, 0.6) == fit::view_factor(1.0, 0.6));
    CHECK(fit::view_factor(1.0, 0.6) == doctest::Approx(0.0743).epsilon(1e-3));
}

TEST_CASE("feng_han::monte_carlo_fit: takes the bed's solid fraction once or with each pair") {
    CHECK(fit(0.62).view_factor(1.3) == fit::view_factor(1.3, 0.62));
    CHECK(fit().view_factor(1.3) == fit::view_factor(1.3, 0.6));
    for (const double bad : {0.5, 0.7, -1.0, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(fit{bad}, std::invalid_argument);
}
