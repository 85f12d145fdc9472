// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hearth::detail {

/// Splits a + b into its rounded sum and the error of that sum, exactly.
/// Knuth, The Art of Computer Programming 2, 4.2.2, theorem B.
struct two_sum {
    two_sum(double a, double b) : sum(a + b) {
        const double part = sum - a;
        error = (a - (sum - part)) + (b - part);
    }
    double sum;
    double error;
};

/// Set of the integers below a size, given back in ascending order.  A tree of bits: insert costs one or two writes,
/// drain costs what is in the set, whatever the size.
class ordered_set {
  public:
    explicit ordered_set(std::size_t size) {
        do {
            size = (size + 63) / 64;
            levels_.emplace_back(size, std::uint64_t{0});
        } while (size > 1);
    }

    void insert(std::size_t i) {
        for (auto& level : levels_) {
            std::uint64_t& word = level[i / 64];
            const bool seen_above = word != 0;
            word |= std::uint64_t{1} << (i % 64);
            if (seen_above) return;
            i /= 64;
        }
    }

    /// Visits the members in ascending order and leaves the set empty.
    template <class Visit>
    void drain(Visit&& visit) {
        drain_word(levels_.size() - 1, 0, visit);
    }

  private:
    template <class Visit>
    void drain_word(std::size_t level, std::size_t at, Visit& visit) {
        if (at >= levels_[level].size()) return;  // a set of size 0
        std::uint64_t& word = levels_[level][at];
        for (; word != 0; word &= word - 1) {
            const std::size_t i = at * 64 + lowest_bit(word);
            if (level == 0) {
                visit(i);
            } else {
                drain_word(level - 1, i, visit);
            }
        }
    }

    static std::size_t lowest_bit(std::uint64_t word) {
#if defined(__GNUC__)
        return static_cast<std::size_t>(__builtin_ctzll(word));
#else
        std::size_t bit = 0;
        while ((word >> bit & 1) == 0) ++bit;
        return bit;
#endif
    }

    std::vector<std::vector<std::uint64_t>> levels_;
};

/// The mesh as the Volume Fraction Smoother walks it: rows of ghosts too (their owned neighbours), and the order of the
/// global indices.  Built once per graph.
template <class Graph>
class smoothing_mesh {
  public:
    using index = typename Graph::index;
    static constexpr bool is_distributed = Graph::communicator_type::is_distributed;

    explicit smoothing_mesh(const Graph& graph) : graph_(&graph), owned_(graph.cell_count()) {
        for (index c = 0; c < graph.total_count(); ++c) largest_volume_ = std::max(largest_volume_, graph.volume(c));
        cells_everywhere_ = owned_;
        graph.communicator().sum(&cells_everywhere_, 1);
        largest_volume_ = graph.communicator().max(largest_volume_);
        sort_by_id();
        if constexpr (is_distributed) turn_rows();
    }

    const Graph& graph() const { return *graph_; }
    index owned() const { return owned_; }
    double volume(index cell) const { return graph_->volumes()[cell]; }
    double largest_volume() const { return largest_volume_; }
    std::int64_t cells_everywhere() const { return cells_everywhere_; }

    struct row {
        const index* first;
        const index* last;
        const index* begin() const { return first; }
        const index* end() const { return last; }
    };
    /// Neighbours of an owned cell, or the owned neighbours of a ghost.
    row neighbours(index cell) const {
        if constexpr (is_distributed) {
            if (cell >= owned_) {
                const auto ghost = static_cast<std::size_t>(cell - owned_);
                return {ghost_rows_.data() + ghost_offsets_[ghost], ghost_rows_.data() + ghost_offsets_[ghost + 1]};
            }
        }
        return {graph_->neighbours() + graph_->row_begin(cell), graph_->neighbours() + graph_->row_end(cell)};
    }

    /// Place of a cell in the order of the global indices, and back.
    std::size_t place(index cell) const {
        return places_.empty() ? static_cast<std::size_t>(cell)
                               : static_cast<std::size_t>(places_[static_cast<std::size_t>(cell)]);
    }
    index cell_at(std::size_t place) const { return by_id_.empty() ? static_cast<index>(place) : by_id_[place]; }

    std::size_t memory() const {
        return (places_.capacity() + by_id_.capacity() + ghost_rows_.capacity()) * sizeof(index) +
               ghost_offsets_.capacity() * sizeof(std::size_t);
    }

  private:
    void sort_by_id() {
        const auto total = static_cast<std::size_t>(graph_->total_count());
        bool sorted = true;
        for (index c = 1; c < graph_->total_count() && sorted; ++c) {
            sorted = graph_->global_index(c - 1) < graph_->global_index(c);
        }
        if (sorted) return;
        by_id_.resize(total);
        std::iota(by_id_.begin(), by_id_.end(), index{0});
        std::sort(by_id_.begin(), by_id_.end(),
                  [&](index a, index b) { return graph_->global_index(a) < graph_->global_index(b); });
        places_.resize(total);
        for (std::size_t k = 0; k < total; ++k) places_[static_cast<std::size_t>(by_id_[k])] = static_cast<index>(k);
    }

    void turn_rows() {
        ghost_offsets_.assign(static_cast<std::size_t>(graph_->total_count() - owned_) + 1, 0);
        const auto for_each_link = [&](auto&& visit) {
            for (index c = 0; c < owned_; ++c) {
                graph_->for_each_neighbour(c, [&](index n) {
                    if (n >= owned_) visit(c, static_cast<std::size_t>(n - owned_));
                });
            }
        };
        for_each_link([&](index, std::size_t ghost) { ++ghost_offsets_[ghost + 1]; });
        std::partial_sum(ghost_offsets_.begin(), ghost_offsets_.end(), ghost_offsets_.begin());
        ghost_rows_.resize(ghost_offsets_.back());
        std::vector<std::size_t> next(ghost_offsets_.begin(), ghost_offsets_.end() - 1);
        for_each_link([&](index c, std::size_t ghost) { ghost_rows_[next[ghost]++] = c; });
    }

    const Graph* graph_;
    index owned_;
    double largest_volume_ = 0;
    std::int64_t cells_everywhere_ = 0;
    std::vector<index> places_;  // empty: the cells are stored in the order of their global indices
    std::vector<index> by_id_;
    std::vector<std::size_t> ghost_offsets_;
    std::vector<index> ghost_rows_;
};

/// Working copy of the fractions of those cells that a call touches; nothing of a former call has to be cleared.
class smoothing_cells {
  public:
    using index = std::int32_t;

    /// value + rest is the solid fraction; the rest is what rounding took from the value.
    struct state {
        double value;
        float rest;
        std::uint32_t stamp;
    };
    enum flag : std::uint32_t { touched = 1, marked = 2, visited = 4 };

    explicit smoothing_cells(std::size_t total) : states_(total, state{0, 0, 0}) {}

    /// Forgets the former call.
    void begin() {
        touched_.clear();
        now_ += 8;
        if (now_ != 0) return;
        for (state& s : states_) s.stamp = 0;  // after 2^29 calls
        now_ = 8;
    }

    state& operator[](index cell) { return states_[static_cast<std::size_t>(cell)]; }
    state* data() { return states_.data(); }

    bool is_touched(const state& s) const { return s.stamp > now_; }
    bool is(const state& s, flag f) const { return is_touched(s) && (s.stamp & f) != 0; }
    /// Sets a flag of a touched cell.
    void set(state& s, flag f) const { s.stamp |= f; }

    /// Copies the host's value when a cell is first touched.
    template <class Read>
    void touch(index cell, const Read& read) {
        state& s = (*this)[cell];
        if (is_touched(s)) return;
        s = {read(cell), 0, now_ | touched};
        touched_.push_back(cell);
    }

    const std::vector<index>& touched_cells() const { return touched_; }
    std::size_t memory() const { return states_.capacity() * sizeof(state) + touched_.capacity() * sizeof(index); }

  private:
    std::vector<state> states_;
    std::vector<index> touched_;
    std::uint32_t now_ = 0;
};

}  // namespace hearth::detail
