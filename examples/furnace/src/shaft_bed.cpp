// SPDX-License-Identifier: MIT
#include "shaft_bed.hpp"

#include <algorithm>
#include <cstddef>

#include "flat.hpp"
#include "packing.hpp"

namespace hearth::furnace {

namespace {

constexpr double stiff =
    3.77e8;  // modulus at which the bed's weight makes overlaps that do not count [Pa]; the paper's

}  // namespace

dem::bed empty_shaft(const settings& scene, const ranks& among) {
    dem::bed bed(bed_settings_of(scene), {dem::over(among), 2});
    dem::wall floor;
    floor.facets = dem::shape::plane({0, 0, -0.5 * sizes_of(scene).largest()}, {0, 0, 1});
    floor.body = softened(scene);
    floor.contact = contact_of(scene);
    bed.add_wall(floor);
    bed.add_wall(shaft_wall(scene, 4 * scene.shaft.height));
    return bed;
}

double weight_of(const settings& scene) { return std::min(1.0, scene.bed.softened_modulus / stiff); }

void set_weight(dem::bed& bed, double weight) { bed.set_gravity({0, 0, -gravity_of_earth * weight}); }

std::vector<parcel_of_shaft> all_parcels(const dem::bed& bed, const ranks& among) {
    std::vector<parcel_of_shaft> mine;
    for (dem::index i = 0; i < bed.size(); ++i) mine.push_back({bed.ids()[i], bed.spheres()[i], bed.mass(i)});
    std::vector<parcel_of_shaft> all = among.gather(mine);
    std::sort(all.begin(), all.end(), [](const parcel_of_shaft& a, const parcel_of_shaft& b) { return a.id < b.id; });
    return all;
}

void restore_parts(dem::bed& bed, const std::vector<double>& parts, const ranks& among) {
    std::vector<std::vector<char>> mine;
    int part = 0;
    for (std::size_t at = 0; at < parts.size(); ++part) {
        const double bytes = std::ceil(parts[at] / sizeof(double));
        if (!(bytes >= 0 && bytes < static_cast<double>(parts.size() - at)))
            throw bad_scene("the state of the shaft's parcels is damaged");
        const auto first = parts.begin() + static_cast<std::ptrdiff_t>(at),
                   last = first + 1 + static_cast<std::ptrdiff_t>(bytes);
        if (part % among.size() == among.rank()) mine.push_back(to_bytes({first, last}));
        at += 1 + static_cast<std::size_t>(bytes);
    }
    bed.restore_parts(mine);
}

}  // namespace hearth::furnace
