// SPDX-License-Identifier: MIT
#include "random_packing.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include <hearth/dem/moving_bed.hpp>
#include <hearth/dem/random.hpp>
#include <hearth/furnace/settings.hpp>

namespace hearth::furnace {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double deepest = 1e-3;  // overlap that is left, over the mean diameter
constexpr double skin = 0.15;     // of the list of neighbours, over the distance at which two touch
constexpr int most_steps = 5000;

/// Spheres drawn until they fill the piece, scaled to fill it exactly, anywhere in it.
std::vector<dem::sphere> draw(const repeated_piece& piece, const dem::size_distribution& sizes, std::uint64_t seed) {
    dem::random_source random{seed};
    const double wanted = (1 - piece.void_fraction) * pi * piece.radius * piece.radius * piece.height;
    std::vector<dem::sphere> spheres;
    double held = 0;
    while (held < wanted) {
        const double r = 0.5 * sizes.draw(random), share = std::sqrt(random.uniform(0, 1)),
                     angle = random.uniform(0, 2 * pi);
        const double from_axis = (piece.radius - r) * share;
        spheres.push_back(
            {{from_axis * std::cos(angle), from_axis * std::sin(angle), piece.height * random.uniform(0, 1)}, r});
        held += 4.0 / 3.0 * pi * r * r * r;
    }
    const double scale = std::cbrt(wanted / held);
    for (dem::sphere& s : spheres) s.radius *= scale;
    return spheres;
}

/// Springs between spheres that overlap, and how deep they do.
class repulsion {
  public:
    explicit repulsion(const repeated_piece& piece, const std::vector<dem::sphere>& spheres) : piece_(piece) {
        double largest = 0, smallest = piece.radius;
        for (const dem::sphere& s : spheres) {
            largest = std::max(largest, s.radius);
            smallest = std::min(smallest, s.radius);
        }
        reach_ = 2 * (1 + skin) * largest;
        spare_ = skin * smallest;  // way after which two that were not listed may touch
    }

    /// Forces of springs of stiffness 1; returns the deepest overlap [m].
    double push(const std::vector<dem::sphere>& spheres, std::vector<dem::vector3>& force) {
        if (!listed(spheres)) list(spheres);
        force.assign(spheres.size(), {});
        double most = 0;
        for (const near& n : near_) {
            const auto i = static_cast<std::size_t>(n.i), j = static_cast<std::size_t>(n.j);
            dem::vector3 d = spheres[i].centre - spheres[j].centre;
            d.z -= piece_.height * std::nearbyint(d.z / piece_.height);
            const double touch = spheres[i].radius + spheres[j].radius, square = dot(d, d);
            if (square >= touch * touch || square == 0) continue;
            const double distance = std::sqrt(square), overlap = touch - distance;
            most = std::max(most, overlap);
            const dem::vector3 f = (overlap / distance) * d;
            force[i] += f;
            force[j] -= f;
        }
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            const dem::vector3& x = spheres[i].centre;
            const double from_axis = std::hypot(x.x, x.y), overlap = from_axis + spheres[i].radius - piece_.radius;
            if (overlap <= 0) continue;
            most = std::max(most, overlap);
            force[i] -= (overlap / from_axis) * dem::vector3{x.x, x.y, 0};
        }
        return most;
    }

  private:
    struct near {
        std::int32_t i, j;
    };

    bool listed(const std::vector<dem::sphere>& spheres) const {
        if (centres_.size() != spheres.size()) return false;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            const dem::vector3 d = spheres[i].centre - centres_[i];
            if (dot(d, d) > spare_ * spare_) return false;
        }
        return true;
    }

    /// The bottom of the next piece stands above this one, so that pairs over the joint are found.
    void list(const std::vector<dem::sphere>& spheres) {
        std::vector<dem::sphere> all = spheres;
        std::vector<std::int32_t> origin(spheres.size());
        for (std::size_t i = 0; i < spheres.size(); ++i) origin[i] = static_cast<std::int32_t>(i);
        centres_.clear();
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            centres_.push_back(spheres[i].centre);
            dem::vector3& here = all[i].centre;
            here.z -= piece_.height * std::floor(here.z / piece_.height);
            if (here.z >= reach_) continue;
            origin.push_back(static_cast<std::int32_t>(i));
            all.push_back({{here.x, here.y, here.z + piece_.height}, spheres[i].radius});
        }
        near_.clear();
        const auto inside = static_cast<std::int32_t>(spheres.size());
        const dem::frozen_bed bed(all, std::vector<double>(all.size(), 1.0), {});
        bed.for_each_near(1 + skin, [&](std::int32_t i, std::int32_t j, double) {
            if (i < inside || j < inside)
                near_.push_back({origin[static_cast<std::size_t>(i)], origin[static_cast<std::size_t>(j)]});
        });
    }

    repeated_piece piece_;
    double reach_ = 0, spare_ = 0;
    std::vector<dem::vector3> centres_;  // when the list was made
    std::vector<near> near_;
};

/// By place: layers, rows in them, spheres in these.
void sort_by_place(std::vector<dem::sphere>& spheres, double cell) {
    const auto place = [&](const dem::sphere& s) {
        return std::make_tuple(std::floor(s.centre.z / cell), std::floor(s.centre.y / cell), s.centre.x, s.centre.y,
                               s.centre.z);
    };
    std::sort(spheres.begin(), spheres.end(),
              [&](const dem::sphere& a, const dem::sphere& b) { return place(a) < place(b); });
}

}  // namespace

std::vector<dem::sphere> random_packing(const repeated_piece& piece, const dem::size_distribution& sizes,
                                        std::uint64_t seed) {
    std::vector<dem::sphere> spheres = draw(piece, sizes, seed);
    sort_by_place(spheres, sizes.largest());
    const double allowed = deepest * 0.5 * (sizes.smallest() + sizes.largest());
    repulsion springs(piece, spheres);
    // Masses and springs of 1, so that a sphere between twelve others swings in 1.3; what moves loses a tenth of its
    // velocity in a step, so that what has been pushed apart comes to rest.
    constexpr double step = 0.3, kept = 0.9;
    std::vector<dem::vector3> velocity(spheres.size()), force;
    double overlap = springs.push(spheres, force);
    for (int k = 0; k < most_steps && overlap > allowed; ++k) {
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            velocity[i] = kept * velocity[i] + step * force[i];
            spheres[i].centre += step * velocity[i];
        }
        overlap = springs.push(spheres, force);
    }
    if (overlap > allowed) {
        std::ostringstream text;
        text << "bed.void_fraction is " << piece.void_fraction << ", allowed: more, for spheres at random in a shaft "
             << 2 * piece.radius / sizes.largest() << " times as wide";
        throw bad_scene(text.str());
    }
    for (dem::sphere& s : spheres) {
        s.centre.z -= piece.height * std::floor(s.centre.z / piece.height);
        if (!(s.centre.z < piece.height)) s.centre.z = 0;  // rounding
    }
    sort_by_place(spheres, sizes.largest());
    return spheres;
}

}  // namespace hearth::furnace
