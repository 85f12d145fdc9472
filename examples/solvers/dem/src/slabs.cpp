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
    std::vector<std::vector<index>> to(static_cast<std::size_t>(among_->size()));
    for (const index k : kept)
        to[static_cast<std::size_t>(owner_of(particles.spheres[static_cast<std::size_t>(k)].centre))].push_back(k);
    std::vector<index> staying;
    std::vector<parcel<char>> outgoing;
    for (int r = 0; r < among_->size(); ++r) {
        std::vector<index>& theirs = to[static_cast<std::size_t>(r)];
        if (r == among_->rank()) {
            staying = std::move(theirs);
        } else if (!theirs.empty()) {
            writer archive;
            pack(particles, theirs, past, archive);
            outgoing.push_back({r, std::move(archive.out)});
        }
    }
    for (const auto& from : among_->exchange(std::move(outgoing))) {
        const auto first = static_cast<index>(particles.owned);
        reader archive(from.values.data(), from.values.size());
        unpack(archive, particles, past);
        for (auto k = first; k < static_cast<index>(particles.owned); ++k) staying.push_back(k);
    }
    kept = std::move(staying);
}

}  // namespace hearth::dem::detail
