// SPDX-License-Identifier: MIT
#include "near_rows.hpp"

namespace hearth::dem::detail {

std::vector<bed::pair> near_pairs(const std::vector<sphere>& spheres, double factor) {
    double largest = 0;
    for (const sphere& s : spheres) largest = std::fmax(largest, s.radius);
    std::vector<bed::pair> pairs;
    if (largest == 0) return pairs;
    const double reach = factor * 2 * largest;
    const fine_cells cells(spheres.data(), spheres.size(), reach);
    std::vector<vector3> centres(spheres.size());
    for (std::size_t a = 0; a < centres.size(); ++a) centres[a] = spheres[static_cast<std::size_t>(cells.order[a])].centre;
    for_each_near_row(cells, centres, reach, [&](index a, const index* places, std::size_t count) {
        const index i = cells.order[static_cast<std::size_t>(a)];
        for (std::size_t k = 0; k < count; ++k) pairs.push_back({i, cells.order[static_cast<std::size_t>(places[k])]});
    });
    return pairs;
}

}  // namespace hearth::dem::detail
