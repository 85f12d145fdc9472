// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hearth/core/mesh_traits.hpp>

/// Closed forms and quadratures that serve as oracles.
namespace hearth::test {

/// Area of the part of a disc of radius R about the origin with X < x and Y < y.
inline double disc_corner_area(double R, double x, double y) {
    const double pi = 3.14159265358979323846;
    if (R <= 0 || x <= -R || y <= -R) return 0;
    x = std::min(x, R);
    y = std::min(y, R);
    const auto primitive = [&](double t) {
        return 0.5 * (t * std::sqrt(std::max(0.0, R * R - t * t)) + R * R * std::asin(std::min(t / R, 1.0)));
    };
    if (x * x + y * y <= R * R) return x * y + primitive(x) + primitive(y) + pi * R * R / 4;
    const auto beyond = [&](double t) { return pi * R * R / 2 - 2 * primitive(t); };  // area with X > t
    if (x > 0 && y > 0) return pi * R * R - beyond(x) - beyond(y);
    if (x > 0) return pi * R * R - beyond(y);
    if (y > 0) return pi * R * R - beyond(x);
    return 0;
}

/// Nodes and weights of Gauss and Legendre on [-1, 1], by Newton's method on the Legendre polynomial.
struct gauss_legendre {
    explicit gauss_legendre(int n) {
        for (int i = 0; i < n; ++i) {
            double x = std::cos(3.14159265358979323846 * (i + 0.75) / (n + 0.5)), slope = 1;
            for (int newton = 0; newton < 100; ++newton) {
                double below = 1, here = x;
                for (int k = 2; k <= n; ++k) {
                    const double above = ((2 * k - 1) * x * here - (k - 1) * below) / k;
                    below = here;
                    here = above;
                }
                slope = n * (x * here - below) / (x * x - 1);
                const double step = here / slope;
                x -= step;
                if (std::abs(step) < 1e-15) break;
            }
            nodes.push_back(n == 1 ? 0.0 : x);
            weights.push_back(n == 1 ? 2.0 : 2 / ((1 - x * x) * slope * slope));
        }
    }
    std::vector<double> nodes, weights;
};

/// Volume of the part of a sphere of radius R about the origin that is in the box low to high, to 1e-10 R^3: discs in
/// closed form, integrated along z between the heights where their circle meets a side or a corner of the box.
inline double sphere_box_overlap(double R, const point& low, const point& high) {
    static const gauss_legendre rule(16);
    const double bottom = std::max(low[2], -R), top = std::min(high[2], R);
    if (!(bottom < top)) return 0;
    double nearest = 0, farthest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double inside = std::clamp(0.0, low[a], high[a]);
        const double beyond = std::max(-low[a], high[a]);
        nearest += inside * inside;
        farthest += beyond * beyond;
    }
    if (nearest >= R * R) return 0;
    if (farthest <= R * R) return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
    std::vector<double> heights{bottom, top};
    const auto meet = [&](double squared_radius) {
        if (squared_radius >= R * R) return;
        const double z = std::sqrt(R * R - squared_radius);
        for (const double h : {-z, z}) {
            if (h > bottom && h < top) heights.push_back(h);
        }
    };
    for (const double x : {low[0], high[0]}) {
        meet(x * x);
        for (const double y : {low[1], high[1]}) meet(x * x + y * y);
    }
    for (const double y : {low[1], high[1]}) meet(y * y);
    std::sort(heights.begin(), heights.end());
    double volume = 0;
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
        const double middle = 0.5 * (heights[k] + heights[k + 1]), half = 0.5 * (heights[k + 1] - heights[k]);
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            // z = middle + half sin(pi t / 2): square roots at both ends become smooth.
            const double angle = 0.5 * 3.14159265358979323846 * rule.nodes[q];
            const double z = middle + half * std::sin(angle);
            const double r = std::sqrt(std::max(0.0, R * R - z * z));
            const double area = disc_corner_area(r, high[0], high[1]) - disc_corner_area(r, low[0], high[1]) -
                                disc_corner_area(r, high[0], low[1]) + disc_corner_area(r, low[0], low[1]);
            volume += rule.weights[q] * half * 0.5 * 3.14159265358979323846 * std::cos(angle) * area;
        }
    }
    return volume;
}

/// The indicator of a sphere of radius R, filtered with a Gaussian of standard deviation sigma, at the distance r from
/// its centre.  Closed form of the integral over the sphere.
inline double gauss_filtered_sphere(double r, double R, double sigma) {
    const double pi = 3.14159265358979323846, s = sigma * std::sqrt(2.0);
    if (r < 1e-6 * sigma) {  // the limit r -> 0; the next term is of relative order (r / sigma)^2
        return std::erf(R / s) - 2 * R / (s * std::sqrt(pi)) * std::exp(-R * R / (s * s));
    }
    const double near = (R - r) / s, far = (R + r) / s;
    return 0.5 * (std::erf(near) + std::erf(far)) -
           sigma / (r * std::sqrt(2 * pi)) * (std::exp(-near * near) - std::exp(-far * far));
}

/// The indicator of a sphere of radius R, averaged over a ball of radius a, at the distance r: volume of their lens
/// over that of the ball.
inline double ball_filtered_sphere(double r, double R, double a) {
    const double pi = 3.14159265358979323846, ball = 4.0 / 3.0 * pi * a * a * a;
    if (r >= R + a) return 0;
    if (r <= std::abs(R - a)) return 4.0 / 3.0 * pi * std::pow(std::min(R, a), 3) / ball;
    const double depth = R + a - r;
    return pi * depth * depth * (r * r + 2 * r * (a + R) - 3 * (a - R) * (a - R)) / (12 * r) / ball;
}

}  // namespace hearth::test
