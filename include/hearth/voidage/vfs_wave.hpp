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
/// Spijker, Pollhammer, Raupenstrauch, Chem. Eng. Technol. 46 (2023), doi:10.1002/ceat.202200603, section 2.2.1, Eqs. 6 and 7.
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
        : mesh_(mesh), next_(static_cast<std::size_t>(mesh.graph().total_count())) {}

    /// Says that a cell is over-full, before run().
    void insert(index cell) { next_.insert(mesh_.place(cell)); }

    /// Forgets what insert() said, and what an exception left behind.
    void clear() {
        next_.drain([](std::size_t) {});
        stuck_.clear();
        sweeps_ = 0;
    }

    template <class Read>
    void run(double threshold, smoothing_cells& cells, smoothing_log& log, const Read& read) {
        const auto& communicator = mesh_.graph().communicator();
        for (;; ++sweeps_) {
            front_.clear();
            next_.drain([&](std::size_t place) { front_.push_back(mesh_.cell_at(place)); });
            if (!communicator.any(!front_.empty())) break;
            for (const index cell : front_) {
                cells.touch(cell, read);
                cells.set(cells[cell], smoothing_cells::marked);
            }
            sweep(threshold, cells, log, read);
            log.end_sweep();
        }
    }

    int sweeps() const { return sweeps_; }
    /// Owned cells above the threshold that had no neighbour to give to, in the order of the sweeps.
    const std::vector<index>& stuck_cells() const { return stuck_; }

  private:
    template <class Read>
    void sweep(double threshold, smoothing_cells& cells, smoothing_log& log, const Read& read) {
        if constexpr (!is_distributed) {
            for (const index cell : front_) {
                const share given = cut(cell, threshold, cells);
                if (given.amount > 0) give(cell, given, threshold, cells, log, read);
            }
        } else {
            const auto& halo = mesh_.graph().halo();
            shares_.resize(static_cast<std::size_t>(mesh_.graph().total_count()), share{0, 0});
            halo.gather(cells.data());  // which ghosts are marked
            for (const index cell : front_) {
                const share given = cut(cell, threshold, cells);
                shares_[static_cast<std::size_t>(cell)] = given;
                if (given.amount > 0) givers_.push_back(cell);
            }
            halo.gather(shares_.data());
            for (index ghost = mesh_.owned(); ghost < mesh_.graph().total_count(); ++ghost) {
                if (shares_[static_cast<std::size_t>(ghost)].amount > 0) givers_.push_back(ghost);
            }
            std::sort(givers_.begin(), givers_.end(), [&](index a, index b) { return mesh_.place(a) < mesh_.place(b); });
            for (const index cell : givers_) {
                share& given = shares_[static_cast<std::size_t>(cell)];
                give(cell, given, threshold, cells, log, read);
                given = {0, 0};
            }
            givers_.clear();
        }
    }

    /// What a cell gives to each neighbour that is not marked: the increment of fraction [-], in two parts.
    struct share {
        double amount;
        float rest;
    };

    share cut(index cell, double threshold, smoothing_cells& cells) {
        double volume = 0;  // of the receivers
        double volume_rest = 0;
        for (const index n : mesh_.neighbours(cell)) {
            if (cells.is(cells[n], smoothing_cells::marked)) continue;
            const two_sum grown(volume, mesh_.volume(n));
            volume = grown.sum;
            volume_rest += grown.error;
        }
        if (volume == 0) {
            stuck_.push_back(cell);
            return {0, 0};
        }
        const auto& state = cells[cell];
        const two_sum excess(state.value, -threshold);
        const double product = excess.sum * mesh_.volume(cell);
        const double product_rest = std::fma(excess.sum, mesh_.volume(cell), -product) +
                                    (excess.error + static_cast<double>(state.rest)) * mesh_.volume(cell);
        const double amount = product / volume;
        const double rest = (std::fma(-amount, volume, product) + product_rest - amount * volume_rest) / volume;
        return {amount, static_cast<float>(rest)};
    }

    template <class Read>
    void give(index cell, share given, double threshold, smoothing_cells& cells, smoothing_log& log, const Read& read) {
        smoothing_cells::state& giver = cells[cell];
        auto entry = log.append(cell, threshold / giver.value);
        for (const index n : mesh_.neighbours(cell)) {
            smoothing_cells::state& receiver = cells[n];
            const bool receives = !cells.is(receiver, smoothing_cells::marked);
            entry.next(receives);
            if (!receives || n >= mesh_.owned()) continue;
            cells.touch(n, read);
            const two_sum grown(receiver.value, given.amount);
            receiver.value = grown.sum;
            receiver.rest += static_cast<float>(grown.error) + given.rest;
            if (receiver.value > threshold) next_.insert(mesh_.place(n));
        }
        giver.value = threshold;
        giver.rest = 0;
    }

    const mesh_type& mesh_;
    ordered_set next_;
    std::vector<index> front_;
    std::vector<index> stuck_;
    std::vector<share> shares_;   // distributed only
    std::vector<index> givers_;   // distributed only: owned and ghosts, in the order of their global indices
    int sweeps_ = 0;
};

}  // namespace hearth::detail
