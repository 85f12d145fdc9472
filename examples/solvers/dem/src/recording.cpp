// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>
#include <hearth/dem/recording.hpp>

#include "archive.hpp"
#include "matching.hpp"

namespace hearth::dem {

namespace {

constexpr std::uint64_t magic = 0x3130'6472'6f63'6572u;  // what it is, and its version

/// Where the slots of a frame were in the one before, or passage::fed; and the places in that whose slots are gone.
void follow(const recording::frame& before, const recording::frame& after, std::vector<index>& origin,
            std::vector<index>& gone) {
    origin.clear();
    gone.clear();
    std::size_t i = 0;
    for (const std::uint32_t slot : after.slots) {
        for (; i < before.slots.size() && before.slots[i] < slot; ++i) gone.push_back(static_cast<index>(i));
        const bool stayed = i < before.slots.size() && before.slots[i] == slot;
        origin.push_back(stayed ? static_cast<index>(i++) : passage::fed);
    }
    for (; i < before.slots.size(); ++i) gone.push_back(static_cast<index>(i));
}

const recording& given(const std::shared_ptr<const recording>& record) {
    if (!record) throw std::invalid_argument("hearth: a recorded bed needs a recording, and none was given");
    return *record;
}

/// Points of equal shares of a ball of radius 1: a Fibonacci spiral on each of four shells of equal volume.
std::vector<vector3> points_in_ball() {
    constexpr int shells = 4, on_shell = 12;
    std::vector<vector3> points;
    for (int s = 0; s < shells; ++s) {
        const double r = std::cbrt((s + 0.5) / shells);
        for (int k = 0; k < on_shell; ++k) {
            const double z = 1 - (2 * k + 1.0) / on_shell, turn = (k + 0.25 * s) * 2.399963229728653;
            const double across = std::sqrt(1 - z * z);
            points.push_back(r * vector3{across * std::cos(turn), across * std::sin(turn), z});
        }
    }
    return points;
}

}  // namespace

std::size_t motion_field::bin(const vector3& x) const {
    const vector3 d = x - shaft.base;
    const auto place = [](double share, int count) {
        return static_cast<std::size_t>(std::min(std::max(0.0, share * count), count - 1.0));
    };
    return place(d.z / shaft.height, layers) * static_cast<std::size_t>(rings) +
           place(std::hypot(d.x, d.y) / shaft.radius, rings);
}

/// Of the last frame the lowest leave if there are too many; of the first the highest are fed if there are too few.
void recording::join(double size_weight) {
    const std::vector<sphere> from = spheres(frames_.size() - 1), to = spheres(0);
    const auto by_height = [](const std::vector<sphere>& all) {
        std::vector<index> order(all.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](index i, index j) {
            return all[static_cast<std::size_t>(i)].centre.z < all[static_cast<std::size_t>(j)].centre.z;
        });
        return order;
    };
    std::vector<index> going = by_height(from), coming = by_height(to);
    seam_ = {};
    seam_.surplus = static_cast<int>(going.size()) - static_cast<int>(coming.size());
    if (seam_.surplus > 0) going.erase(going.begin(), going.begin() + seam_.surplus);
    if (seam_.surplus < 0) coming.resize(going.size());
    std::vector<sphere> a, b;
    for (const index i : going) a.push_back(from[static_cast<std::size_t>(i)]);
    for (const index i : coming) b.push_back(to[static_cast<std::size_t>(i)]);
    const std::vector<index> partner = detail::matched(a, b, size_weight);
    wrap_.assign(to.size(), passage::fed);
    double misfit = 0, radius = 0;
    for (std::size_t k = 0; k < b.size(); ++k) {
        const auto p = static_cast<std::size_t>(partner[k]);
        wrap_[static_cast<std::size_t>(coming[k])] = going[p];
        const double way = norm(a[p].centre - b[k].centre);
        seam_.mean_step += way;
        seam_.longest_step = std::fmax(seam_.longest_step, way);
        misfit += (a[p].radius - b[k].radius) * (a[p].radius - b[k].radius);
        radius += b[k].radius;
    }
    const auto n = static_cast<double>(b.size());
    seam_.mean_step /= n;
    seam_.size_misfit = std::sqrt(misfit / n) / (radius / n);
}

void recording::average(const settings& s) {
    field_ = {s.shaft, s.rings, s.layers, {}};
    field_.bins.resize(static_cast<std::size_t>(s.rings) * static_cast<std::size_t>(s.layers));
    std::vector<double> mass(field_.bins.size(), 0.0);
    std::vector<index> origin, gone;
    for (std::size_t f = 0; f + 1 < frames_.size(); ++f) {
        follow(frames_[f], frames_[f + 1], origin, gone);
        double left = 0;
        for (const index i : gone) left += masses_[frames_[f].slots[static_cast<std::size_t>(i)]];
        for (std::size_t i = 0; i < origin.size(); ++i) {
            if (origin[i] == passage::fed) continue;
            const vector3 before = frames_[f].centres[static_cast<std::size_t>(origin[i])],
                          way = frames_[f + 1].centres[i] - before;
            const vector3 middle = before + 0.5 * way, d = middle - s.shaft.base;
            const double r = std::hypot(d.x, d.y);
            const std::size_t at = field_.bin(middle);
            field_.bins[at].axial += way.z;
            field_.bins[at].radial += r > 0 ? (d.x * way.x + d.y * way.y) / r : 0.0;
            field_.bins[at].samples += 1;
            mass[at] += left;
        }
    }
    // Packing: a few frames suffice, they differ little.
    const std::vector<vector3> points = points_in_ball();
    const std::size_t stride = std::max<std::size_t>(1, frames_.size() / 8);
    double looked_at = 0;
    for (std::size_t f = 0; f < frames_.size(); f += stride, looked_at += 1) {
        for (const sphere& ball : spheres(f)) {
            const double share =
                4.0 / 3.0 * constants<double>::pi() * std::pow(ball.radius, 3) / static_cast<double>(points.size());
            for (const vector3& p : points) {
                const vector3 x = ball.centre + ball.radius * p, d = x - s.shaft.base;
                if (d.z < 0 || d.z >= s.shaft.height || std::hypot(d.x, d.y) >= s.shaft.radius) continue;
                field_.bins[field_.bin(x)].solid_fraction += share;
            }
        }
    }
    const double ring = constants<double>::pi() * s.shaft.radius * s.shaft.radius / (s.rings * s.rings);
    for (std::size_t k = 0; k < field_.bins.size(); ++k) {
        motion_field::mean& m = field_.bins[k];
        const auto number = static_cast<double>(k % static_cast<std::size_t>(s.rings));
        m.solid_fraction /= looked_at * ring * (2 * number + 1) * s.shaft.height / s.layers;
        if (mass[k] > 0) m.axial /= mass[k], m.radial /= mass[k];
    }
}

std::vector<sphere> recording::spheres(std::size_t frame_number) const {
    const frame& f = frames_.at(frame_number);
    std::vector<sphere> all;
    for (std::size_t i = 0; i < f.slots.size(); ++i) all.push_back({f.centres[i], radii_[f.slots[i]]});
    return all;
}

std::vector<double> recording::masses(std::size_t frame_number) const {
    std::vector<double> all;
    for (const std::uint32_t slot : frames_.at(frame_number).slots) all.push_back(masses_[slot]);
    return all;
}

std::vector<char> recording::bytes() const {
    detail::writer archive;
    archive(magic);
    archive(radii_);
    archive(masses_);
    archive(static_cast<std::uint64_t>(frames_.size()));
    for (const frame& f : frames_) {
        archive(f.slots);
        archive(f.centres);
    }
    archive(wrap_);
    archive(field_.shaft);
    archive(field_.rings);
    archive(field_.layers);
    archive(field_.bins);
    archive(seam_.mean_step);  // one by one: the structure has gaps, whose bits nobody sets
    archive(seam_.longest_step);
    archive(seam_.size_misfit);
    archive(seam_.surplus);
    archive(detail::checksum(archive.out.data(), archive.out.size()));
    return std::move(archive.out);
}

recording recording::read(const std::vector<char>& bytes) {
    detail::reader archive = detail::opened(bytes, magic, "a recording");
    recording r;
    std::uint64_t count = 0;
    archive(r.radii_);
    archive(r.masses_);
    archive(count);
    for (std::uint64_t k = 0; k < count; ++k) {
        frame f;
        archive(f.slots);
        archive(f.centres);
        r.frames_.push_back(std::move(f));
    }
    archive(r.wrap_);
    archive(r.field_.shaft);
    archive(r.field_.rings);
    archive(r.field_.layers);
    archive(r.field_.bins);
    archive(r.seam_.mean_step);
    archive(r.seam_.longest_step);
    archive(r.seam_.size_misfit);
    archive(r.seam_.surplus);
    return r;
}

std::uint64_t recording::fingerprint() const {
    const std::vector<char> all = bytes();
    std::uint64_t sum = 0;
    std::memcpy(&sum, all.data() + all.size() - sizeof sum, sizeof sum);
    return sum;
}

double recording::mass_of_turn() const {
    double fed = 0;
    for (std::size_t k = 0; k + 1 < frames_.size(); ++k) {
        std::vector<std::uint32_t> came;
        std::set_difference(frames_[k + 1].slots.begin(), frames_[k + 1].slots.end(), frames_[k].slots.begin(), frames_[k].slots.end(),
                            std::back_inserter(came));
        for (const std::uint32_t slot : came) fed += masses_[slot];
    }
    for (std::size_t i = 0; i < wrap_.size(); ++i) {
        if (wrap_[i] == passage::fed) fed += masses_[frames_.front().slots[i]];
    }
    return fed;
}

recorded_bed::recorded_bed(std::shared_ptr<const recording> record, surroundings around, double mass_flow,
                           const decomposition& spread)
    : moving_bed({given(record).spheres(0), given(record).masses(0), {}}, std::move(around), mass_flow, spread),
      record_(std::move(record)),
      fingerprint_(record_->fingerprint()) {}

vector3 recorded_bed::velocity(index i) const {
    const motion_field& field = record_->field();
    const vector3& x = spheres()[static_cast<std::size_t>(i)].centre;
    const motion_field::mean& mean = field.bins[field.bin(x)];
    const vector3 d = x - field.shaft.base;
    const double r = std::hypot(d.x, d.y), outward = r > 0 ? mass_flow() * mean.radial / r : 0.0;
    return {outward * d.x, outward * d.y, mass_flow() * mean.axial};
}

/// Origin of the next frame's places in this frame, and who leaves in between, the lowest first.
void recorded_bed::next(std::vector<index>& origin, std::vector<index>& leaving) const {
    const auto& frames = record_->frames();
    const std::size_t here = ledger_.place;
    if (here + 1 < frames.size()) {
        follow(frames[here], frames[here + 1], origin, leaving);
    } else {
        origin = record_->wrap();
        std::vector<char> stays(all_.spheres.size(), 0);
        for (const index o : origin)
            if (o != passage::fed) stays[static_cast<std::size_t>(o)] = 1;
        leaving.clear();
        for (std::size_t i = 0; i < stays.size(); ++i)
            if (!stays[i]) leaving.push_back(static_cast<index>(i));
    }
    const auto height = [&](index i) { return all_.spheres[static_cast<std::size_t>(i)].centre.z; };
    std::stable_sort(leaving.begin(), leaving.end(), [&](index i, index j) { return height(i) < height(j); });
}

void recorded_bed::move(double, passage& done) {
    std::vector<index> origin, leaving;
    for (bool moved = true; moved;) {
        moved = false;
        next(origin, leaving);
        double needed = 0;
        for (const index i : leaving) needed += all_.masses[static_cast<std::size_t>(i)];
        if (needed > ledger_.due || !(mass_flow_ > 0)) break;
        moved = true;
        ledger_.due -= needed;
        done.mass_out += needed;
        for (const index i : leaving) {
            const auto k = static_cast<std::size_t>(i);
            done.left.push_back({done.origin[k], all_.ids[k], all_.masses[k]});
        }
        const std::size_t frame_number = (ledger_.place + 1) % record_->frames().size();
        ledger_.place = frame_number;
        all_.spheres = record_->spheres(frame_number);
        std::vector<double> of_slots = record_->masses(frame_number);
        std::vector<std::int64_t> ids(origin.size());
        std::vector<index> came_from(origin.size(), passage::fed);
        for (std::size_t k = 0; k < origin.size(); ++k) {
            if (origin[k] == passage::fed) {
                ids[k] = ledger_.next_id++;
                done.mass_in += of_slots[k];
            } else {
                const auto before = static_cast<std::size_t>(origin[k]);
                ids[k] = all_.ids[before];
                of_slots[k] = all_.masses[before];
                came_from[k] = done.origin[before];
            }
        }
        all_.masses.swap(of_slots);
        all_.ids.swap(ids);
        done.origin.swap(came_from);
    }
}

}  // namespace hearth::dem
