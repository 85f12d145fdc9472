// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <hearth/core/agree.hpp>
#include <hearth/core/element.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/voidage/vfs_cells.hpp>
#include <hearth/voidage/vfs_completion.hpp>
#include <hearth/voidage/vfs_log.hpp>

namespace hearth::detail {

/// The linear map of a call of the Volume Fraction Smoother, applied to other fields.  Cells and pools are well mixed:
/// what a cell gives of its solid it gives of anything else.  Keeps references to the mesh and the log.
template <class Graph>
class smoothing_replay {
  public:
    using index = typename Graph::index;
    using mesh_type = smoothing_mesh<Graph>;
    static constexpr bool is_distributed = mesh_type::is_distributed;

    smoothing_replay(const mesh_type& mesh, const smoothing_log& log, smoothing_completion<Graph>& completion)
        : mesh_(mesh), log_(log), completion_(completion) {
        if constexpr (is_distributed) {
            given_.resize(static_cast<std::size_t>(mesh.owned()));
            ghosts_.resize(static_cast<std::size_t>(mesh.graph().total_count() - mesh.owned()));
        }
    }

    /// Moves amounts as the solid was moved.
    template <class Field>
    void scatter(Field& amounts) {
        refuse_infinite(amounts, "amount of cell", [](auto&&...) {});
        const std::uint8_t* bits = log_.bits();
        for (std::size_t sweep = 0; sweep < log_.sweeps(); ++sweep) {
            if constexpr (is_distributed) {
                const std::uint8_t* ahead = bits;
                for_each_giver(sweep, ahead, [&](std::size_t entry, index cell) {
                    if (is_owned(cell)) given_[place(cell)] = take(entry, ahead, at(amounts, cell));
                });
                fetch_ghosts(given_);
            }
            for_each_giver(sweep, bits, [&](std::size_t entry, index cell) {
                double given = 0;  // per volume of a receiver
                if constexpr (is_distributed) {
                    given = is_owned(cell) ? given_[place(cell)] : ghosts_[place(cell - mesh_.owned())];
                } else {
                    given = take(entry, bits, at(amounts, cell));
                }
                for_each_receiver(cell, bits, [&](index n) {
                    if (is_owned(n)) at(amounts, n) += static_cast<scalar_of<Field>>(given * mesh_.volume(n));
                });
            });
        }
        sum_pools(log_.giving(), [&](const auto& entry) {
            auto& amount = at(amounts, entry.cell);
            const double kept = entry.part * static_cast<double>(amount);
            const double given = static_cast<double>(amount) - kept;
            amount = static_cast<scalar_of<Field>>(kept);
            return given;
        });
        for (const auto& entry : log_.receiving()) {
            at(amounts, entry.cell) += static_cast<scalar_of<Field>>(entry.part * pools_[place(entry.pool)]);
        }
    }

    /// The transpose: what a unit put into a cell would meet where scatter() sends it.
    template <class Field>
    void gather(Field& values) {
        const auto each_receiver = [&](index cell, const std::uint8_t* bits, auto&& look) {
            for_each_receiver(cell, bits, look);
        };
        refuse_infinite(values, "value of cell", each_receiver);
        sum_pools(log_.receiving(),
                  [&](const auto& entry) { return entry.part * static_cast<double>(at(values, entry.cell)); });
        for (const auto& entry : log_.giving()) {
            mix(at(values, entry.cell), entry.part, pools_[place(entry.pool)]);
        }
        const std::uint8_t* bits = log_.bits_end();
        for (std::size_t sweep = log_.sweeps(); sweep-- > 0;) {
            if constexpr (is_distributed) fetch_ghosts(values);
            for (std::size_t entry = log_.sweep_end(sweep); entry-- > log_.sweep_begin(sweep);) {
                const index cell = log_.cell(entry);
                bits -= row_bytes(cell);
                if (!is_owned(cell)) continue;
                double sum = 0;
                for_each_receiver(cell, bits, [&](index n) {
                    const double value =
                        is_owned(n) ? static_cast<double>(at(values, n)) : ghosts_[place(n - mesh_.owned())];
                    sum += value * mesh_.volume(n);
                });
                mix(at(values, cell), log_.kept(entry), sum / receiver_volume(cell, bits));
            }
        }
    }

  private:
    static std::size_t place(index i) { return static_cast<std::size_t>(i); }
    template <class Field>
    static auto& at(Field& field, index cell) {
        return element(field, cell);
    }
    template <class Field>
    using scalar_of = std::remove_reference_t<decltype(element(std::declval<Field&>(), 0))>;

    bool is_owned(index cell) const { return !is_distributed || cell < mesh_.owned(); }
    std::size_t row_bytes(index cell) const {
        const auto row = mesh_.neighbours(cell);
        return smoothing_log::row_bytes(static_cast<std::size_t>(row.last - row.first));
    }

    /// Visits the entries of a sweep; during a visit bits stands at those of the entry.
    template <class Visit>
    void for_each_giver(std::size_t sweep, const std::uint8_t*& bits, Visit&& visit) const {
        for (std::size_t entry = log_.sweep_begin(sweep); entry < log_.sweep_end(sweep); ++entry) {
            visit(entry, log_.cell(entry));
            bits += row_bytes(log_.cell(entry));
        }
    }

    template <class Visit>
    void for_each_receiver(index cell, const std::uint8_t* bits, Visit&& visit) const {
        std::size_t k = 0;
        for (const index n : mesh_.neighbours(cell)) {
            if ((bits[k / 8] >> k % 8 & 1U) != 0) visit(n);
            ++k;
        }
    }

    double receiver_volume(index cell, const std::uint8_t* bits) const {
        double volume = 0;
        double rest = 0;
        for_each_receiver(cell, bits, [&](index n) {
            const two_sum grown(volume, mesh_.volume(n));
            volume = grown.sum;
            rest += grown.error;
        });
        return volume + rest;
    }

    /// Throws, on all ranks, where a value that the map would move or mix is not finite.
    template <class Field, class EachOther>
    void refuse_infinite(const Field& field, const char* place, const EachOther& for_each_other) {
        std::optional<bad_value> wrong;
        const auto look = [&](index cell) {
            if (!is_owned(cell) || wrong) return;
            const auto value = static_cast<double>(element(field, cell));
            if (!std::isfinite(value)) wrong.emplace(place, mesh_.graph().global_index(cell), value, "finite");
        };
        const std::uint8_t* bits = log_.bits();
        for (std::size_t sweep = 0; sweep < log_.sweeps(); ++sweep) {
            for_each_giver(sweep, bits, [&](std::size_t, index cell) {
                look(cell);
                for_each_other(cell, bits, look);
            });
        }
        for (const auto& entry : log_.giving()) look(entry.cell);
        for (const auto& entry : log_.receiving()) look(entry.cell);
        throw_agreed(mesh_.graph().communicator(), wrong);
    }

    /// Takes from an amount what its cell gives, per volume of its receivers.
    template <class Scalar>
    double take(std::size_t entry, const std::uint8_t* bits, Scalar& amount) const {
        const double kept = log_.kept(entry) * static_cast<double>(amount);
        const double given = static_cast<double>(amount) - kept;
        amount = static_cast<Scalar>(kept);
        return given / receiver_volume(log_.cell(entry), bits);
    }

    template <class Scalar>
    static void mix(Scalar& value, double kept, double other) {
        const auto own = static_cast<double>(value);
        value = static_cast<Scalar>(kept * own + (1 - kept) * other);
    }

    /// Values of ghosts from their owners.
    template <class Field>
    void fetch_ghosts(const Field& field) {
        const auto& halo = mesh_.graph().halo();
        std::vector<double> buffer;
        buffer.reserve(halo.export_cells().size());
        for (const index cell : halo.export_cells()) buffer.push_back(static_cast<double>(element(field, cell)));
        auto request = halo.communicator().begin(buffer.data(), halo.exports(), ghosts_.data(), halo.imports());
        halo.communicator().end(request);
    }

    /// Adds the terms of each pool, in a way that no order can change.
    template <class Term>
    void sum_pools(const std::vector<smoothing_log::pool_entry>& entries, Term&& term) {
        pools_.assign(place(log_.pools()), 0);
        if (!log_.has_pools()) return;
        terms_.clear();
        double bound = 0;
        for (const auto& entry : entries) {
            terms_.push_back(term(entry));
            bound = std::max(bound, std::abs(terms_.back()));
        }
        const reproducible_sum zero(mesh_.graph().communicator().max(bound), mesh_.cells_everywhere());
        std::vector<reproducible_sum> sums(pools_.size(), zero);
        for (std::size_t k = 0; k < entries.size(); ++k) sums[place(entries[k].pool)].add(terms_[k]);
        completion_.reduce_pools(zero, sums);
        for (std::size_t p = 0; p < sums.size(); ++p) pools_[p] = sums[p].value();
    }

    const mesh_type& mesh_;
    const smoothing_log& log_;
    smoothing_completion<Graph>& completion_;
    std::vector<double> pools_;
    std::vector<double> terms_;
    std::vector<double> given_;   // distributed only
    std::vector<double> ghosts_;  // distributed only
};

}  // namespace hearth::detail
