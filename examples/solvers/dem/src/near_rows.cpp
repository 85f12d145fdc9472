// SPDX-License-Identifier: MIT
#include "near_rows.hpp"

namespace hearth::dem::detail {

std::vector<bed::pair> near_pairs(const std::vector<sphere>& spheres, double factor, double low, double high) {
    double largest = 0;
    std::vector<index> number;
    std::vector<sphere> between;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (!(spheres[i].centre.z >= low && spheres[i].centre.z <= high)) continue;
        largest = std::fmax(largest, spheres[i].radius);
        number.push_back(static_cast<index>(i));
        between.push_back(spheres[i]);
    }
    std::vector<bed::pair> pairs;
    if (between.empty()) return pairs;
    const double reach = factor * 2 * largest;
    const fine_cells cells(between.data(), between.size(), reach);
    std::vector<vector3> centres(between.size());
    std::vector<index> of_place(between.size());
    for (std::size_t a = 0; a < centres.size(); ++a) {
        const auto k = static_cast<std::size_t>(cells.order[a]);
        centres[a] = between[k].centre;
        of_place[a] = number[k];
    }
    for_each_near_row(cells, centres, reach, [&](index a, const index* places, std::size_t count) {
        const index i = of_place[static_cast<std::size_t>(a)];
        for (std::size_t k = 0; k < count; ++k) pairs.push_back({i, of_place[static_cast<std::size_t>(places[k])]});
    });
    return pairs;
}

}  // namespace hearth::dem::detail
