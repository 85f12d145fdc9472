// SPDX-License-Identifier: MIT
#include "slabs.hpp"

#include <algorithm>
#include <limits>

#include "check.hpp"
#include "packed_particle.hpp"
#include "quantile.hpp"

namespace hearth::dem::detail {

slabs::slabs(const decomposition& spread) : among_(spread.among), axis_(spread.axis) {
    check(spread.axis >= 0 && spread.axis < 3, "axis of decomposition", spread.axis, "0, 1 or 2");
    cuts_.assign(static_cast<std::size_t>(among_->size()) - 1, 0.0);
}

int slabs::owner_of(const vector3& x) const {
    return static_cast<int>(std::upper_bound(cuts_.begin(), cuts_.end(), x[axis_]) - cuts_.begin());
}

void slabs::balance(const store& particles, const std::vector<index>& kept) {
    const auto coordinate = [&](std::size_t k) { return particles.spheres[static_cast<std::size_t>(kept[k])].centre[axis_]; };
    const auto ranks = static_cast<std::size_t>(among_->size());
    std::vector<std::int64_t> counts(ranks, 0);
    double low = std::numeric_limits<double>::max(), high = -low;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        ++counts[static_cast<std::size_t>(owner_of(particles.spheres[static_cast<std::size_t>(kept[k])].centre))];
        low = std::fmin(low, coordinate(k));
        high = std::fmax(high, coordinate(k));
    }
    among_->sum(counts.data(), ranks);
    std::int64_t everybody = 0;
    for (const std::int64_t c : counts) everybody += c;
    const double share = static_cast<double>(everybody) / static_cast<double>(ranks);
    if (static_cast<double>(*std::max_element(counts.begin(), counts.end())) <= 1.02 * share + 1) return;
    low = among_->min(low);
    high = among_->max(high);
    for (std::size_t r = 1; r < ranks; ++r) {
        const auto below = static_cast<std::int64_t>(share * static_cast<double>(r) + 0.5);
        cuts_[r - 1] = quantile(kept.size(), coordinate, low, high, below, *among_);
    }
    std::sort(cuts_.begin(), cuts_.end());
}

void slabs::migrate(store& particles, history& past, std::vector<index>& kept) const {
    std::vector<writer> to(static_cast<std::size_t>(among_->size()));
    std::vector<index> staying;
    for (const index k : kept) {
        const int owner = owner_of(particles.spheres[static_cast<std::size_t>(k)].centre);
        if (owner == among_->rank()) staying.push_back(k);
        else pack(particles, k, past, to[static_cast<std::size_t>(owner)]);
    }
    std::vector<parcel<char>> outgoing;
    for (std::size_t r = 0; r < to.size(); ++r)
        if (!to[r].out.empty()) outgoing.push_back({static_cast<int>(r), std::move(to[r].out)});
    for (const auto& from : among_->exchange(std::move(outgoing))) {
        const auto first = static_cast<index>(particles.owned);
        reader archive(from.values.data(), from.values.size());
        unpack(archive, particles, past);
        for (auto k = first; k < static_cast<index>(particles.owned); ++k) staying.push_back(k);
    }
    kept = std::move(staying);
}

}  // namespace hearth::dem::detail
