// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/voidage/four.hpp>
#include <hearth/voidage/visitors.hpp>

namespace hearth {

/// What the cells of one rank can tell about the place of a particle.
struct sighting {
    bool inside;     ///< the particle's centre is in one of these cells
    double nearest;  ///< least distance of the particle from them, in the measure of the policy
};

/// The matrix from particles to cells that a deposit policy makes, stored at 8 bytes an entry: particle p gives cell c
/// the share  weight * scale(p)  of anything it has, and the shares of a particle sum to 1.
///
/// Weights are floats of any size in (0, 1]; the scale of a particle, a double, is one over their exact sum.  So shares
/// sum to 1 to round-off, and neither storage order nor the number of ranks can change a bit of them.
///
/// A policy (see deposit.hpp) offers, for a particle and the owned cells of a rank:
///     sighting for_each_weight(locator, visitor, visit)            visit(cell, weight)
/// and where weights are others as soon as the nearest cell of all ranks is further than 0
///     void for_each_far_weight(locator, visitor, nearest, visit)   for those particles, in place of the first
///
/// Errors: bad_value as visitors has them, and for a particle whose centre is outside the mesh.  Thrown on every rank.
template <class Communicator = serial_communicator>
class footprints {
  public:
    struct entry {
        std::int32_t cell;
        float weight;
    };

    template <class Mesh, class Cloud, class Policy>
    footprints(const cell_locator<Mesh, Communicator>& locator, const Cloud& cloud, const Policy& policy)
        : visitors_(locator, cloud) {
        rows_.reserve(visitors_.size() + 1);
        rows_.push_back(0);
        std::vector<sighting> seen;
        seen.reserve(visitors_.size());
        std::vector<limbs<1>> partial;
        partial.reserve(visitors_.size());
        const reproducible_sum nothing(1.0, most_terms);
        for (const visitor& v : visitors_) {
            row next(*this, nothing);
            seen.push_back(policy.for_each_weight(locator, v, next));
            partial.push_back(next.end());
        }
        const std::vector<double> nearest = agree(seen);
        if constexpr (sees_far<Policy, cell_locator<Mesh, Communicator>>::value) {
            if (std::any_of(nearest.begin(), nearest.end(), is_far))
                weigh_far(locator, policy, nearest, nothing, partial);
        }
        owner_scales_ = sum_over_ranks<double>({nothing}, partial);
        for (double& scale : owner_scales_) scale = 1 / scale;
        scales_ = visitors_.bring(owner_scales_);
    }

    const hearth::visitors<Communicator>& visitors() const { return visitors_; }

    /// Entries of the k-th visitor on this rank.
    const entry* begin(std::size_t k) const { return entries_.data() + rows_[k]; }
    const entry* end(std::size_t k) const { return entries_.data() + rows_[k + 1]; }
    std::size_t entry_count() const { return entries_.size(); }
    double scale(std::size_t k) const { return scales_[k]; }
    /// What this rank holds [bytes].
    std::size_t memory() const {
        return visitors_.memory() + rows_.capacity() * sizeof(rows_[0]) + entries_.capacity() * sizeof(entry) +
               (scales_.capacity() + owner_scales_.capacity()) * sizeof(double);
    }

    /// Adds what each visitor has (one value for each, or one of four fields) to the owned cells, in the order of the
    /// visitors' ids.
    template <class Value>
    void scatter(const std::vector<Value>& at_visitors, Value* cells) const {
        for (std::size_t k = 0; k < visitors_.size(); ++k) {
            const Value amount = scales_[k] * at_visitors[k];
            for (const entry* e = begin(k); e != end(k); ++e) {
                cells[e->cell] += static_cast<double>(e->weight) * amount;
            }
        }
    }

    /// Mean of a field of owned cells, or of four, over each particle's shares, for the particles that this rank owns:
    /// the transpose of scatter.  bound: no value of the field is larger in magnitude, on any rank.
    template <class Value>
    std::vector<Value> gather(const Value* cells, const Value& bound) const {
        constexpr std::size_t fields = detail::fields_in<Value>;
        const auto nothing = empty_sums(bound, std::make_index_sequence<fields>{});
        std::vector<limbs<fields>> partial;
        partial.reserve(visitors_.size());
        for (std::size_t k = 0; k < visitors_.size(); ++k) {
            auto sums = nothing;
            for (const entry* e = begin(k); e != end(k); ++e) {
                for (std::size_t f = 0; f < fields; ++f) {
                    sums[f].add(static_cast<double>(e->weight) * detail::number(cells[e->cell], f));
                }
            }
            partial.push_back(take_limbs(sums));
        }
        std::vector<Value> result = sum_over_ranks<Value>(nothing, partial);
        for (std::size_t i = 0; i < result.size(); ++i) result[i] *= owner_scales_[i];
        return result;
    }

  private:
    template <std::size_t sums>
    using limbs = std::array<std::int64_t, sums * reproducible_sum::limb_count()>;
    /// No particle touches more cells; leaves 3 * 30 bits for each sum.
    static constexpr std::int64_t most_terms = std::int64_t{1} << 31;

    template <class Value, std::size_t... f>
    static std::array<reproducible_sum, sizeof...(f)> empty_sums(const Value& bound, std::index_sequence<f...>) {
        const auto empty = [](double b) { return reproducible_sum(b > 0 ? b : 1.0, most_terms); };
        return {empty(detail::number(bound, f))...};
    }

    template <std::size_t count>
    static limbs<count> take_limbs(std::array<reproducible_sum, count>& sums) {
        limbs<count> all;
        auto to = all.begin();
        for (reproducible_sum& sum : sums) to = std::copy_n(sum.limbs(), reproducible_sum::limb_count(), to);
        return all;
    }

    static bool is_far(double nearest) { return nearest > 0; }

    /// Policies whose weights depend on how far the nearest cell is.
    template <class Policy, class Locator, class = void>
    struct sees_far : std::false_type {};
    template <class Policy, class Locator>
    struct sees_far<Policy, Locator,
                    std::void_t<decltype(std::declval<const Policy&>().for_each_far_weight(
                        std::declval<const Locator&>(), std::declval<const visitor&>(), 0.0,
                        std::declval<void (&)(std::int32_t, double)>()))>> : std::true_type {};

    /// The entries of the next visitor, and their sum.
    class row {
      public:
        row(footprints& all, const reproducible_sum& nothing) : all_(all), sum_{nothing} {}
        void operator()(std::int32_t cell, double weight) {
            const auto stored = static_cast<float>(weight);
            if (!(stored > 0)) return;  // below the smallest float: nothing, whatever the other weights are
            all_.entries_.push_back({cell, stored});
            sum_[0].add(static_cast<double>(stored));
        }
        limbs<1> end() {
            all_.rows_.push_back(all_.entries_.size());
            return take_limbs(sum_);
        }

      private:
        footprints& all_;
        std::array<reproducible_sum, 1> sum_;
    };

    /// Makes the rows of far visitors anew, and keeps the others.
    template <class Locator, class Policy>
    void weigh_far(const Locator& locator, const Policy& policy, const std::vector<double>& nearest,
                   const reproducible_sum& nothing, std::vector<limbs<1>>& partial) {
        const std::vector<std::size_t> rows = std::exchange(rows_, {0});
        const std::vector<entry> entries = std::exchange(entries_, {});
        rows_.reserve(rows.size());
        entries_.reserve(entries.size());
        for (std::size_t k = 0; k < visitors_.size(); ++k) {
            if (is_far(nearest[k])) {
                row next(*this, nothing);
                policy.for_each_far_weight(locator, visitors_[k], nearest[k], next);
                partial[k] = next.end();
            } else {
                entries_.insert(entries_.end(), entries.data() + rows[k], entries.data() + rows[k + 1]);
                rows_.push_back(entries_.size());
            }
        }
    }

    /// Distance of the nearest cell for each visitor, agreed over the ranks that it visits.
    std::vector<double> agree(const std::vector<sighting>& seen) const {
        std::vector<std::uint8_t> inside(visitors_.owned_count(), 0);
        std::vector<double> nearest(visitors_.owned_count(), std::numeric_limits<double>::infinity());
        visitors_.take_back(seen, [&](std::size_t particle, const sighting& s) {
            inside[particle] |= static_cast<std::uint8_t>(s.inside);
            nearest[particle] = std::min(nearest[particle], s.nearest);
        });
        std::optional<bad_value> wrong;
        for (std::size_t i = 0; i < inside.size() && !wrong; ++i) {
            if (!inside[i]) wrong = outside(visitors_.owned(i));
        }
        throw_agreed(visitors_.communicator(), wrong);
        return visitors_.bring(nearest);
    }

    static bad_value outside(const visitor& v) {
        std::ostringstream where;
        where << "inside the mesh, but its centre (" << v.position[0] << ", " << v.position[1] << ", " << v.position[2]
              << ") is in no cell [m]";
        return {"x coordinate of particle", v.id, v.position[0], where.str()};
    }

    template <class Value>
    std::vector<Value> sum_over_ranks(const std::array<reproducible_sum, detail::fields_in<Value>>& nothing,
                                      const std::vector<limbs<detail::fields_in<Value>>>& partial) const {
        std::vector<std::decay_t<decltype(nothing)>> sums(visitors_.owned_count(), nothing);
        visitors_.take_back(partial, [&](std::size_t particle, const auto& some) {
            auto from = some.begin();
            for (reproducible_sum& sum : sums[particle]) {
                for (std::size_t l = 0; l < reproducible_sum::limb_count(); ++l) sum.limbs()[l] += *from++;
            }
        });
        std::vector<Value> values(sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            for (std::size_t f = 0; f < sums[i].size(); ++f) detail::number(values[i], f) = sums[i][f].value();
        }
        return values;
    }

    hearth::visitors<Communicator> visitors_;
    std::vector<std::size_t> rows_;
    std::vector<entry> entries_;
    std::vector<double> scales_;        // of visitors
    std::vector<double> owner_scales_;  // of owned particles
};

}  // namespace hearth
