// SPDX-License-Identifier: MIT
// What for_each_contact() and for_each_near() compute, many at once.
#include <algorithm>
#include <cmath>
#include <limits>

#include <hearth/dem/bed.hpp>

namespace hearth::dem {

void bed::find_contacts(std::size_t first_pair, contact_block& found) const {
    constexpr std::size_t most = contact_block::pairs;
    const sphere* const all = spheres();
    const pair* const pairs = candidate_pairs().data();
    const std::size_t end = std::min(first_pair + most, candidate_pairs().size());
    std::uint32_t touching[most];
    std::size_t count = 0;
    for (std::size_t p = first_pair; p < end; ++p) {  // without a branch: nobody can foretell who touches
        const sphere &a = all[pairs[p].i], &b = all[pairs[p].j];
        const vector3 d = a.centre - b.centre;
        const double sum = a.radius + b.radius;
        touching[count] = static_cast<std::uint32_t>(p);
        count += dot(d, d) < sum * sum ? 1u : 0u;
    }
    const index owned = size();
    double dx[most], dy[most], dz[most], radius_i[most], radius_j[most];
    for (std::size_t k = 0; k < count; ++k) {
        const auto [i, j] = pairs[touching[k]];
        const sphere &a = all[i], &b = all[j];
        const vector3 d = a.centre - b.centre;
        found.i[k] = i < owned ? i : j;
        found.j[k] = i < owned ? j : i;
        found.x[k] = a.centre.x;
        found.y[k] = a.centre.y;
        found.z[k] = a.centre.z;
        dx[k] = d.x;
        dy[k] = d.y;
        dz[k] = d.z;
        radius_i[k] = a.radius;
        radius_j[k] = b.radius;
    }
    const double stiffness = law().normal_stiffness;
    for (std::size_t k = 0; k < count; ++k) {
        const double distance = std::sqrt(dx[k] * dx[k] + dy[k] * dy[k] + dz[k] * dz[k]);
        const double sum = radius_i[k] + radius_j[k], share = radius_j[k] / sum, overlap = sum - distance;
        found.overlap[k] = overlap;
        found.force[k] = stiffness * std::sqrt(radius_i[k] * share * overlap) * overlap;
        const double way = (radius_i[k] - overlap * share) / distance;
        found.x[k] -= way * dx[k];
        found.y[k] -= way * dy[k];
        found.z[k] -= way * dz[k];
    }
    found.count = count;
}

bed::near_row bed::near_rows(double factor) const {
    near_row row{&near_pairs(factor), {}, {}, {}, 0};
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();  // near to nobody
    row.placed.reserve(row.list->current.size());
    for (const index i : row.list->current)
        row.placed.push_back(i < 0 ? sphere{{nowhere, nowhere, nowhere}, 0} : spheres()[i]);
    return row;
}

void bed::find_near(std::size_t place, double factor, near_row& row) {
    const std::uint32_t begin = row.list->start[place], end = row.list->start[place + 1];
    const index* const second = row.list->second.data();
    if (row.others.size() < end - begin) {
        row.others.resize(end - begin);
        row.distances.resize(end - begin);
    }
    const sphere self = row.placed[place];
    index* const others = row.others.data();
    double* const distances = row.distances.data();
    std::size_t count = 0;
    for (std::uint32_t p = begin; p < end; ++p) {  // without a branch
        const sphere& other = row.placed[static_cast<std::size_t>(second[p])];
        const vector3 d = self.centre - other.centre;
        const double squared = dot(d, d), limit = factor * (self.radius + other.radius);
        others[count] = second[p];
        distances[count] = squared;
        count += squared < limit * limit ? 1u : 0u;
    }
    for (std::size_t k = 0; k < count; ++k) distances[k] = std::sqrt(distances[k]);
    row.count = count;
}

}  // namespace hearth::dem
