// SPDX-License-Identifier: MIT
#include "steadying.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <hearth/furnace/spinel.hpp>

#include "packing.hpp"

namespace hearth::furnace {

namespace {

constexpr double settling = 0.2;  // of the couplings, left out: what a shift disturbs settles in them

}  // namespace

steadying::steadying(const settings& scene)
    : height_(scene.shaft.height),
      interval_(scene.time.steadying_interval),
      planned_(scene.time.couplings),
      // Slices that hold a layer of parcels at least, so that their mean temperature does not feel where each of them
      // lies.
      slices_(static_cast<std::size_t>(
          std::clamp(height_ / (0.75 * scene.bed.coarse_graining * sauter_diameter(scene)), 10.0, 400.0))) {}

void steadying::watch(const parcels& bed, double step) {
    if (interval_ == 0) return;
    const std::size_t from = mass_.size();
    for (auto* sums : {&mass_, &enthalpy_, &height_moment_}) sums->resize(from + slices_, 0.0);
    times_.push_back(times_.empty() ? step : times_.back() + step);
    const std::vector<dem::sphere>& spheres = bed.bed.spheres();
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const double z = spheres[i].centre.z / height_ * static_cast<double>(slices_);
        if (!(z >= 0 && z < static_cast<double>(slices_))) continue;
        const std::size_t k = from + static_cast<std::size_t>(z);
        const double mass = bed.bed.masses()[i];
        mass_[k] += mass;
        enthalpy_[k] += mass * spinel::enthalpy(bed.fields.temperature[i]);
        height_moment_[k] += mass * spheres[i].centre.z;
    }
}

bool steadying::due(int couplings, std::size_t judged) const {
    const auto watched = static_cast<int>(times_.size()), quiet = 2 * static_cast<int>(judged);
    if (interval_ == 0 || watched < interval_) return false;
    return couplings + quiet <= planned_ || (couplings > planned_ && watched >= interval_ + quiet);
}

/// Over couplings from `from` to before `to`.
std::vector<double> steadying::sum(const std::vector<double>& values, std::size_t from, std::size_t to) const {
    std::vector<double> total(slices_, 0.0);
    for (std::size_t n = from; n < to; ++n) {
        for (std::size_t k = 0; k < slices_; ++k) total[k] += values[n * slices_ + k];
    }
    return total;
}

/// Enthalpy of a kilogram in the middle of each slice, by straight lines between the means of the slices' parcels: by
/// the kilogram and at that height, since how many parcels lie in a slice, and where, changes from coupling to
/// coupling.
std::vector<double> steadying::enthalpy_over_height(std::size_t from, std::size_t to) const {
    const std::vector<double> mass = sum(mass_, from, to), enthalpy = sum(enthalpy_, from, to),
                              moment = sum(height_moment_, from, to);
    std::vector<double> z, h;
    for (std::size_t k = 0; k < slices_; ++k) {
        if (!(mass[k] > 0)) continue;
        z.push_back(moment[k] / mass[k]);
        h.push_back(enthalpy[k] / mass[k]);
    }
    std::vector<double> found(slices_);
    const double slice = height_ / static_cast<double>(slices_);
    std::size_t low = 0;
    for (std::size_t k = 0; k < slices_; ++k) {
        const double at = (static_cast<double>(k) + 0.5) * slice;
        while (low + 2 < z.size() && z[low + 1] < at) ++low;
        found[k] = h[low] + (at - z[low]) / (z[low + 1] - z[low]) * (h[low + 1] - h[low]);
    }
    return found;
}

steadying::leap steadying::shift(const settings& measured, std::size_t turn) {
    const std::size_t all = times_.size();
    std::size_t half = (all - static_cast<std::size_t>(settling * static_cast<double>(all))) / 2;
    if (half > turn) half -= half % turn;
    const std::size_t late = all - half, early = late - half;
    const auto when = [&](std::size_t from) {
        return std::accumulate(&times_[from], &times_[from] + half, 0.0) / static_cast<double>(half);
    };
    const std::vector<double> before = enthalpy_over_height(early, late), after = enthalpy_over_height(late, all),
                              mass = sum(mass_, early, all);
    const double time = when(late) - when(early), slice = height_ / static_cast<double>(slices_);
    std::vector<double> temperature(slices_), storage(slices_), slack(slices_);
    for (std::size_t k = 0; k < slices_; ++k) {
        storage[k] = (after[k] - before[k]) / time * mass[k] / static_cast<double>(all - early) / slice;
        temperature[k] = spinel::temperature(after[k]);
        slack[k] = std::abs(temperature[k] - spinel::temperature(before[k]));
    }
    for (auto* sums : {&mass_, &enthalpy_, &height_moment_, &times_}) sums->clear();
    leap found{shift_to_steady(measured, temperature, storage), slack, steady_range(measured)};
    const auto leads_beyond = [&](double share) {
        for (std::size_t k = 0; k < found.shift.size(); ++k) {
            const double moved = temperature[k] + share * found.shift[k];
            if (found.bounded(temperature[k], moved, slack[k]) != moved) return true;
        }
        return false;
    };
    double share = 1;
    while (share > 1e-3 && leads_beyond(share)) share *= 0.5;
    found.halved = share < 1;
    if (share <= 1e-3) found.shift.clear();
    for (double& kelvin : found.shift) kelvin *= share;
    return found;
}

}  // namespace hearth::furnace
