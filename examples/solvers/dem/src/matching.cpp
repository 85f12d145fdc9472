// SPDX-License-Identifier: MIT
#include "matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "near_rows.hpp"

namespace hearth::dem::detail {
namespace {

using point4 = std::array<double, 4>;
using places = std::vector<index>::iterator;

std::vector<point4> points_of(const std::vector<sphere>& spheres, double size_weight) {
    std::vector<point4> points;
    points.reserve(spheres.size());
    for (const sphere& s : spheres) points.push_back({s.centre.x, s.centre.y, s.centre.z, size_weight * s.radius});
    return points;
}

double squared_way(const point4& a, const point4& b) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

std::size_t longest_side(const std::vector<point4>& points, places begin, places end) {
    point4 low = points[static_cast<std::size_t>(*begin)], high = low;
    for (auto p = begin; p != end; ++p) {
        for (std::size_t k = 0; k < 4; ++k) {
            low[k] = std::fmin(low[k], points[static_cast<std::size_t>(*p)][k]);
            high[k] = std::fmax(high[k], points[static_cast<std::size_t>(*p)][k]);
        }
    }
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 4; ++k)
        if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
    return longest;
}

void halve(const std::vector<point4>& from, const std::vector<point4>& to, places from_begin, places from_end,
           places to_begin, places to_end) {
    const auto count = to_end - to_begin;
    if (count < 2) return;
    const std::size_t side = longest_side(to, to_begin, to_end);
    const auto split = [&](const std::vector<point4>& points, places begin, places end) {
        std::nth_element(begin, begin + count / 2, end, [&](index i, index j) {
            const double a = points[static_cast<std::size_t>(i)][side], b = points[static_cast<std::size_t>(j)][side];
            return a != b ? a < b : i < j;
        });
        return begin + count / 2;
    };
    const auto from_middle = split(from, from_begin, from_end), to_middle = split(to, to_begin, to_end);
    halve(from, to, from_begin, from_middle, to_begin, to_middle);
    halve(from, to, from_middle, from_end, to_middle, to_end);
}

}  // namespace

std::vector<index> matched(const std::vector<sphere>& from, const std::vector<sphere>& to, double size_weight) {
    const std::vector<point4> a = points_of(from, size_weight), b = points_of(to, size_weight);
    std::vector<index> a_order(a.size()), b_order(b.size()), partner(b.size());
    std::iota(a_order.begin(), a_order.end(), 0);
    std::iota(b_order.begin(), b_order.end(), 0);
    halve(a, b, a_order.begin(), a_order.end(), b_order.begin(), b_order.end());
    for (std::size_t k = 0; k < b.size(); ++k) partner[static_cast<std::size_t>(b_order[k])] = a_order[k];

    const std::vector<bed::pair> neighbours = near_pairs(to, 2.0);
    constexpr int most_passes = 30;
    bool better = true;
    for (int pass = 0; pass < most_passes && better; ++pass) {
        better = false;
        for (const auto& [i, j] : neighbours) {
            index &ours = partner[static_cast<std::size_t>(i)], &theirs = partner[static_cast<std::size_t>(j)];
            const auto way = [&](index to_place, index from_place) {
                return squared_way(b[static_cast<std::size_t>(to_place)], a[static_cast<std::size_t>(from_place)]);
            };
            if (way(i, theirs) + way(j, ours) >= way(i, ours) + way(j, theirs)) continue;
            std::swap(ours, theirs);
            better = true;
        }
    }
    return partner;
}

}  // namespace hearth::dem::detail
