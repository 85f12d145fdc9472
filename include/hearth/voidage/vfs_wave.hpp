// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hearth/voidage/vfs_cells.hpp>
#include <hearth/voidage/vfs_log.hpp>

namespace hearth::detail {

/// The wave of the Volume Fraction Smoother: over-full cells keep the threshold and give the rest to their neighbours
/// in proportion to the neighbours' volumes; the next sweep takes the cells that this made over-full.  A cell gives at
/// most once, and one that gave, or gives in the same sweep, receives nothing: a wave that moves outwards and ends.
///
/// Spijker & Raupenstrauch, Chem. Eng. Technol. (2023), doi:10.1002/ceat.202200617, section 2.2.1, Eqs. 6 and 7.
/// Paper: Eq. 7 adds a volume to a fraction and divides by fractions; here: each receiving neighbour's fraction grows
/// by VF_tr over the sum of their volumes, as the paper's text says.
/// Paper: silent about an over-full cell that finds no neighbour to give to; here: it keeps its excess and is reported.
/// Paper: cell after cell; here: all cells of a sweep are marked before any gives, and a receiver takes its shares in
/// the order of the givers' global indices, so that the result depends neither on storage nor on the number of ranks.
///
/// What rounding takes is carried along (value + rest), so that a chain of 1e5 sweeps loses no more than one sweep.
template <class Graph>
class smoothing_wave {
  public:
    using index = typename Graph::index;
    using mesh_type = smoothing_mesh<Graph>;
    static constexpr bool is_distributed = mesh_type::is_distributed;

    explicit smoothing_wave(const mesh_type& mesh)
        : mesh_(mesh),
          order_(static_cast<std::size_t>(mesh.graph().total_count())),
          shares_(is_distributed ? static_cast<std::size_t>(mesh.graph().total_count()) : 0) {}

    /// Forgets the former call.
    void clear() {
        next_count_ = 0;
        stuck_.clear();
        sweeps_ = 0;
        smoothed_ = 0;
    }

    /// Says, before run(), that a cell is over-full; twice does no harm.
    void insert(index cell) {
        reserve_next(1);
        next_[next_count_++] = cell;
    }

    template <class Read>
    void run(double threshold, smoothing_cells& cells, smoothing_log& log, const Read& read) {
        for (;; ++sweeps_) {
            if (!mesh_.graph().communicator().any(next_count_ > 0)) return;
            front_.clear();
            for (std::size_t k = 0; k < next_count_; ++k) order_.insert(mesh_.place(next_[k]));
            next_count_ = 0;
            order_.drain([&](std::size_t place) { front_.push_back(mesh_.cell_at(place)); });
            for (const index cell : front_) {
                cells.touch(cell, read);
                cells.set(cell, smoothing_cells::marked);
            }
            sweep(threshold, cells, log, read);
            log.end_sweep();
        }
    }

    int sweeps() const { return sweeps_; }
    /// Owned cells that gave.
    std::int64_t smoothed_cells() const { return smoothed_; }
    /// Owned cells above the threshold that had no neighbour to give to, in the order of the sweeps.
    const std::vector<index>& stuck_cells() const { return stuck_; }

    std::size_t memory() const {
        return (next_.capacity() + front_.capacity() + stuck_.capacity() + receivers_.capacity() + givers_.capacity()) *
                   sizeof(index) +
               shares_.capacity() * sizeof(share) + bits_.capacity();
    }

  private:
    /// What a cell gives to each neighbour that is not marked: the increment of fraction [-], in two parts.
    struct share {
        double amount;
        float rest;
    };

    template <class Read>
    void sweep(double threshold, smoothing_cells& cells, smoothing_log& log, const Read& read) {
        if constexpr (!is_distributed) {
            for (std::size_t k = 0; k < front_.size(); ++k) {
                mesh_.look_ahead(
                    k, front_.size(), [&](std::size_t at) { return front_[at]; }, [&](index n) { cells.prefetch(n); });
                const index cell = front_[k];
                find_receivers(cell, cells);
                if (const share given = cut(cell, threshold, cells); given.amount > 0) {
                    give(cell, given, threshold, cells, log, read);
                }
            }
        } else {
            const auto& halo = mesh_.graph().halo();
            halo.gather(cells.data());  // which ghosts are marked
            givers_.clear();
            for (const index cell : front_) {
                find_receivers(cell, cells);
                const share given = shares_[static_cast<std::size_t>(cell)] = cut(cell, threshold, cells);
                if (given.amount > 0) givers_.push_back(cell);
            }
            halo.gather(shares_.data());
            for (index ghost = mesh_.owned(); ghost < mesh_.graph().total_count(); ++ghost) {
                if (shares_[static_cast<std::size_t>(ghost)].amount > 0) givers_.push_back(ghost);
            }
            std::sort(givers_.begin(), givers_.end(),
                      [&](index a, index b) { return mesh_.place(a) < mesh_.place(b); });
            for (const index cell : givers_) {
                find_receivers(cell, cells);
                give(cell, shares_[static_cast<std::size_t>(cell)], threshold, cells, log, read);
                shares_[static_cast<std::size_t>(cell)] = {};
            }
        }
    }

    /// Makes room for so many more cells of the next sweep.
    void reserve_next(std::size_t more) {
        if (next_.size() < next_count_ + more) next_.resize(2 * (next_count_ + more));
    }

    /// The neighbours that are not marked, as cells and as bits of the row, and the sum of their volumes.
    void find_receivers(index cell, const smoothing_cells& cells) {
        const auto row = mesh_.neighbours(cell);
        const auto count = static_cast<std::size_t>(row.last - row.first);
        if (receivers_.size() < count) receivers_.resize(count);
        index* next = receivers_.data();
        bits_.clear();
        for (const index* at = row.first; at != row.last;) {
            const index* const last = at + std::min<std::ptrdiff_t>(8, row.last - at);
            unsigned byte = 0;
            for (unsigned bit = 1; at != last; ++at, bit <<= 1) {
                const bool receives = !cells.is(*at, smoothing_cells::marked);
                *next = *at;
                next += receives ? 1 : 0;  // without a branch: nobody could predict it
                byte |= receives ? bit : 0;
            }
            bits_.push_back(static_cast<std::uint8_t>(byte));
        }
        receiver_count_ = static_cast<std::size_t>(next - receivers_.data());
        double volume = 0;
        double rest = 0;
        for (const index* n = receivers_.data(); n != next; ++n) {
            const two_sum grown(volume, mesh_.volume(*n));
            volume = grown.sum;
            rest += grown.error;
        }
        receiver_volume_ = volume;
        receiver_volume_rest_ = rest;
    }

    share cut(index cell, double threshold, const smoothing_cells& cells) {
        if (receiver_count_ == 0) {
            stuck_.push_back(cell);
            return {};
        }
        const double volume = mesh_.volume(cell);
        const two_sum above(cells[cell].value, -threshold);
        const two_sum excess(above.sum, above.error + static_cast<double>(cells[cell].rest));
        const double product = excess.sum * volume;
        const double product_rest = std::fma(excess.sum, volume, -product) + excess.error * volume;
        const double amount = product / receiver_volume_;
        const double rest =
            std::fma(-amount, receiver_volume_, product) + product_rest - amount * receiver_volume_rest_;
        return {amount, static_cast<float>(rest / receiver_volume_)};
    }

    template <class Read>
    void give(index cell, share given, double threshold, smoothing_cells& cells, smoothing_log& log, const Read& read) {
        log.append(cell, threshold / cells[cell].value, bits_.data(), bits_.size());
        reserve_next(receiver_count_);
        for (std::size_t r = 0; r < receiver_count_; ++r) {
            const index n = receivers_[r];
            if (is_distributed && n >= mesh_.owned()) continue;
            smoothing_cells::content& receiver = cells.touch(n, read);
            const two_sum grown(receiver.value, given.amount);
            const two_sum rounded(grown.sum, grown.error + static_cast<double>(receiver.rest + given.rest));
            receiver.value = rounded.sum;
            receiver.rest = static_cast<float>(rounded.error);
            next_[next_count_] = n;
            next_count_ += receiver.value > threshold ? 1 : 0;  // without a branch
        }
        if (is_distributed && cell >= mesh_.owned()) return;
        cells.set_fraction(cell, threshold);
        ++smoothed_;
    }

    const mesh_type& mesh_;
    std::vector<index> next_;     // over-full cells of the next sweep, some more than once, and room for more
    std::size_t next_count_ = 0;  // of those
    ordered_set order_;
    std::vector<index> front_;
    std::vector<index> stuck_;
    std::vector<index> receivers_;
    std::size_t receiver_count_ = 0;
    std::vector<std::uint8_t> bits_;
    double receiver_volume_ = 0;
    double receiver_volume_rest_ = 0;
    std::vector<share> shares_;  // distributed only
    std::vector<index> givers_;  // distributed only: owned cells and ghosts
    int sweeps_ = 0;
    std::int64_t smoothed_ = 0;
};

}  // namespace hearth::detail
